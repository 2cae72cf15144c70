#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "fem_solver/elements/path_segment.hpp"
#include "fem_solver/model/configuration.hpp"
#include "fem_solver/model/rope_batch.hpp"
#include "fem_solver/model/two_node_batch.hpp"

namespace talus::fem {

/// Two-node elements whose law remembers: brakes, elastic-plastic ropes. One force slot an element.
///
/// Each remembers one number, which its law answers anew for the positions and for what was kept.
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

  static std::string called() { return Law::called(); }
  Index size() const { return static_cast<Index>(segments_.size()); }
  Index slots() const { return size(); }
  const std::vector<std::array<Index, 2>>& cells() const { return segments_; }
  template <class Visit>
  void for_each_incidence(const Visit& visit) const {
    for_each_pair_incidence(segments_, visit);
  }

  std::size_t memory_size() const { return segments_.size(); }
  void fill_initial_memory(std::span<double> memory) const { std::ranges::fill(memory, 0.0); }

  void internal_force(const Configuration& at, std::span<double> next, std::span<double> slots,
                      core::Block elements) const noexcept;
  void stiffness_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                         core::Block elements) const noexcept;
  /// At the law's initial stiffness, to which it may unload in any step.
  void stiffest_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                        core::Block elements) const noexcept;
  void damping_product(const Configuration& at, std::span<const double> velocity, std::span<double> slots,
                       core::Block elements) const noexcept;
  void add_stiffness_bound(const Configuration& at, std::span<double> row_sums) const noexcept;
  double energy(const Configuration& at) const noexcept;
  void add_mass(std::span<double> node_masses) const noexcept;
  template <class Sink>
  void stiffness(const Configuration& at, const Sink& sink) const {
    for (Index e = 0; e < size(); ++e) {
      const Vector3 d = chord(at.displacement, e);
      const Matrix3 K = segment(e).stiffness(d, segment(e).respond(d, kept(at, e)));
      spread_pair_block(segments_[place(e)], segments_[place(e)], K, sink);
    }
  }

  template <class Sink>
  void damping_matrix(const Configuration& at, const Sink& sink) const {
    for (Index e = 0; e < size(); ++e)
      spread_pair_block(segments_[place(e)], segments_[place(e)], material_stiffness(at, e), sink);
  }

  double dissipated(const Configuration& at) const noexcept;  ///< J

  double axial_force(const Configuration& at, Index e) const noexcept {
    return segment(e).respond(chord(at.displacement, e), kept(at, e)).force;
  }
  double elongation(const Configuration& at, Index e) const noexcept {
    return chord(at.displacement, e).norm() - lengths_[place(e)];
  }
  /// Whether it has broken in a step accepted before.
  template <class Own = Law>
  requires requires { Own::is_broken(0.0); }
  bool is_broken(const Configuration& at, Index e) const noexcept { return Own::is_broken(kept(at, e)); }
  /// Largest elongation of a brake (m), plastic strain of a rope (1); of the steps accepted.
  double kept(const Configuration& at, Index e) const noexcept {
    return at.memory.empty() ? 0 : at.memory[place(e)];
  }

 private:
  static std::size_t place(Index i) { return static_cast<std::size_t>(i); }
  PathSegment<Law> segment(Index e) const noexcept { return {description_.law, lengths_[place(e)]}; }
  Vector3 difference(std::span<const double> values, Index e) const noexcept {
    const auto [near, far] = segments_[place(e)];
    return Vector3::Map(&values[3 * place(far)]) - Vector3::Map(&values[3 * place(near)]);
  }
  /// Along the element, with the slope of its law; a law that softens has none.
  Matrix3 material_stiffness(const Configuration& at, Index e) const noexcept;
  /// The far node's block at the law's initial stiffness; zero once broken.
  Matrix3 stiffest(const Configuration& at, Index e) const noexcept;
  Vector3 chord(std::span<const double> displacement, Index e) const noexcept {
    return Vector3::Map(&reference_[3 * place(e)]) + difference(displacement, e);
  }

  Description description_;
  std::vector<std::array<Index, 2>> segments_;
  std::vector<double> reference_;  ///< m; chords, 3 an element
  std::vector<double> lengths_;    ///< m
};

/// What breaks.
template <class Batch>
concept Breaks = requires(const Batch& batch, const Configuration& at) {
  batch.is_broken(at, Index{});
};

/// The element that a line of an output or a boundary is of, where elements are not their lines.
template <class Batch>
Index element_of(const Batch& batch, Index cell) {
  if constexpr (requires { batch.element_of(cell); })
    return batch.element_of(cell);
  else
    return cell;
}
/// Its first line.
template <class Batch>
Index first_cell(const Batch& batch, Index element) {
  if constexpr (requires { batch.first_cell(element); })
    return batch.first_cell(element);
  else
    return element;
}

using BrakeBatch = PathBatch<BrakeLaw>;
using ElasticPlasticBatch = PathBatch<ElasticPlasticRope>;
using BreakingCableBatch = PathBatch<Breaking<ElasticRope>>;
using BreakingElasticPlasticBatch = PathBatch<Breaking<ElasticPlasticRope>>;
using BreakingBrakeBatch = PathBatch<Breaking<BrakeLaw>>;
extern template class PathBatch<BrakeLaw>;
extern template class PathBatch<ElasticPlasticRope>;
extern template class PathBatch<Breaking<ElasticRope>>;
extern template class PathBatch<Breaking<ElasticPlasticRope>>;
extern template class PathBatch<Breaking<BrakeLaw>>;

}  // namespace talus::fem
