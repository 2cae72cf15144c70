#include "fem_solver/materials/ring_law.hpp"

#include <algorithm>
#include <numbers>

namespace talus::fem {
namespace {

// The rings of the tests.
constexpr double tested_wire = 0.003, tested_diameter = 0.3, tested_strength = 1.77e9;  // m, m, Pa
constexpr int rings_of_chain = 3;
/// Where bending has come to its end, as shares of what breaks the chain.
constexpr double straight_elongation = 0.85, straight_force = 0.15;
/// Of the wire of a ring that is about to break, and all that comes back: N_b/(n A E) is 630 to 790 MPa over 200 GPa.
constexpr double elastic_strain = 0.004;

double section_of(double wire_diameter) {
  return std::numbers::pi / 4 * wire_diameter * wire_diameter;
}

/// Force over windings and elongation of a chain with n windings.
RingChainTest chain_of(int windings) {
  const auto& tests = ring_chain_tests();
  const auto per_winding = [](const RingChainTest& test) { return test.force / test.windings; };
  const auto next = std::ranges::find_if(tests, [&](const auto& test) { return test.windings >= windings; });
  if (next == tests.begin() || next == tests.end()) {
    const RingChainTest& last = next == tests.end() ? tests.back() : tests.front();
    return {windings, per_winding(last) * windings, last.elongation};
  }
  const RingChainTest &high = *next, &low = *(next - 1);
  const double share = (1.0 / low.windings - 1.0 / windings) / (1.0 / low.windings - 1.0 / high.windings);
  const auto between = [share](double a, double b) { return a + share * (b - a); };
  return {windings, windings * between(per_winding(low), per_winding(high)),
          between(low.elongation, high.elongation)};
}

}  // namespace

const std::vector<RingChainTest>& ring_chain_tests() {
  static const std::vector<RingChainTest> tests{
      {5, 44.94e3, 0.519}, {9, 80.55e3, 0.490}, {16, 177.66e3, 0.476}};
  return tests;
}

RingLaw ring_law(const RingDescription& ring) {
  const RingChainTest chain = chain_of(ring.windings);
  const double tension = 0.5 * chain.force * section_of(ring.wire_diameter) / section_of(tested_wire) *
                         ring.strength / tested_strength;
  const auto perimeter = [&](double elongation) {
    return 2 * (tested_diameter + elongation / rings_of_chain) * ring.inner_diameter / tested_diameter;
  };
  return {{perimeter(straight_elongation * chain.elongation), straight_force * tension},
          {perimeter(chain.elongation), tension}};
}

/// At least that of every branch: of bending through many corners, too.
double RingLaw::unloading_slope(double reference) const noexcept {
  const double stretch =
                   (breaking_.tension - straight_.tension) / (breaking_.perimeter - straight_.perimeter),
               bending = straight_.tension / (straight_.perimeter - reference),
               wire = breaking_.tension / (elastic_strain * breaking_.perimeter);
  return std::max({stretch, bending, wire});
}

RingLaw::Loading RingLaw::load(double growth, double reference) const noexcept {
  if (growth <= 0) return {0, 0, 0};
  const double bending = straight_.perimeter - reference, soft = straight_.tension / bending;
  if (growth <= bending) return {soft * growth, soft, 0.5 * soft * growth * growth};
  const double stretch = growth - bending;
  const double stiff = (breaking_.tension - straight_.tension) / (breaking_.perimeter - straight_.perimeter);
  return {straight_.tension + stiff * stretch, stiff,
          0.5 * straight_.tension * bending + (straight_.tension + 0.5 * stiff * stretch) * stretch};
}

AxialResponse RingLaw::respond(const Lengths& lengths, double history) const noexcept {
  const double u = lengths.current - lengths.reference, L = lengths.reference;
  if (u >= history) {
    const Loading loading = load(u, L);
    return {loading.force, loading.slope, std::max(0.0, u)};
  }
  const double slope = unloading_slope(L), force = load(history, L).force - slope * (history - u);
  return force > 0 ? AxialResponse{force, slope, history} : AxialResponse{0, 0, history};
}

double RingLaw::stored(const Lengths& lengths, double history) const noexcept {
  const double force = respond(lengths, history).force;
  return force * force / (2 * unloading_slope(lengths.reference));
}

double RingLaw::dissipated(const Lengths& lengths, double history) const noexcept {
  const Loading largest = load(std::max(history, lengths.current - lengths.reference), lengths.reference);
  return largest.work - largest.force * largest.force / (2 * unloading_slope(lengths.reference));
}

double RingLaw::stiffest_slope(const Lengths& lengths, double) const noexcept {
  return unloading_slope(lengths.reference);
}

}  // namespace talus::fem
