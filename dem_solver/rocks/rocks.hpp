#pragma once

#include <span>
#include <vector>

#include "dem_solver/integration/leapfrog.hpp"
#include "dem_solver/particles/spheres.hpp"
#include "dem_solver/rocks/rotation.hpp"

namespace talus::dem {

/// A rigid body made of spheres, as a scene or a caller gives it.
struct RockInput {
  double mass = 0;                     ///< kg
  Triple<double> moments;              ///< kg m^2; principal, about the centre
  Triple<double> centre;               ///< m
  Quaternion orientation{0, 0, 0, 1};  ///< turns the principal axes into space
  Triple<double> velocity;             ///< m/s
  Triple<double> spin;                 ///< rad/s
};

/// State of all rocks. Their spheres take part in contacts like any other; the rock collects their loads,
/// moves, and places them again.
class Rocks {
 public:
  Rocks() = default;
  /// @param spheres in the order of their ids; those with sphere.rock == k are rock k's
  Rocks(std::span<const RockInput> rocks, std::span<const SphereInput> spheres);

  Index size() const noexcept { return static_cast<Index>(mass_.size()); }
  bool empty() const noexcept { return mass_.empty(); }

  /// Puts every member sphere where its rock is, with the rock's velocity there and its spin.
  /// @param place where each sphere's id stands. @return the largest speed of a member, m/s
  double place_members(Spheres& spheres, std::span<const Index> place) const noexcept;

  /// Sums the loads of the members, then moves by one step of the leapfrog like free spheres do.
  void move(const Spheres& spheres, std::span<const Index> place, const LeapfrogStep& how) noexcept;

  struct Load {
    Triple<double> force;   ///< N
    Triple<double> torque;  ///< N m; about the centre
  };
  /// The sum of the loads on the members.
  Load load(Index k, const Spheres& spheres, std::span<const Index> place) const noexcept;

  double mass(Index k) const noexcept { return mass_[k]; }
  /// m; of the sphere about the centre that holds the rock.
  double radius(Index k) const noexcept { return radius_[k]; }
  /// The id of its first sphere.
  Index first_sphere(Index k) const noexcept { return members_[first_member_[k]]; }
  const Triple<double>& centre(Index k) const noexcept { return centre_[k]; }
  const Triple<double>& velocity(Index k) const noexcept { return velocity_[k]; }
  const Triple<double>& force(Index k) const noexcept { return force_[k]; }
  const Triple<double>& angular_momentum(Index k) const noexcept { return momentum_[k]; }
  const Quaternion& orientation(Index k) const noexcept { return orientation_[k]; }
  Triple<double> spin(Index k) const noexcept { return spin_of(k, momentum_[k]); }
  /// rad/s; that the rock would have with another angular momentum, kg m^2/s.
  Triple<double> spin_of(Index k, const Triple<double>& momentum) const noexcept {
    return angular_velocity(orientation_[k], momentum, moments_[k]);
  }

  /// J; at the time level of the last forces: 1/2 m v.v_before and 1/2 w.L_before.
  struct Energy {
    double translation = 0, rotation = 0;
  };
  /// @param last the step that led here; of length 0 before the first
  Energy energy(Index k, const LeapfrogStep& last) const noexcept;

  template <class Self, class Visitor>
  static void visit_state(Self& self, Visitor&& visit) {
    visit("centre", self.centre_);
    visit("velocity", self.velocity_);
    visit("momentum", self.momentum_);
    visit("orientation", self.orientation_);
    visit("orientation_before", self.orientation_before_);
    visit("force", self.force_);
    visit("torque", self.torque_);
  }

 private:
  std::vector<double> mass_, radius_;
  std::vector<Triple<double>> moments_;
  std::vector<Index> first_member_;            ///< one more than rocks
  std::vector<Index> members_;                 ///< ids of spheres
  std::vector<Triple<double>> member_offset_;  ///< m; in the principal axes
  std::vector<Triple<double>> centre_, velocity_, momentum_, force_, torque_;
  std::vector<Quaternion> orientation_, orientation_before_;
};

}  // namespace talus::dem
