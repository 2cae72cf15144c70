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
  explicit Gates(std::vector<Gate> gates) : gates_(std::move(gates)), passed_(gates_.size()) {}

  bool empty() const noexcept { return gates_.empty(); }
  const std::vector<Gate>& gates() const noexcept { return gates_; }
  const std::vector<Passed>& passed() const noexcept { return passed_; }

  /// Looks where every stone is now. To be called each step: a stone that comes back between two looks has
  /// not passed.
  void watch(const Spheres& spheres, const Rocks& rocks);

  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor&& visit) {
    visit("side", self.side_);
    visit("passed", self.passed_);
  }

 private:
  enum class Side : std::uint8_t { unknown, in_front, behind };
  struct Stone {
    Index number = 0;  ///< spheres by id, then rocks
    Triple<double> centre, velocity;
    double mass = 0, radius = 0;
  };
  void look(std::size_t gate, std::size_t stones, const Stone& stone);

  std::vector<Gate> gates_;
  std::vector<Passed> passed_;
  std::vector<Side> side_;  ///< of each stone, gate after gate; `behind` is final
};

}  // namespace talus::dem
