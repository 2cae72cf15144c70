#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dem_solver/contact/touch.hpp"

/// Materials and what each pair of them means for the contact laws, computed once.
namespace talus::dem {

struct Material {
  std::string name;
  double density = 0;         ///< kg/m^3; 0 for a material of boundaries only
  double youngs_modulus = 0;  ///< Pa
  double poissons_ratio = 0;
};

struct HertzContact {
  double restitution = 1;  ///< in (0, 1]
};
struct HystereticContact {
  double restitution = 1;  ///< in (0, 1]
};
struct FoundationContact {
  double stiffness_per_area = 0;  ///< Pa/m
  double tangential_ratio = 1;    ///< tangential over normal stiffness
  double restitution = 1;         ///< in (0, 1]
};
struct LinearContact {
  double stiffness = 0;         ///< N/m
  double tangential_ratio = 1;  ///< tangential over normal stiffness
  double restitution = 1;       ///< in (0, 1]
};
struct FrictionCoefficients {
  double at_rest = 0;
  double sliding = 0;
  double decay_speed = 0;  ///< m/s; 0: the coefficient does not depend on the speed
};
struct RollingCoefficients {
  double friction = 0;  ///< mu_r, 1
  double damping = 0;   ///< of type C, over critical damping
};

/// 1/E* = (1-va^2)/Ea + (1-vb^2)/Eb, 1/G* = (2-va)/Ga + (2-vb)/Gb, G = E/(2(1+v)) [Hertz; Mindlin 1949].
struct EffectiveModuli {
  double normal = 0;  ///< E*, Pa
  double shear = 0;   ///< G*, Pa
};
EffectiveModuli effective_moduli(const Material& a, const Material& b) noexcept;

PairParameters pair_parameters(const HertzContact& contact, const EffectiveModuli& moduli) noexcept;
PairParameters pair_parameters(const HystereticContact& contact, const EffectiveModuli& moduli) noexcept;
PairParameters pair_parameters(const FoundationContact& contact) noexcept;
PairParameters pair_parameters(const LinearContact& contact) noexcept;
void set_friction(PairParameters& parameters, const FrictionCoefficients& friction) noexcept;
void set_rolling(PairParameters& parameters, const RollingCoefficients& rolling) noexcept;

/// The parameters of every pair of materials, symmetric. A pair that the scene does not name is found before
/// time 0 (scene/).
class PairTable {
 public:
  explicit PairTable(Index materials = 0)
      : materials_(materials), rows_(static_cast<std::size_t>(materials) * materials) {}
  void set(Index a, Index b, const PairParameters& parameters) {
    rows_[index(a, b)] = parameters;
    rows_[index(b, a)] = parameters;
  }
  TALUS_INLINE const PairParameters& operator()(Index a, Index b) const noexcept {
    return rows_[index(a, b)];
  }
  Index materials() const noexcept { return materials_; }

 private:
  std::size_t index(Index a, Index b) const noexcept { return static_cast<std::size_t>(a) * materials_ + b; }
  Index materials_;
  std::vector<PairParameters> rows_;
};

}  // namespace talus::dem
