#include "fem_solver/materials/axial_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace talus::fem {
namespace {

double green_lagrange(const SegmentLengths& lengths) noexcept {
  const auto [l, L] = lengths;
  return 0.5 * (l - L) * (l + L) / (L * L);
}

void check_table(const std::vector<std::pair<double, double>>& table) {
  if (table.empty())
    throw core::ConfigError("the table of a brake needs at least one point of elongation and force");
  std::pair<double, double> before{0, 0};
  const double steepest = table.front().second / table.front().first;
  for (const auto& point : table) {
    const auto& [elongation, force] = point;
    if (!(elongation > before.first) || !(force > 0))
      throw core::ConfigError(fmt::format(
          "the table of a brake must rise from (0 m, 0 N) with growing elongation and positive force, but "
          "({:g} m, {:g} N) follows ({:g} m, {:g} N)",
          elongation, force, before.first, before.second));
    const double slope = (force - before.second) / (elongation - before.first);
    if (slope > steepest * (1 + 1e-12))
      throw core::ConfigError(fmt::format(
          "the table of a brake is steeper ({:g} N/m) before ({:g} m, {:g} N) than at its start ({:g} N/m), "
          "which is the stiffness it unloads with",
          slope, elongation, force, steepest));
    before = point;
  }
}

}  // namespace

AxialResponse ElasticRope::respond(const Lengths& lengths, double history) const noexcept {
  const double stress = section.youngs_modulus * green_lagrange(lengths) + section.prestress;
  if (stress <= 0) return {0, 0, history};
  const double q = lengths.current / lengths.reference;
  return {section.area * stress * q,
          section.area * (stress + section.youngs_modulus * q * q) / lengths.reference, history};
}

double ElasticRope::stored(const Lengths& lengths, double) const noexcept {
  const double stress = std::max(0.0, section.youngs_modulus * green_lagrange(lengths) + section.prestress);
  return section.area * lengths.reference * (stress * stress - section.prestress * section.prestress) /
         (2 * section.youngs_modulus);
}

double ElasticRope::slack_energy(double reference) const noexcept {
  return -section.area * reference * section.prestress * section.prestress / (2 * section.youngs_modulus);
}

double ElasticRope::stiffest_slope(const Lengths& lengths, double force) const noexcept {
  const auto [l, L] = lengths;
  return force / l + section.area * section.youngs_modulus * l * l / (L * L * L);
}

AxialResponse ElasticPlasticRope::respond(const Lengths& lengths, double history) const noexcept {
  const double E = section.youngs_modulus, e = green_lagrange(lengths);
  const double trial = E * (e - history) + section.prestress;
  if (trial <= 0) return {0, 0, history};
  const double flow = std::max(0.0, (trial - yield_stress - hardening * history) / (E + hardening));
  const double stress = trial - E * flow, modulus = flow > 0 ? E * hardening / (E + hardening) : E;
  const double q = lengths.current / lengths.reference;
  return {section.area * stress * q, section.area * (stress + modulus * q * q) / lengths.reference,
          history + flow};
}

double ElasticPlasticRope::stored(const Lengths& lengths, double history) const noexcept {
  const double E = section.youngs_modulus, S_pre = section.prestress;
  const double stress = std::max(0.0, E * (green_lagrange(lengths) - history) + S_pre);
  const double density = (stress * stress - S_pre * S_pre) / (2 * E) + 0.5 * hardening * history * history;
  return section.area * lengths.reference * density;
}

/// Hardening keeps its energy; once the rope is broken nothing gives it back, see Breaking.
double ElasticPlasticRope::slack_energy(double reference) const noexcept {
  return -section.area * reference * section.prestress * section.prestress / (2 * section.youngs_modulus);
}

double ElasticPlasticRope::dissipated(const Lengths& lengths, double history) const noexcept {
  return section.area * lengths.reference * yield_stress * history;
}

double ElasticPlasticRope::stiffest_slope(const Lengths& lengths, double force) const noexcept {
  const auto [l, L] = lengths;
  return force / l + section.area * section.youngs_modulus * l * l / (L * L * L);
}

BrakeLaw::BrakeLaw(Description description) : description_(std::move(description)) {
  check_table(description_.table);
  if (!(description_.stop_stiffness > 0) || !(description_.stop_width > 0))
    throw core::ConfigError("the end stop of a brake needs a stiffness above 0 N/m and a width above 0 m");
  const auto& table = description_.table;
  initial_stiffness_ = table.front().second / table.front().first;
  work_.push_back(0.5 * table.front().first * table.front().second);
  for (std::size_t i = 1; i < table.size(); ++i)
    work_.push_back(work_.back() +
                    0.5 * (table[i].first - table[i - 1].first) * (table[i].second + table[i - 1].second));
}

AxialResponse BrakeLaw::respond(const Lengths& lengths, double history) const noexcept {
  const double u = lengths.current - lengths.reference;
  const Point plastic = plastic_at(u, history), stop = stop_at(u);
  return {plastic.force + stop.force, plastic.slope + stop.slope, std::max(history, u)};
}

double BrakeLaw::stored(const Lengths& lengths, double history) const noexcept {
  const double u = lengths.current - lengths.reference;
  const double b = std::max(0.0, u - travel()), w = description_.stop_width, ks = description_.stop_stiffness;
  const double stop = b < w ? ks * b * b * b / (6 * w) : ks * (w * w / 6 + 0.5 * b * (b - w));
  const double force = plastic_at(u, history).force;
  return force * force / (2 * initial_stiffness_) + stop;
}

double BrakeLaw::dissipated(const Lengths& lengths, double history) const noexcept {
  const double m = std::max(history, lengths.current - lengths.reference);
  const double force = table_at(m).force;
  return table_work(m) - force * force / (2 * initial_stiffness_);
}

double BrakeLaw::stiffest_slope(const Lengths& lengths, double) const noexcept {
  return initial_stiffness_ + stop_at(lengths.current - lengths.reference).slope;
}

BrakeLaw::Point BrakeLaw::plastic_at(double elongation, double largest) const noexcept {
  if (elongation >= largest) return table_at(elongation);
  const double force = table_at(largest).force - initial_stiffness_ * (largest - elongation);
  return force > 0 ? Point{force, initial_stiffness_} : Point{0, 0};
}

BrakeLaw::Point BrakeLaw::table_at(double elongation) const noexcept {
  if (elongation <= 0) return {0, 0};
  std::pair<double, double> before{0, 0};
  for (const auto& point : description_.table) {
    if (elongation < point.first) {
      const double slope = (point.second - before.second) / (point.first - before.first);
      return {before.second + slope * (elongation - before.first), slope};
    }
    before = point;
  }
  return {before.second, 0};
}

BrakeLaw::Point BrakeLaw::stop_at(double elongation) const noexcept {
  const double b = elongation - travel(), w = description_.stop_width, ks = description_.stop_stiffness;
  if (b <= 0) return {0, 0};
  return b < w ? Point{ks * b * b / (2 * w), ks * b / w} : Point{ks * (b - 0.5 * w), ks};
}

double BrakeLaw::table_work(double elongation) const noexcept {
  if (elongation <= 0) return 0;
  const auto& table = description_.table;
  std::pair<double, double> before{0, 0};
  double work = 0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (elongation < table[i].first) break;
    before = table[i];
    work = work_[i];
  }
  return work + 0.5 * (elongation - before.first) * (before.second + table_at(elongation).force);
}

}  // namespace talus::fem
