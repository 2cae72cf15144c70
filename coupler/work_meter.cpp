#include "coupler/work_meter.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace talus::coupler {
namespace {

constexpr std::size_t block = 24;  // values of 8 nodes

/// In integers, which compiles to a few vector instructions; a loop that stops at the first value does not.
bool all_zero(const double* values) noexcept {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < block; ++i) bits |= std::bit_cast<std::uint64_t>(values[i]);
  constexpr std::uint64_t all_but_the_sign = ~std::uint64_t{0} >> 1;
  return (bits & all_but_the_sign) == 0;
}

/// Sum over blocks of `force` that are not all zero: what touches is a small part of a net, and of the rest
/// only the forces are read. Lanes are summed apart, in an order that depends on nothing but the size.
template <class Term>
double sum_over_loaded(std::span<const double> force, Term&& term) noexcept {
  std::array<double, block> lanes{};
  const std::size_t whole = force.size() / block * block;
  for (std::size_t begin = 0; begin < whole; begin += block) {
    const double* f = force.data() + begin;
    if (all_zero(f)) continue;
    for (std::size_t lane = 0; lane < block; ++lane) lanes[lane] += f[lane] * term(begin + lane);
  }
  double sum = 0;
  for (std::size_t i = whole; i < force.size(); ++i) sum += force[i] * term(i);
  for (const double lane : lanes) sum += lane;
  return sum;
}

}  // namespace

WorkMeter::WorkMeter(const Window& window, std::span<const double> force, const Motion& start) noexcept
    : meaning_(window.meaning) {
  const double *u = start.displacement.data(), *v = start.velocity.data(), length = window.length;
  pending_ = meaning_ == ForceMeaning::mean
                 ? sum_over_loaded(force, [u](std::size_t i) { return -u[i]; })
                 : sum_over_loaded(force, [=](std::size_t i) { return length * v[i] - u[i]; });
}

double WorkMeter::end(std::span<const double> force, std::span<const double> displacement) const noexcept {
  const double* u = displacement.data();
  const double path_times_force = pending_ + sum_over_loaded(force, [u](std::size_t i) { return u[i]; });
  return meaning_ == ForceMeaning::mean ? path_times_force : 0.5 * path_times_force;
}

double work_on_path(std::span<const double> mean_force, std::span<const double> start,
                    std::span<const double> end) noexcept {
  const double *u = start.data(), *u_end = end.data();
  return sum_over_loaded(mean_force, [=](std::size_t i) { return u_end[i] - u[i]; });
}

}  // namespace talus::coupler
