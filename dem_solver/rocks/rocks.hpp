#pragma once

#include <span>
#include <string>
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
  std::string name = {};               ///< for messages
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

  /// Puts every member sphere where its rock is, with the rock's velocity there and its spin, and gives it the mass that
  /// its dashpots are sized for. Dashpots of n contacts act in parallel: for each to be 2 g sqrt(m k) of the whole rock
  /// would damp sqrt(n) times too much. With the share
  ///
  ///     m_i = m_eff k_i/K        1/m_eff = (F.F/m + T.I^-1 T)/(sum of |F_i|)^2, 1/m at least
  ///
  /// | symbol | meaning                                                          | unit    |
  /// |--------|------------------------------------------------------------------|---------|
  /// | k_i, K | stiffness of a member's contacts at the last step, of all        | N/m     |
  /// | F_i    | load on a member; F and T of all about the centre                | N, N m  |
  ///
  /// n equal contacts have the restitution of one, and one contact off the centre that of the mass it feels. Members
  /// without a contact get what they would if one more began, of a rock without any, if all did. Tests: verification/particles "many contacts".
  /// @param place where each sphere's id stands. @return the largest speed of a member, m/s
  double place_members(Spheres& spheres, std::span<const Index> place) const noexcept;

  /// dt^2 times the largest squared frequency of a rock on the springs of its contacts at the last step: at 4 the
  /// leapfrog begins to grow. A bound that costs little is looked at first, so values below 1 may be too large. A member's
  /// stiffness counts in every direction, as springs of friction are nearly as stiff.
  /// @return of the rock for which it is largest; of none: -1, 0
  struct Stiffest {
    Index rock = -1;
    double ratio = 0;
  };
  Stiffest stiffest(const Spheres& spheres, std::span<const Index> place, double step) const;

  /// Sums the loads of the members, then moves by one step of the leapfrog like free spheres do.
  void move(const Spheres& spheres, std::span<const Index> place, const LeapfrogStep& how) noexcept;

  struct Load {
    Triple<double> force;   ///< N
    Triple<double> torque;  ///< N m; about the centre
    Triple<double> lever;   ///< N m; the part of it that forces on the members' centres make
    double stiffness = 0;   ///< N/m; of all contacts
    double pressure = 0;    ///< N; sum of the sizes of the members' loads
    int touching = 0;       ///< members in contact
  };
  /// The sum of the loads on the members.
  Load load(Index k, const Spheres& spheres, std::span<const Index> place) const noexcept;

  double mass(Index k) const noexcept { return mass_[k]; }
  const std::string& name(Index k) const noexcept { return name_[k]; }
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
  /// kg; of the whole rock, as its contacts feel it.
  double stopped_mass(Index k, const Load& load) const noexcept;
  double exact_ratio(Index k, const Spheres& spheres, std::span<const Index> place, double step) const;

  /// What a member's dashpots are sized for: kg a stiffness (m/(N/m)) where it touches, kg where it does not.
  struct MassShare {
    double per_stiffness = 0, one_more = 0;
  };
  std::vector<MassShare> mass_share_;  ///< of the last move()
  std::vector<std::string> name_;
  std::vector<double> mass_, radius_;
  std::vector<Triple<double>> moments_;
  std::vector<Index> first_member_;            ///< one more than rocks
  std::vector<Index> members_;                 ///< ids of spheres
  std::vector<Triple<double>> member_offset_;  ///< m; in the principal axes
  std::vector<Triple<double>> member_facing_;  ///< SphereInput::facing, in the principal axes
  std::vector<Triple<double>> centre_, velocity_, momentum_, force_, torque_;
  std::vector<Quaternion> orientation_, orientation_before_;
};

}  // namespace talus::dem
