#include "dem_solver/rocks/rocks.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace talus::dem {

Rocks::Rocks(std::span<const RockInput> rocks, std::span<const SphereInput> spheres) : first_member_{0} {
  for (Index k = 0; k < static_cast<Index>(rocks.size()); ++k) {
    const RockInput& rock = rocks[k];
    name_.push_back(rock.name);
    mass_.push_back(rock.mass);
    moments_.push_back(rock.moments);
    centre_.push_back(rock.centre);
    velocity_.push_back(rock.velocity);
    orientation_.push_back(rock.orientation);
    const Triple<double> w = rotate_back(rock.orientation, rock.spin);
    momentum_.push_back(
        rotate(rock.orientation, {rock.moments.x * w.x, rock.moments.y * w.y, rock.moments.z * w.z}));
    radius_.push_back(0);
    for (Index id = 0; id < static_cast<Index>(spheres.size()); ++id) {
      if (spheres[id].rock != k) continue;
      const Triple<double> arm = spheres[id].position - rock.centre;
      members_.push_back(id);
      member_offset_.push_back(rotate_back(rock.orientation, arm));
      member_facing_.push_back(rotate_back(rock.orientation, spheres[id].facing));
      radius_.back() = std::max(radius_.back(), length(arm) + spheres[id].radius);
    }
    first_member_.push_back(static_cast<Index>(members_.size()));
  }
  mass_share_.resize(mass_.size());
  force_.resize(mass_.size());
  torque_.resize(mass_.size());
  orientation_before_ = orientation_;
}

double Rocks::place_members(Spheres& spheres, std::span<const Index> place) const noexcept {
  double largest = 0;
  for (Index k = 0; k < size(); ++k) {
    const Triple<double> w = spin(k);
    const auto [per_stiffness, one_more] = mass_share_[k];
    for (Index m = first_member_[k]; m < first_member_[k + 1]; ++m) {
      const Index i = place[members_[m]];
      const double stiffness = spheres.force[i].w;
      const Triple<double> arm = rotate(orientation_[k], member_offset_[m]);
      const Triple<double> v = velocity_[k] + cross(w, arm);
      spheres.position[i] = row(centre_[k] + arm, spheres.position[i].w);
      spheres.velocity[i] = row(v, stiffness > 0 ? per_stiffness * stiffness : one_more);
      if (spheres.rotates()) spheres.spin[i] = row(w);
      if (!spheres.facing.empty())
        spheres.facing[i] = row(rotate(orientation_[k], member_facing_[m]), spheres.facing[i].w);
      largest = std::max(largest, dot(v, v));
    }
  }
  return std::sqrt(largest);
}

Rocks::Load Rocks::load(Index k, const Spheres& spheres, std::span<const Index> place) const noexcept {
  Load sum;
  for (Index m = first_member_[k]; m < first_member_[k + 1]; ++m) {
    const Index i = place[members_[m]];
    const Triple<double> f = triple<double>(spheres.force[i]);
    sum.force = sum.force + f;
    sum.stiffness += spheres.force[i].w;
    sum.pressure += length(f);
    sum.touching += spheres.force[i].w > 0;
    sum.lever = sum.lever + cross(triple<double>(spheres.position[i]) - centre_[k], f);
    if (spheres.rotates()) sum.torque = sum.torque + triple<double>(spheres.torque[i]);
  }
  sum.torque = sum.torque + sum.lever;
  return sum;
}

void Rocks::move(const Spheres& spheres, std::span<const Index> place, const LeapfrogStep& how) noexcept {
  for (Index k = 0; k < size(); ++k) {
    const Load sum = load(k, spheres, place);
    const double stopped = stopped_mass(k, sum);
    mass_share_[k] = {
        sum.stiffness > 0 ? stopped / sum.stiffness : 0,
        stopped / (sum.touching > 0 ? 1 + sum.touching : first_member_[k + 1] - first_member_[k])};
    force_[k] = sum.force;
    torque_[k] = sum.torque;
    velocity_[k] = velocity_[k] + ((how.kick / mass_[k]) * force_[k] + how.kick * how.gravity);
    centre_[k] = centre_[k] + how.step * velocity_[k];
    momentum_[k] = momentum_[k] + how.kick * torque_[k];
    orientation_before_[k] = orientation_[k];
    orientation_[k] = turned(orientation_[k], {momentum_[k], moments_[k], how.step});
  }
}

double Rocks::stopped_mass(Index k, const Load& load) const noexcept {
  if (load.pressure <= 0) return mass_[k];
  const double compliance = dot(load.force, load.force) / mass_[k] + dot(load.lever, spin_of(k, load.lever));
  return std::min(mass_[k], load.pressure * load.pressure / compliance);
}

Rocks::Stiffest Rocks::stiffest(const Spheres& spheres, std::span<const Index> place, double step) const {
  Stiffest worst;
  for (Index k = 0; k < size(); ++k) {
    double stiffness = 0;
    for (Index m = first_member_[k]; m < first_member_[k + 1]; ++m)
      stiffness += spheres.force[place[members_[m]]].w;
    const double lightest = std::min({moments_[k].x, moments_[k].y, moments_[k].z});
    double ratio = step * step * stiffness * (1 / mass_[k] + radius_[k] * radius_[k] / lightest);
    if (ratio > 1) ratio = exact_ratio(k, spheres, place, step);
    if (ratio > worst.ratio) worst = {k, ratio};
  }
  return worst;
}

double Rocks::exact_ratio(Index k, const Spheres& spheres, std::span<const Index> place, double step) const {
  // In principal axes, with displacements times sqrt(m) and turns times sqrt(I), the mass matrix is 1.
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
  const Eigen::Vector3d turning(1 / std::sqrt(moments_[k].x), 1 / std::sqrt(moments_[k].y),
                                1 / std::sqrt(moments_[k].z));
  for (Index m = first_member_[k]; m < first_member_[k + 1]; ++m) {
    const double own = spheres.force[place[members_[m]]].w;
    if (own <= 0) continue;
    const Triple<double>& r = member_offset_[m];
    Eigen::Matrix<double, 3, 6> moves;  // of the member's centre
    moves.leftCols<3>() = Eigen::Matrix3d::Identity() / std::sqrt(mass_[k]);
    moves.rightCols<3>() << 0, r.z, -r.y, -r.z, 0, r.x, r.y, -r.x, 0;
    moves.rightCols<3>() *= turning.asDiagonal();
    stiffness += own * moves.transpose() * moves;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> modes(stiffness, Eigen::EigenvaluesOnly);
  return step * step * modes.eigenvalues().maxCoeff();
}

Rocks::Energy Rocks::energy(Index k, const LeapfrogStep& last) const noexcept {
  const Triple<double> acceleration = (1 / mass_[k]) * force_[k] + last.gravity;
  const Triple<double> before = velocity_[k] - last.kick * acceleration;
  const Triple<double> momentum_before = momentum_[k] - last.kick * torque_[k];
  const Quaternion& then = last.kick > 0 ? orientation_before_[k] : orientation_[k];
  const Triple<double> w = angular_velocity(then, momentum_[k], moments_[k]),
                       turning = angular_velocity(then, torque_[k], moments_[k]);
  // As product_of_unequal_steps(), of turning.
  const double of_unequal_steps = (last.step - last.kick) * dot(torque_[k], w - (0.5 * last.step) * turning);
  const double product =
      dot(velocity_[k], before) - product_of_unequal_steps(last, velocity_[k], acceleration);
  return {0.5 * mass_[k] * product, 0.5 * (dot(w, momentum_before) - of_unequal_steps)};
}

}  // namespace talus::dem
