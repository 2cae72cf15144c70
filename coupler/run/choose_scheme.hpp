#pragma once

#include <utility>
#include <variant>

#include "coupler/acceleration/iqn_ils.hpp"
#include "coupler/acceleration/relaxation.hpp"
#include "coupler/scene/coupling_scene.hpp"
#include "coupler/schemes/implicit.hpp"
#include "coupler/schemes/parallel_explicit.hpp"
#include "coupler/schemes/serial_explicit.hpp"

/// From a scene's choice to the types that compute it: all combinations of scheme, unknown and acceleration.
namespace talus::coupler {

inline Convergence convergence_of(const ImplicitScene& scene, std::int64_t most_halvings) {
  const ToleranceScene tolerance = scene.tolerance.value_or(ToleranceScene{});
  return {.relative = tolerance.relative,
          .absolute = {tolerance.displacement, tolerance.velocity, tolerance.force},
          .most_iterations = static_cast<int>(scene.iterations),
          .most_halvings = most_halvings,
          .fail_otherwise = scene.not_converged == ImplicitScene::NotConverged::error};
}

inline NoAcceleration make_acceleration(std::monostate) {
  return {};
}
inline FixedRelaxation make_acceleration(const FixedScene& scene) {
  return {.factor = scene.factor};
}
inline Aitken make_acceleration(const AitkenScene& scene) {
  return Aitken(scene.initial);
}
inline IqnIls make_acceleration(const IqnIlsScene& scene) {
  return IqnIls({.initial_factor = scene.initial,
                 .most_columns = static_cast<std::size_t>(scene.columns),
                 .reused_windows = scene.windows,
                 .filter = scene.filter});
}

/// What a scheme needs besides its own section.
struct SchemeFacts {
  double node_mass = 0;            ///< kg; mean mass behind a node of Ω_D
  std::int64_t most_halvings = 0;  ///< of a window that does not converge
};

/// Calls `use(scheme)` with the scheme that the scene names.
template <class Use>
class SchemeChoice {
 public:
  SchemeChoice(Exchange& exchange, const SchemeFacts& facts, Use use)
      : exchange_(exchange), facts_(facts), use_(std::move(use)) {}

  void operator()(std::monostate) { (*this)(SerialExplicitScene{}); }
  void operator()(const SerialExplicitScene&) { use_once(SerialExplicit{}); }
  void operator()(const ParallelExplicitScene&) { use_once(ParallelExplicit{}); }
  void operator()(const SerialImplicitScene& scene) {
    switch (scene.relax) {
      case SerialImplicitScene::Relax::motion:
        return use_implicit(MotionUnknown(exchange_), scene.common);
      case SerialImplicitScene::Relax::force:
        return use_implicit(ForceUnknown(exchange_), scene.common);
      case SerialImplicitScene::Relax::free_motion:
        return use_implicit(FreeMotionUnknown(exchange_), scene.common);
    }
  }
  void operator()(const ParallelImplicitScene& scene) {
    use_implicit(MotionAndForceUnknown(exchange_, facts_.node_mass), scene.common);
  }

 private:
  template <class Scheme>
  void use_once(Scheme scheme) {
    use_(scheme);
  }
  template <class Unknown>
  void use_implicit(Unknown unknown, const ImplicitScene& scene) {
    std::visit(
        [&](const auto& acceleration) {
          use_once(Implicit(std::move(unknown), make_acceleration(acceleration),
                            convergence_of(scene, facts_.most_halvings), scene.predictor));
        },
        scene.acceleration);
  }

  Exchange& exchange_;
  SchemeFacts facts_;
  Use use_;
};

}  // namespace talus::coupler
