#include "fem_solver/model/ring_batch.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/errors.hpp"

namespace talus::fem {
namespace {

/// Of the ring's diameter: where a node comes this near to its neighbour on the ring it stops.
constexpr double gap_of_diameter = 0.01;

const RingLaw& ring_law_of(const RingLaw& law) {
  return law;
}
const RingLaw& ring_law_of(const Breaking<RingLaw>& law) {
  return law.law;
}

std::string place_of(std::span<const double> reference, Index node) {
  const double* x = &reference[3 * static_cast<std::size_t>(node)];
  return fmt::format("({:g}, {:g}, {:g}) m", x[0], x[1], x[2]);
}

}  // namespace

template <class Law>
RingBatch<Law>::RingBatch(Description description, std::vector<std::array<Index, 2>> segments,
                          std::span<const double> reference)
    : description_(std::move(description)),
      gap_(gap_of_diameter * description_.inner_diameter),
      cells_(std::move(segments)),
      begin_{0} {
  double around = 0;
  for (Index s = 0; s < slots(); ++s) {
    const Vector3 chord = difference(reference, s);
    reference_.insert(reference_.end(), chord.begin(), chord.end());
    around += RopeSegment(chord, gap_).length;
    ring_of_.push_back(static_cast<Index>(perimeters_.size()));
    const Index first = cells_[place(begin_.back())][0], here = cells_[place(s)][1];
    if (here == first) {
      begin_.push_back(s + 1);
      perimeters_.push_back(std::exchange(around, 0));
    } else if (s + 1 == slots() || cells_[place(s + 1)][0] != here) {
      throw core::ConfigError(fmt::format("a ring is a closed line, but the one that begins at {} ends at {}",
                                          place_of(reference, first), place_of(reference, here)));
    }
  }
  const double straight = ring_law_of(description_.law).straight().perimeter;
  for (Index e = 0; e < size(); ++e)
    if (const double p = perimeters_[place(e)]; p < description_.inner_diameter || p >= straight)
      throw core::ConfigError(
          fmt::format("the polygon of a ring of {:g} m must be {:g} to {:g} m long, where the ring is "
                      "straight, but that at {} "
                      "is {:g} m long",
                      description_.inner_diameter, description_.inner_diameter, straight,
                      place_of(reference, cells_[place(begin_[place(e)])][0]), p));
}

template <class Law>
double RingBatch<Law>::perimeter(const Configuration& at, Index ring) const noexcept {
  double sum = 0;
  for (Index i = begin_[place(ring)]; i < begin_[place(ring) + 1]; ++i) sum += side(at, i).length;
  return sum;
}

template <class Law>
auto RingBatch<Law>::along(const Configuration& at, Index ring) const noexcept -> Along {
  const AxialResponse response = respond(at, ring);
  return {response.force, response.slope};
}

template <class Law>
auto RingBatch<Law>::material(const Configuration& at, Index ring) const noexcept -> Along {
  return {0, respond(at, ring).slope};
}

template <class Law>
auto RingBatch<Law>::stiffest(const Configuration& at, Index ring) const noexcept -> Along {
  if constexpr (requires { Law::is_broken(0.0); })
    if (is_broken(at, ring)) return {0, 0};
  const double tension = respond(at, ring).force;
  return {tension, description_.law.stiffest_slope({perimeter(at, ring), perimeters_[place(ring)]}, tension)};
}

template <class Law>
void RingBatch<Law>::internal_force(const Configuration& at, std::span<double> next, std::span<double> slots,
                                    core::Block rings) const noexcept {
  for (auto e = static_cast<Index>(rings.begin); e < rings.end; ++e) {
    const AxialResponse response = respond(at, e);
    next[place(e)] = response.history;
    for (Index i = begin_[place(e)]; i < begin_[place(e) + 1]; ++i)
      Vector3::Map(&slots[3 * place(i)]) = response.force * side(at, i).direction;
  }
}

template <class Law>
void RingBatch<Law>::product(const Configuration& at, Index ring, const Along& along,
                             std::span<const double> changes, std::span<double> slots) const noexcept {
  const Index begin = begin_[place(ring)], end = begin_[place(ring) + 1];
  double growth = 0;
  for (Index i = begin; i < end; ++i) growth += side(at, i).direction.dot(difference(changes, i));
  for (Index i = begin; i < end; ++i) {
    const RopeSegment here = side(at, i);
    Vector3::Map(&slots[3 * place(i)]) = along.slope * growth * here.direction +
                                         along.tension * here.curvature_product(difference(changes, i));
  }
}

template <class Law>
void RingBatch<Law>::stiffness_product(const Configuration& at, std::span<const double> direction,
                                       std::span<double> slots, core::Block rings) const noexcept {
  for (auto e = static_cast<Index>(rings.begin); e < rings.end; ++e)
    product(at, e, along(at, e), direction, slots);
}

template <class Law>
void RingBatch<Law>::stiffest_product(const Configuration& at, std::span<const double> direction,
                                      std::span<double> slots, core::Block rings) const noexcept {
  for (auto e = static_cast<Index>(rings.begin); e < rings.end; ++e)
    product(at, e, stiffest(at, e), direction, slots);
}

template <class Law>
void RingBatch<Law>::damping_product(const Configuration& at, std::span<const double> velocity,
                                     std::span<double> slots, core::Block rings) const noexcept {
  for (auto e = static_cast<Index>(rings.begin); e < rings.end; ++e)
    product(at, e, material(at, e), velocity, slots);
}

/// The stretching of a whole ring is one number times T T^T, the turning of each side a matter of its two nodes.
template <class Law>
void RingBatch<Law>::add_stiffness_bound(const Configuration& at, std::span<double> row_sums) const {
  for (Index e = 0; e < size(); ++e) {
    const Index begin = begin_[place(e)], end = begin_[place(e) + 1];
    const auto [tension, slope] = stiffest(at, e);
    // T of the node where side i begins is t of the side before it minus its own.
    Vector3 before = side(at, end - 1).direction;
    std::vector<Vector3> pulls;
    double all = 0;
    for (Index i = begin; i < end; ++i) {
      const RopeSegment here = side(at, i);
      add_pair_bound(cells_[place(i)], tension * here.curvature(), row_sums);
      pulls.push_back(before - here.direction);
      all += pulls.back().lpNorm<1>();
      before = here.direction;
    }
    for (Index i = begin; i < end; ++i)
      Vector3::Map(&row_sums[3 * place(cells_[place(i)][0])]) +=
          slope * all * pulls[place(i - begin)].cwiseAbs();
  }
}

template <class Law>
double RingBatch<Law>::energy(const Configuration& at) const noexcept {
  double sum = 0;
  for (Index e = 0; e < size(); ++e)
    sum += description_.law.stored({perimeter(at, e), perimeters_[place(e)]}, kept(at, e));
  return sum;
}

template <class Law>
double RingBatch<Law>::dissipated(const Configuration& at) const noexcept {
  double sum = 0;
  for (Index e = 0; e < size(); ++e)
    sum += description_.law.dissipated({perimeter(at, e), perimeters_[place(e)]}, kept(at, e));
  return sum;
}

template <class Law>
void RingBatch<Law>::add_mass(std::span<double> node_masses) const noexcept {
  for (Index i = 0; i < slots(); ++i) {
    const Index ring = ring_of_[place(i)];
    node_masses[place(cells_[place(i)][0])] +=
        description_.mass / (begin_[place(ring) + 1] - begin_[place(ring)]);
  }
}

template class RingBatch<RingLaw>;
template class RingBatch<Breaking<RingLaw>>;

}  // namespace talus::fem
