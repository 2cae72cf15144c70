#pragma once

#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "dem_solver/particles/row.hpp"

namespace talus::dem {

/// One sphere as a scene or a caller gives it.
struct SphereInput {
  Triple<double> position;  ///< m
  Triple<double> velocity;  ///< m/s
  Triple<double> spin;      ///< rad/s
  double radius = 0;        ///< m
  double mass = 0;          ///< kg; of the body the sphere belongs to
  Index material = 0;
  Index rock = -1;        ///< the rock it is a part of; -1: a particle of its own
  double area = 0;        ///< m^2; of the body's surface, what this sphere stands for
  Triple<double> facing;  ///< unit vector out of that surface; zero where it looks every way
};

/// m^2; the area of a sphere's surface (a row of `facing`) as a partner sees it, from which `normal` points to the sphere.
/// On a plane the areas of a body's faces, each times the cosine of how it is inclined, add up to what the plane sees.
template <class Real>
TALUS_INLINE Real seen_area(const Quad<Real>& facing, const Triple<Real>& normal) noexcept {
  const Triple<Real> out = triple(facing);
  return facing.w * (larger(-dot(out, normal), Real{}) + (1.0 - dot(out, out)));
}

/// State of all spheres, as arrays. The solver reorders them in space whenever it searches for neighbours;
/// `id` never changes.
struct Spheres {
  std::vector<Row> position;  ///< m; w: radius
  std::vector<Row> velocity;  ///< m/s; half a step behind the position; w: mass that its contacts stop, of a
                              ///< rock see Rocks::place_members
  std::vector<Row> spin;      ///< rad/s; empty where nothing turns the spheres
  std::vector<Row> force;     ///< N; of the last evaluation; w: N/m, sum of the contacts' stiffnesses
  std::vector<Row> torque;    ///< N m; empty where nothing turns the spheres
  std::vector<Index> material;
  std::vector<Index> id;    ///< the place of a sphere in the order it was added
  std::vector<Index> rock;  ///< empty where there are no rocks
  std::vector<Row> facing;  ///< SphereInput::facing; w: area, m^2; empty where the law works on points

  Index size() const noexcept { return static_cast<Index>(position.size()); }
  bool in_rock(Index i) const noexcept { return !rock.empty() && rock[i] >= 0; }
  bool rotates() const noexcept { return !spin.empty(); }
  struct Wanted {
    bool rotation = false, facing = false;
  };
  void add(std::span<const SphereInput> input, const Wanted& wanted);
  /// Sets forces and torques of a run of places to zero.
  void clear_loads(core::Block run) noexcept;
  /// Moves sphere order[i] to place i.
  void reorder(std::span<const Index> order);
  /// Where each id stands now.
  std::vector<Index> places() const;

  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor&& visit) {
    visit("position", self.position);
    visit("velocity", self.velocity);
    visit("spin", self.spin);
    visit("force", self.force);
    visit("torque", self.torque);
    visit("material", self.material);
    visit("id", self.id);
    visit("rock", self.rock);
    visit("facing", self.facing);
  }
};

}  // namespace talus::dem
