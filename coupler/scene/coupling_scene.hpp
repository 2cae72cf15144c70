#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "core/scene/fields.hpp"
#include "coupler/schemes/unknowns.hpp"
#include "coupler/session/introduction.hpp"

/// `coupling:` how often and in which order the two sides hear of each other.
namespace talus::coupler {

/// `serial_explicit: {}` and `parallel_explicit: {}` have nothing to choose.
struct SerialExplicitScene {};
void describe(core::Fields& fields, SerialExplicitScene& scheme);
struct ParallelExplicitScene {};
void describe(core::Fields& fields, ParallelExplicitScene& scheme);

struct FixedScene {
  double factor = 0.5;
};
void describe(core::Fields& fields, FixedScene& acceleration);
struct AitkenScene {
  double initial = 0.5;
};
void describe(core::Fields& fields, AitkenScene& acceleration);
struct IqnIlsScene {
  double initial = 0.5;
  std::int64_t columns = 50;
  std::int64_t windows = 8;
  double filter = 1e-6;
};
void describe(core::Fields& fields, IqnIlsScene& acceleration);
using AccelerationScene = std::variant<std::monostate, FixedScene, AitkenScene, IqnIlsScene>;

struct ToleranceScene {
  double relative = 1e-6;
  double displacement = 1e-12;  ///< m
  double velocity = 1e-9;       ///< m/s
  double force = 1e-9;          ///< N
};
void describe(core::Fields& fields, ToleranceScene& tolerance);

/// What both strong schemes have in common.
struct ImplicitScene {
  enum class NotConverged { error, warning };
  Predictor predictor = Predictor::linear;
  std::optional<ToleranceScene> tolerance;
  std::int64_t iterations = 50;
  std::optional<double> shortest_window;  ///< s; absent: no window is halved
  NotConverged not_converged = NotConverged::error;
  AccelerationScene acceleration;
};
struct SerialImplicitScene {
  enum class Relax { motion, force, free_motion };
  Relax relax = Relax::motion;
  ImplicitScene common;
};
void describe(core::Fields& fields, SerialImplicitScene& scheme);
struct ParallelImplicitScene {
  ImplicitScene common;
};
void describe(core::Fields& fields, ParallelImplicitScene& scheme);

using SchemeScene = std::variant<std::monostate, SerialExplicitScene, ParallelExplicitScene,
                                 SerialImplicitScene, ParallelImplicitScene>;
/// The key of the scheme: "serial_explicit" where none is named.
const char* name_of(const SchemeScene& scheme);

struct CouplingScene {
  std::optional<double> window;          ///< s; absent: time.step
  std::optional<double> longest_window;  ///< s; absent: all are equal
  double timeout = 300;                  ///< s
  double join_timeout = 60;              ///< s
  /// s of wall time between checkpoints; absent: one where the run is interrupted
  std::optional<double> checkpoint_every;
  SchemeScene scheme;  ///< absent: serial_explicit

  Order order() const;
  /// Of a strong scheme, else none.
  const ImplicitScene* implicit() const;
};
void describe(core::Fields& fields, CouplingScene& coupling);

}  // namespace talus::coupler
