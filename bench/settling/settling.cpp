#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <string>

#include "bench/settling/bed.hpp"
#include "bench/settling/machine.hpp"
#include "core/program/command_line.hpp"

/// Times the settling of a bed of spheres and prints one JSON object.
namespace {

using namespace talus;

struct Options {
  std::int64_t count = 10'000, steps = 5'000, settle = 0;
  int threads = 1;
  std::string write_data;
  bool machine = false, stages = false;
};

double mean_height(const dem::Spheres& spheres) {
  double sum = 0;
  for (const dem::Row& p : spheres.position) sum += p.z;
  return sum / spheres.size();
}

double kinetic_energy(const dem::Spheres& spheres) {
  double sum = 0;
  for (const dem::Row& v : spheres.velocity)
    sum += 0.5 * v.w * dem::dot(dem::triple<double>(v), dem::triple<double>(v));
  return sum;
}

double contacts_a_sphere(const dem::ParticleSolver& solver) {
  double touching = 0;
  for (std::uint8_t t : solver.pair_list().touched()) touching += t;
  return 2 * touching / solver.spheres().size();
}

/// B; what this program's objects take, allocator's overhead included. (The process holds more: freed memory,
/// code, stacks, which with few spheres is as much again.)
double allocated() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

/// B; a line of /proc/self/status: what the process holds now (VmRSS) or held at most (VmHWM).
double process_memory(const std::string& line) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == line + ":") {
      double kilobytes = 0;
      status >> kilobytes;
      return 1024 * kilobytes;
    }
  return 0;
}

core::ExitCode print_machine(int threads) {
  const bench::MachineSpeedup speedup = bench::measure_machine(threads);
  fmt::print(
      "{{\"threads\":{},\"arithmetic_speedup\":{:.2f},\"copy_speedup\":{:.2f},\"copy_gb_per_s\":{:.1f}}}\n",
      threads, speedup.arithmetic, speedup.copy, speedup.copy_gb_per_s);
  return core::ExitCode::success;
}

void print_stages(const core::StageClock& clock, double particle_steps) {
  fmt::print("{{\"ns_of_a_particle_step\":{{");
  for (std::size_t k = 0; k < clock.stages().size(); ++k)
    fmt::print("{}\"{}\":{:.2f}", k > 0 ? "," : "", clock.stages()[k],
               1e9 * clock.seconds()[k] / particle_steps);
  fmt::print("}}}}\n");
}

core::ExitCode run(const Options& options) {
  if (options.machine) return print_machine(options.threads);
  const double allocated_before = allocated(), memory_before = process_memory("VmRSS");
  bench::Bed bed = bench::make_bed(options.count);
  if (!options.write_data.empty()) {
    bench::write_data_file(bed, options.write_data);
    fmt::print("{:.17g}\n", bed.side);
    return core::ExitCode::success;
  }
  dem::ParticleSolver solver(bench::model_of(bed, options.threads));
  bed = {};  // so that memory is that of the solver
  for (std::int64_t n = 0; n < options.settle; ++n) solver.step();
  core::StageClock clock = dem::make_stage_clock();
  if (options.stages) solver.measure_stages(clock);
  const std::int64_t searches_before = solver.searches();
  const auto start = std::chrono::steady_clock::now();
  for (std::int64_t n = 0; n < options.steps; ++n) solver.step();
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double particle_steps = static_cast<double>(options.count) * static_cast<double>(options.steps);
  if (options.stages) print_stages(clock, particle_steps);
  fmt::print(
      "{{\"peer\":\"talus\",\"n\":{},\"steps\":{},\"settle\":{},\"threads\":{},\"wall_s\":{:.3f},\"particle_"
      "steps_per_s\":{:.0f},"
      "\"mean_z_m\":{:.5f},\"kinetic_J\":{:.5g},\"mean_contacts\":{:.3f},\"searches\":{},"
      "\"bytes_per_sphere\":{:.0f},\"process_bytes_per_sphere\":{:.0f},\"peak_process_bytes_per_sphere\":{:."
      "0f}}}\n",
      options.count, options.steps, options.settle, options.threads, wall, particle_steps / wall,
      mean_height(solver.spheres()), kinetic_energy(solver.spheres()), contacts_a_sphere(solver),
      solver.searches() - searches_before,
      (allocated() - allocated_before) / static_cast<double>(options.count),
      (process_memory("VmRSS") - memory_before) / static_cast<double>(options.count),
      (process_memory("VmHWM") - memory_before) / static_cast<double>(options.count));
  return core::ExitCode::success;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Times a settling bed of spheres.", "bench_settling");
  app.add_option("--n", options.count, "spheres")->check(CLI::PositiveNumber);
  app.add_option("--steps", options.steps, "timed steps")->check(CLI::PositiveNumber);
  app.add_option("--settle", options.settle, "steps before the timed ones")->check(CLI::NonNegativeNumber);
  app.add_option("--threads", options.threads, "threads")->check(CLI::PositiveNumber);
  app.add_option("--write-data", options.write_data,
                 "write the bed as a LIGGGHTS data file and print the box's side instead");
  app.add_flag("--stages", options.stages,
               "let the stages follow each other, and print the nanoseconds of a particle-step in each, too");
  app.add_flag("--machine", options.machine,
               "print what so many threads gain on this machine at best instead");
  return core::run_main(app, argc, argv, [&] { return run(options); });
}
