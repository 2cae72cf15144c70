#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/reader.hpp"
#include "core/scene/sections.hpp"
#include "fem_solver/assembly/assembly.hpp"
#include "fem_solver/integration/integrator.hpp"
#include "fem_solver/integration/mass_scaling.hpp"
#include "fem_solver/integration/step_limit.hpp"
#include "fem_solver/output/structure_output.hpp"
#include "fem_solver/scene/structure_scene.hpp"

namespace talus::fem {

/// The sections of a scene that the structural solver reads.
struct StructuralScene {
  core::TimeScene time;
  core::OutputScene output;
  StructureScene structure;
};
/// @throws core::ConfigError with every complaint about these sections
StructuralScene read_structural_scene(const core::SceneFile& file);
/// The section's page of the schema.
std::string structure_schema();

/// An effect the program has, in the scene or not, and why.
struct StructuralEffect {
  std::string name;
  bool present = false;
  std::string reason;
  std::string key = {};          ///< that names it
  std::string ledger_line = {};  ///< whose energy appears where it acts; empty where it may act without work
  std::string limit = {};        ///< "compression of net", where it takes compression away
};

/// A structure ready to run: everything that is made of the scene before time 0.
class Structure {
 public:
  /// @throws core::ConfigError for what cannot be built, and for an explicit step above the limit of
  /// stability
  explicit Structure(const StructuralScene& scene);

  const Model& model() const { return model_; }
  const State& start() const { return start_; }  ///< where time 0 finds it
  Integrator& integrator() { return *integrator_; }
  const Integrator& integrator() const { return *integrator_; }
  /// Parts whose nodes receive forces from outside, in the order their nodes are published.
  void make_interface(const std::vector<Index>& nodes);
  /// Makes the output; the interface must be known by then.
  const StructureOutput& output();

  /// The whole state, bit for bit. @throws std::runtime_error, core::ConfigError
  void write_checkpoint(const std::filesystem::path& path);
  void read_checkpoint(const std::filesystem::path& path);

  double step() const { return step_; }  ///< s
  /// Whether the forces of a window are a load over it, and not kicks at the starts of its steps.
  bool is_implicit() const { return implicit_; }
  const std::vector<StepBound>& bounds() const { return bounds_; }  ///< the one that counts first
  const AddedMass& added_mass() const { return added_mass_; }
  std::vector<StructuralEffect> effects(const StructureScene& scene) const;

 private:
  void check_step(const StructureScene& scene) const;

  Model model_;
  AddedMass added_mass_;  ///< by mass scaling
  Assembly assembly_;
  State start_;  ///< at time 0
  std::vector<StepBound> bounds_;
  double step_ = 0;
  bool implicit_ = false;
  std::unique_ptr<Integrator> integrator_;
  core::OutputScene output_scene_;
  std::unique_ptr<core::StageClock> clock_;  ///< nullptr: the scene does not ask for stage times
  std::unique_ptr<StructureOutput> output_;
};

}  // namespace talus::fem
