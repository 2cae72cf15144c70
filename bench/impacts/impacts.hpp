#pragma once

#include <string>
#include <vector>

/// The eight impacts of Chung and Ooi, "Benchmark tests for verifying discrete element modelling codes at
/// particle impact level", Granular Matter 13 (2011) 643, each against what theory says about it.
///
/// | test | what                                       | theory                                             |
/// |------|--------------------------------------------|----------------------------------------------------|
/// | 1    | two equal spheres head on, elastic         | Hertz: overlap, force, duration                    |
/// | 2    | sphere on a rigid plane, elastic           | the same                                           |
/// | 3    | sphere on a plane, damped                  | the restitution asked for                          |
/// | 4    | oblique on a plane, 3.9 m/s at any angle   | gross sliding; else the law, integrated apart      |
/// | 5    | oblique, 5 m/s normal, any tangential      | the same                                           |
/// | 6    | spinning onto a plane, 0.2 m/s             | the same                                           |
/// | 7    | equal spheres spinning against each other  | no slip, so nothing changes                        |
/// | 8    | small spinning sphere onto a large one     | the same                                           |
///
/// Gross sliding, for an impact that slides to its end, slip > 7/2 mu (1 + e) vn: with R*, m* of the pair the
/// tangential impulse is mu (1 + e) m* vn, so
///     v_t' = v_t - mu (1 + e) vn m*/m        R w' = R w + 5/2 mu (1 + e) vn m*/m.
/// Impacts that stick have no closed form: their law is integrated once more in scalars (Oblique in impacts.cpp),
/// and of the impulse J on the sphere v_t' = v_t + J/m, R w' = R w - 5/2 J/m.
namespace talus::bench {

struct ImpactResult {
  int test = 0;
  std::string situation;
  std::string quantity;
  double computed = 0, expected = 0;
  double scale = 0;      ///< what the error is relative to
  double tolerance = 0;  ///< of the error

  double error() const { return (computed - expected) / scale; }
  bool passes() const { return error() <= tolerance && -error() <= tolerance; }
};

/// Runs all impacts.
std::vector<ImpactResult> run_impacts();

}  // namespace talus::bench
