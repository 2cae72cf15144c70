#pragma once

#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "fem_solver/elements/path_segment.hpp"
#include "fem_solver/model/rope_batch.hpp"
#include "fem_solver/model/two_node_batch.hpp"

namespace talus::fem {

/// Two-node elements whose law remembers: brakes, elastic-plastic ropes. One force slot an element.
///
/// internal_force() answers for the present positions and the memory kept; accept() keeps what followed from
/// them.
/// @see ElementBatch for the meaning of the members.
template <class Law>
class PathBatch {
 public:
  struct Description {
    Law law;
    double mass_per_length = 0;  ///< kg/m
  };
  PathBatch(Description description, std::vector<std::array<Index, 2>> segments,
            std::span<const double> reference);

  Index size() const { return static_cast<Index>(segments_.size()); }
  Index slots() const { return size(); }
  const std::vector<std::array<Index, 2>>& cells() const { return segments_; }
  template <class Visit>
  void for_each_incidence(const Visit& visit) const {
    for_each_pair_incidence(segments_, visit);
  }

  void internal_force(std::span<const double> displacement, std::span<double> slots,
                      core::Block elements) const noexcept;
  void stiffness_product(std::span<const double> displacement, std::span<const double> direction,
                         std::span<double> slots, core::Block elements) const noexcept;
  /// At the law's initial stiffness, to which it may unload in any step.
  void stiffest_product(std::span<const double> displacement, std::span<const double> direction,
                        std::span<double> slots, core::Block elements) const noexcept;
  double energy(std::span<const double> displacement) const noexcept;
  void add_mass(std::span<double> node_masses) const noexcept;
  template <class Sink>
  void stiffness(std::span<const double> displacement, const Sink& sink) const {
    for (Index e = 0; e < size(); ++e) {
      const Vector3 d = chord(displacement, e);
      const Matrix3 K = segment(e).stiffness(d, segment(e).respond(d, kept_[at(e)]));
      spread_pair_block(segments_[at(e)], segments_[at(e)], K, sink);
    }
  }

  void accept() const noexcept { kept_ = next_; }
  std::vector<double> memory() const { return kept_; }
  void set_memory(std::span<const double> values) const { next_ = kept_ = {values.begin(), values.end()}; }
  std::size_t memory_size() const { return kept_.size(); }
  double dissipated(std::span<const double> displacement) const noexcept;  ///< J

  double axial_force(std::span<const double> displacement, Index e) const noexcept {
    return segment(e).respond(chord(displacement, e), kept_[at(e)]).force;
  }
  double elongation(std::span<const double> displacement, Index e) const noexcept {
    return chord(displacement, e).norm() - lengths_[at(e)];
  }
  /// Largest elongation of a brake (m), plastic strain of a rope (1); up to the last accept().
  double kept(Index e) const noexcept { return kept_[at(e)]; }

 private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }
  PathSegment<Law> segment(Index e) const noexcept { return {description_.law, lengths_[at(e)]}; }
  Vector3 difference(std::span<const double> values, Index e) const noexcept {
    const auto [near, far] = segments_[at(e)];
    return Vector3::Map(&values[3 * at(far)]) - Vector3::Map(&values[3 * at(near)]);
  }
  Vector3 chord(std::span<const double> displacement, Index e) const noexcept {
    return Vector3::Map(&reference_[3 * at(e)]) + difference(displacement, e);
  }

  Description description_;
  std::vector<std::array<Index, 2>> segments_;
  std::vector<double> reference_;  ///< m; chords, 3 an element
  std::vector<double> lengths_;    ///< m
  // The run's state, not the structure's description: changes while the model is constant.
  mutable std::vector<double> kept_, next_;
};

using BrakeBatch = PathBatch<BrakeLaw>;
using ElasticPlasticBatch = PathBatch<ElasticPlasticRope>;
extern template class PathBatch<BrakeLaw>;
extern template class PathBatch<ElasticPlasticRope>;

}  // namespace talus::fem
