#include <catch2/catch.hpp>
#include <set>

#include "core/output/result_writer.hpp"
#include "coupler/run/reporter.hpp"
#include "coupler/run/sources.hpp"
#include "coupler/scene/coupled_scene.hpp"
#include "coupler/schemes/serial_explicit.hpp"
#include "dem_solver/app/adapter.hpp"
#include "fem_solver/app/adapter.hpp"
#include "tests/support/in_process.hpp"
#include "tests/support/program.hpp"

using namespace talus;

namespace {

constexpr const char* cable_net = TALUS_SOURCE_DIR "/configs/examples/cable_net.yaml";

/// The scene's run with both solvers as threads of this process, written by the same parts as `talus run`.
void run_in_process(const std::filesystem::path& scene_file, const std::filesystem::path& folder) {
  const auto file = core::SceneFile::load(scene_file);
  std::vector<core::Complaint> complaints;
  const auto scene = coupler::read_coupled_scene(file, complaints);
  REQUIRE(complaints.empty());
  const auto segment = coupler::transport::create_heap_segment();
  coupler::Session session(segment, {});
  coupler::Peer& structure = session.await(coupler::Role::structure);
  coupler::Peer& particles = session.await(coupler::Role::particles);
  const test::ParticipantThread first(segment, coupler::Role::structure,
                                      [&](auto& p) { fem::serve_structure(file, p); });
  const test::ParticipantThread second(segment, coupler::Role::particles,
                                       [&](auto& p) { dem::serve_particles(file, p); });
  session.wait_joined();
  const auto interface = coupler::introduce(session, coupler::plan_of(*scene.interface));
  coupler::lay_out_arrays(session, interface, {scene.window()});
  coupler::Exchange exchange(session, interface->tie.mapping);
  const coupler::PeerSource structure_values(structure), particle_values(particles);
  const coupler::InterfaceSource interface_values(*interface, particles, exchange);
  core::ResultWriter results({.folder = folder}, {&structure_values, &particle_values, &interface_values});
  const coupler::Span span{.end = scene.time.end, .window_length = scene.window()};
  coupler::Reporter reporter(session, results,
                             {.span = span, .rows = coupler::Schedule(span, scene.output.every)},
                             core::ProgressStyle::quiet);
  for (std::int64_t n = 0; n < span.windows(); ++n) {
    reporter.at(n);
    if (n == 0) exchange.start();
    coupler::SerialExplicit{}.compute(exchange, span.window(n));
  }
  reporter.last(span.windows());
  session.finish();
}

/// `talus run` in three processes.
void run_in_processes(const std::filesystem::path& scene, const std::filesystem::path& folder,
                      const std::string& threads) {
  test::Program run({TALUS_BINARY_DIR "/bin/talus", "run", scene.string(), "--out", folder.string(),
                     "--quiet", "--threads", threads},
                    folder.string() + ".txt");
  const auto end = run.wait(std::chrono::seconds(120));
  INFO(end.output);
  REQUIRE(end.code == 0);
}

}  // namespace

TEST_CASE(
    "a rock on a cable net gives the same bits in three processes and in one, with any number of threads") {
  const test::Folder folder("coupled_run");
  run_in_process(cable_net, folder.path() / "one");
  run_in_processes(cable_net, folder.path() / "three", "1");
  run_in_processes(cable_net, folder.path() / "threads", "2");
  for (const char* name : {"probes.csv", "energy.csv"}) {
    const std::string expected = test::text_of(folder.path() / "one" / name);
    CHECK(std::count(expected.begin(), expected.end(), '\n') > 400);
    CHECK(test::text_of(folder.path() / "three" / name) == expected);
    CHECK(test::text_of(folder.path() / "threads" / name) == expected);
  }
}
