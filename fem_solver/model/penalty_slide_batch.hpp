#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "fem_solver/constraints/penalty_sliding.hpp"
#include "fem_solver/elements/axial.hpp"
#include "fem_solver/model/configuration.hpp"
#include "fem_solver/model/slide_line.hpp"

namespace talus::fem {

/// Springs that hold sliders on a rope made of other elements [P eq. 5-7]. The nearest segment is searched
/// anew at every state, so sliders go from one segment to the next by themselves. One force slot a slider and
/// one a rope node, because which rope nodes a slider pulls changes. Has no mass. @see ElementBatch for the
/// meaning of the members.
class PenaltySlideBatch {
 public:
  /// @param penalty N/m. @param reference node positions, 3 a node (m)
  PenaltySlideBatch(SlideLine line, double penalty, std::span<const double> reference);

  static std::string called() { return "penalty springs"; }
  Index size() const { return 1; }  ///< sliders share rope nodes, so they are computed in one go
  Index slots() const { return static_cast<Index>(line_.sliders.size() + line_.rope.size()); }
  const std::vector<std::array<Index, 1>>& cells() const { return cells_; }
  const SlideLine& line() const { return line_; }

  template <class Visit>
  void for_each_incidence(const Visit& visit) const {
    Index slot = 0;
    for (const Index node : line_.sliders) visit(node, slot++, +1);
    for (const Index node : line_.rope) visit(node, slot++, +1);
  }

  void internal_force(const Configuration& at, std::span<double> slots, core::Block) const noexcept;
  void stiffness_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                         core::Block) const noexcept;
  /// As if every slider stood at the rope node nearest to it, where its spring has only that node's mass to
  /// pull; without the geometric part, a share gap/segment of the rest.
  void stiffest_product(const Configuration& at, std::span<const double> direction, std::span<double> slots,
                        core::Block elements) const noexcept;
  void damping_product(const Configuration& at, std::span<const double> velocity, std::span<double> slots,
                       core::Block) const noexcept;
  void add_stiffness_bound(const Configuration& at, std::span<double> row_sums) const noexcept;
  double energy(const Configuration& at) const noexcept;
  void add_mass(std::span<double>) const noexcept {}
  /// Distance of slider k from the rope (m).
  double gap(const Configuration& at, std::size_t slider) const noexcept;
  /// Force between slider k and the rope (N).
  double force(const Configuration& at, std::size_t slider) const noexcept {
    return penalty_ * gap(at, slider);
  }
  /// Place of slider k along the rope: its current length from the first node to the slider's foot (m).
  double place(const Configuration& at, std::size_t slider) const noexcept;

  /// Every pair of a slider and a rope node, and of neighbouring rope nodes, gets a block; those not in touch
  /// are zero.
  template <class Sink>
  void stiffness(const Configuration& at, const Sink& sink) const {
    spread(
        at, [](const PenaltySlide& spring) { return spring.stiffness(); }, sink);
  }
  template <class Sink>
  void damping_matrix(const Configuration& at, const Sink& sink) const {
    spread(
        at, [](const PenaltySlide& spring) { return spring.material_stiffness(); }, sink);
  }

 private:
  template <class MatrixOf, class Sink>
  void spread(const Configuration& at, const MatrixOf& matrix_of, const Sink& sink) const {
    for (std::size_t k = 0; k < line_.sliders.size(); ++k) {
      const auto [segment, spring] = contact(at, k);
      const PenaltySlide::Matrix9 K = matrix_of(spring);
      const auto block = [&](int i, int j) { return Matrix3(K.block<3, 3>(3 * i, 3 * j)); };
      const Index slider = line_.sliders[k];
      sink(slider, slider, block(2, 2));
      for (std::size_t r = 0; r < line_.rope.size(); ++r) {
        const int own = r == segment ? 0 : r == segment + 1 ? 1 : -1;
        sink(slider, line_.rope[r], own < 0 ? zero() : block(2, own));
        sink(line_.rope[r], slider, own < 0 ? zero() : block(own, 2));
        sink(line_.rope[r], line_.rope[r], own < 0 ? zero() : block(own, own));
        if (r + 1 == line_.rope.size()) break;
        const bool inside = r == segment;
        sink(line_.rope[r], line_.rope[r + 1], inside ? block(0, 1) : zero());
        sink(line_.rope[r + 1], line_.rope[r], inside ? block(1, 0) : zero());
      }
    }
  }

  static Matrix3 zero() { return Matrix3::Zero(); }
  Vector3 position(const Configuration& at, Index node) const noexcept;
  /// A slider's spring at the segment of the rope that is nearest to it.
  struct Contact {
    std::size_t segment = 0;
    PenaltySlide spring;
  };
  Contact contact(const Configuration& at, std::size_t slider) const noexcept;
  /// Fills the slots with force_on(slider, contact): forces on the segment's two nodes and on the slider.
  template <class ForceOn>
  void fill_slots(const Configuration& at, std::span<double> slots, ForceOn&& force_on) const noexcept;

  SlideLine line_;
  double penalty_;
  std::vector<double> reference_;  ///< m; of all nodes, 3 a node
  std::vector<std::array<Index, 1>> cells_;
};

}  // namespace talus::fem
