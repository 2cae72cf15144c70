#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "dem_solver/rocks/rocks.hpp"

namespace talus::dem {

/// A surface that counts the stones which pass it along its normal: a plane, or a disc of it.
struct Gate {
  std::string name;
  Triple<double> point;                                     ///< m; of the plane, the centre of the disc
  Triple<double> normal;                                    ///< unit; the way that counts
  double radius = std::numeric_limits<double>::infinity();  ///< m; of the disc
};

/// One stone at the moment it passed a gate.
struct Passage {
  double time = 0;         ///< s; when its centre was in the gate's plane
  std::int64_t stone = 0;  ///< the sphere's number in the fields; a rock's is that of its first sphere
  double diameter = 0;     ///< m; a rock's is that of the sphere about its centre that holds it
  double speed = 0;        ///< m/s
  bool operator==(const Passage&) const = default;
};

/// Stones that have passed a gate, each once: a sphere or a rock, when its centre gets from the one side to
/// the other within the disc.
struct Passed {
  std::int64_t stones = 0;
  double mass = 0;             ///< kg
  double kinetic_energy = 0;   ///< J; of translation, at the moment of passing
  double smallest_radius = 0;  ///< m; a rock's is that of the sphere about its centre that holds it
  double largest_radius = 0;   ///< m
};

class Gates {
 public:
  Gates() = default;
  explicit Gates(std::vector<Gate> gates)
      : gates_(std::move(gates)), passed_(gates_.size()), passages_(gates_.size()), near_(gates_.size()) {}

  bool empty() const noexcept { return gates_.empty(); }
  const std::vector<Gate>& gates() const noexcept { return gates_; }
  const std::vector<Passed>& passed() const noexcept { return passed_; }
  /// Of one gate, in the order they were seen.
  const std::vector<Passage>& passages(std::size_t gate) const noexcept { return passages_[gate]; }
  /// Whether the stone is held, that is, has not passed: a sphere of this id, or a rock.
  bool holds_sphere(std::size_t gate, Index id) const noexcept { return holds(gate, id); }
  bool holds_rock(std::size_t gate, Index rock) const noexcept { return holds(gate, spheres_ + rock); }

  struct Stones {
    const Spheres& spheres;
    const Rocks& rocks;
    double time = 0;  ///< s; of their places
  };
  /// Looks where every stone is, and remembers which spheres may reach a gate within `reach` (m). To be
  /// called where spheres have been sorted anew, or any may have moved further than that.
  void watch_all(const Stones& stones, double reach);
  /// Looks where the rocks and the spheres near the gates are. To be called each step: a stone that comes
  /// back between two looks has not passed.
  void watch_near(const Stones& stones);

  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor&& visit) {
    visit("side", self.side_);
    visit("passed", self.passed_);
    for (std::size_t gate = 0; gate < self.gates_.size(); ++gate) {
      visit("passages." + std::to_string(gate), self.passages_[gate]);
      visit("near." + std::to_string(gate), self.near_[gate]);
    }
  }

 private:
  enum class Side : std::uint8_t { unknown, in_front, behind };
  struct Stone {
    Index number = 0;       ///< spheres by id, then rocks
    std::int64_t name = 0;  ///< as Passage::stone
    Triple<double> centre, velocity;
    double mass = 0, radius = 0;
  };
  static Stone sphere(const Spheres& spheres, Index i) noexcept;
  static Stone rock(const Stones& stones, Index k) noexcept;
  void look(std::size_t gate, const Stone& stone, double time);
  void pass(std::size_t gate, const Stone& stone, const Passage& passage);
  std::size_t slot(std::size_t gate, Index number) const noexcept {
    return gate * (side_.size() / gates_.size()) + static_cast<std::size_t>(number);
  }
  bool holds(std::size_t gate, Index number) const noexcept {
    return side_[slot(gate, number)] != Side::behind;
  }

  std::vector<Gate> gates_;
  std::vector<Passed> passed_;
  std::vector<std::vector<Passage>> passages_;
  std::vector<std::vector<Index>> near_;  ///< of each gate, places of spheres
  Index spheres_ = 0;
  std::vector<Side> side_;  ///< of each stone, gate after gate; `behind` is final
};

}  // namespace talus::dem
