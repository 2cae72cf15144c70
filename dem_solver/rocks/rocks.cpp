#include "dem_solver/rocks/rocks.hpp"

#include <algorithm>

namespace talus::dem {

Rocks::Rocks(std::span<const RockInput> rocks, std::span<const SphereInput> spheres) : first_member_{0} {
  for (Index k = 0; k < static_cast<Index>(rocks.size()); ++k) {
    const RockInput& rock = rocks[k];
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
      radius_.back() = std::max(radius_.back(), length(arm) + spheres[id].radius);
    }
    first_member_.push_back(static_cast<Index>(members_.size()));
  }
  force_.resize(mass_.size());
  torque_.resize(mass_.size());
  orientation_before_ = orientation_;
}

double Rocks::place_members(Spheres& spheres, std::span<const Index> place) const noexcept {
  double largest = 0;
  for (Index k = 0; k < size(); ++k) {
    const Triple<double> w = spin(k);
    for (Index m = first_member_[k]; m < first_member_[k + 1]; ++m) {
      const Index i = place[members_[m]];
      const Triple<double> arm = rotate(orientation_[k], member_offset_[m]);
      const Triple<double> v = velocity_[k] + cross(w, arm);
      spheres.position[i] = row(centre_[k] + arm, spheres.position[i].w);
      spheres.velocity[i] = row(v, spheres.velocity[i].w);
      if (spheres.rotates()) spheres.spin[i] = row(w);
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
    sum.torque = sum.torque + cross(triple<double>(spheres.position[i]) - centre_[k], f);
    if (spheres.rotates()) sum.torque = sum.torque + triple<double>(spheres.torque[i]);
  }
  return sum;
}

void Rocks::move(const Spheres& spheres, std::span<const Index> place, const LeapfrogStep& how) noexcept {
  for (Index k = 0; k < size(); ++k) {
    const Load sum = load(k, spheres, place);
    force_[k] = sum.force;
    torque_[k] = sum.torque;
    velocity_[k] = velocity_[k] + ((how.kick / mass_[k]) * force_[k] + how.kick * how.gravity);
    centre_[k] = centre_[k] + how.step * velocity_[k];
    momentum_[k] = momentum_[k] + how.kick * torque_[k];
    orientation_before_[k] = orientation_[k];
    orientation_[k] = turned(orientation_[k], {momentum_[k], moments_[k], how.step});
  }
}

Rocks::Energy Rocks::energy(Index k, const LeapfrogStep& last) const noexcept {
  const Triple<double> acceleration = (1 / mass_[k]) * force_[k] + last.gravity;
  const Triple<double> before = velocity_[k] - last.kick * acceleration;
  const Triple<double> momentum_before = momentum_[k] - last.kick * torque_[k];
  const Triple<double> w =
      angular_velocity(last.kick > 0 ? orientation_before_[k] : orientation_[k], momentum_[k], moments_[k]);
  const double product =
      dot(velocity_[k], before) - product_of_unequal_steps(last, velocity_[k], acceleration);
  return {0.5 * mass_[k] * product, 0.5 * dot(w, momentum_before)};
}

}  // namespace talus::dem
