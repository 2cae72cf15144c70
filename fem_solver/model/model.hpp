#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "fem_solver/model/breaking_rope_batch.hpp"
#include "fem_solver/model/configuration.hpp"
#include "fem_solver/model/frictional_cable_batch.hpp"
#include "fem_solver/model/membrane_batch.hpp"
#include "fem_solver/model/obstacle_batch.hpp"
#include "fem_solver/model/path_batch.hpp"
#include "fem_solver/model/penalty_slide_batch.hpp"
#include "fem_solver/model/ring_batch.hpp"
#include "fem_solver/model/rope_batch.hpp"
#include "fem_solver/model/two_node_batch.hpp"
#include "fem_solver/model/user_batch.hpp"

/// The structure as arrays: what the scene describes, free of YAML, time integration and output.
namespace talus::fem {

/// The elements of one part. Every alternative offers, for a Configuration `at`:
///   called()                               what messages call its elements: "bars"
///   size(), slots()                        elements, and force vectors they write
///   for_each_incidence(visit)              visit(node, slot, sign): which slots sum up to a node's force, in
///                                          a fixed order
///   internal_force(at, slots, range)       dU/du of the elements of a range (N); noexcept, no allocation
///   stiffness_product(at, w, slots, range) (d2U/du2) w
///   stiffness(at, sink)                    d2U/du2 as 3x3 blocks
///   damping_product(at, v, slots, range)   what resists the rate of strain, per second of stiffness damping: the
///                                          stiffness of the material alone times velocities, never negative work,
///                                          none in what is slack, no moment on a rigid motion
///   damping_matrix(at, sink)               the same as 3x3 blocks, in the order of stiffness()
///   energy(at)                             U (J), zero at the reference state
///   add_stiffness_bound(at, row_sums)      sizes of the numbers in each row of d2U/du2, summed, with everything taut
///                                          that may become taut (N/m, 3 a node)
///   add_mass(node_masses)                  lumped (kg)
/// What elements remember besides: Remembers in configuration.hpp.
using ElementBatch =
    std::variant<BarBatch, CableBatch, SlidingCableBatch, PlainMembraneBatch, TensionFieldBatch,
                 PrincipalTensionFieldBatch, FrictionalCableBatch, BrakeBatch, ElasticPlasticBatch,
                 BreakingCableBatch, BreakingElasticPlasticBatch, BreakingBrakeBatch, BreakingRopeBatch,
                 BreakingFrictionalCableBatch, PlainRingBatch, BreakingRingBatch, PenaltySlideBatch,
                 ObstacleBatch, UserLineBatch, UserTriangleBatch>;

struct Part {
  std::string name;
  ElementBatch elements;
  std::vector<Index> nodes;      ///< that its elements touch, ascending
  double breaking_load = 0;      ///< N; 0: not known
  double buckling_load = 0;      ///< N; of its longest element by Euler; 0: not known
  double stiffness_damping = 0;  ///< s; times damping_product(); lowers the step limit
  std::string scene_part = {};   ///< key of the scene's part; a net with double twists makes two parts of one
  double wire_radius = 0;        ///< m; of what a rock touches, where the part's shape knows it
};

/// A factor over time, linear between its points and constant beyond them; empty: 1.
struct TimeTable {
  std::vector<std::pair<double, double>> points;  ///< s, factor; ascending
  double at(double time) const;
  /// Its derivative just after a time (1/s).
  double rate_after(double time) const;
};

/// Nodes whose motion is given in some directions.
struct Support {
  std::string name;
  std::vector<Index> nodes;
  std::array<bool, 3> fixed{};
  Vector3 displacement = Vector3::Zero();  ///< m; times `history`
  TimeTable history;
  bool moves() const { return !displacement.isZero(0); }
};

/// The same force on each of some nodes.
struct NodalLoad {
  std::string name;
  std::vector<Index> nodes;
  Vector3 force = Vector3::Zero();  ///< N on each node; times `history`
  TimeTable history;
};

/// The same velocity of some nodes at the start.
struct InitialVelocity {
  std::vector<Index> nodes;
  Vector3 velocity = Vector3::Zero();  ///< m/s
};

/// The same displacement of some nodes at the start.
struct InitialDisplacement {
  std::vector<Index> nodes;
  Vector3 displacement = Vector3::Zero();  ///< m
};

/// Nodes held on a rope of other elements by multi-point constraints.
struct ConstrainedSlide {
  std::string name;
  SlideLine line;
};

struct Model {
  std::vector<double> reference;    ///< m; node positions, 3 a node
  std::vector<double> node_masses;  ///< kg; what inertia meets: elements, point masses, what scaling added
  std::vector<double> weight;       ///< N, 3 a node; times `gravity_history`; empty: nothing weighs
  TimeTable gravity_history;
  std::vector<double> damping_rates;  ///< 1/s, of each node: force against velocity per mass; empty: none
  std::vector<Part> parts;
  std::map<std::string, std::vector<Index>> node_sets;
  std::vector<Support> supports;
  std::vector<NodalLoad> loads;
  std::vector<InitialDisplacement> initial_displacements;
  std::vector<InitialVelocity> initial_velocities;
  std::vector<ConstrainedSlide> constrained_slides;

  Index nodes() const { return static_cast<Index>(reference.size() / 3); }
  Vector3 position(Index node) const { return Vector3::Map(&reference[3 * static_cast<std::size_t>(node)]); }
};

/// What the elements remember before the first step, part by part; empty where nothing remembers.
std::vector<double> initial_memory(const Model& model);

/// How many numbers of memory a batch has.
template <class Batch>
std::size_t memory_size_of(const Batch& batch) {
  if constexpr (Remembers<Batch>)
    return batch.memory_size();
  else
    return 0;
}
/// visit(number of the part, batch, the part's own configuration) for every part in turn.
template <class Visit>
void for_each_part(const Model& model, const Configuration& at, const Visit& visit) {
  std::size_t begin = 0;
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    std::visit(
        [&](const auto& batch) {
          const std::size_t size = memory_size_of(batch);
          const auto own = at.memory.empty() ? at.memory : at.memory.subspan(begin, size);
          visit(p, batch, Configuration(at.displacement, own));
          begin += size;
        },
        model.parts[p].elements);
}

/// What the elements of one part are asked at.
Configuration configuration_of(const Model& model, const Part& part, const Configuration& at);

/// What each part stores (J).
std::vector<double> elastic_by_parts(const Model& model, const Configuration& at);
/// What each part has dissipated by friction or plastic work (J), 0 for those that do not.
std::vector<double> dissipated_by_parts(const Model& model, const Configuration& at);
/// Whether a part can dissipate.
bool dissipates(const ElementBatch& elements);

/// 3 a node (N/m): no motion with masses m has a higher frequency than the largest sqrt(sum/m) over the directions
/// (Gershgorin's theorem on M^-1 K), whatever of the structure is taut.
std::vector<double> stiffness_bounds(const Model& model, const Configuration& at);

/// Sums node_masses from the elements. Point masses are added by whoever knows them.
void lump_masses(Model& model);
/// Gives all masses the same gravity (m/s^2).
void weigh(Model& model, const Vector3& gravity);
/// The same stiffness damping for all parts (s), the largest of all parts.
void damp_by_stiffness(Model& model, double seconds);
double largest_stiffness_damping(const Model& model);

/// "node 17 of net at (1.5, 1.5, 0) m"
std::string node_name(const Model& model, Index node);

}  // namespace talus::fem
