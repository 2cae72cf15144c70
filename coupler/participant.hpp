#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "core/output/source.hpp"
#include "interface_mesh/surface.hpp"

/// The coupling contract as a solver sees it. The coupler commands, the solver answers; a solver's whole
/// coupled life is
///
///     auto participant = Participant::join({.segment = name, .role = Role::structure});
///     participant->publish_surface(surface, node_masses);            // structure: what it moves
///     participant->declare({...});                                    // limits, effects, outputs
///     for (Command c = participant->next(); c.action != Action::finish; c = participant->next()) { ...;
///     participant->answer(); }
///
/// The particle side receives its boundary from the coupler (Ω_D, already tied to Ω_S) instead of publishing
/// one.
namespace talus::coupler {

enum class Role : std::uint32_t { structure = 0, particles = 1 };

enum class Action : std::uint32_t {
  advance,        ///< compute window `window` from its start; the received fields are those of this iteration
  save_state,     ///< remember the present state; it is the start of a window
  restore_state,  ///< go back to the state remembered last
  report,         ///< fill the output values: probes, ledger, and where `fields` is set the field frames
  write_checkpoint,  ///< write the state to `path`; no file there after the answer: it could not be written
  read_checkpoint,   ///< replace the state by that in `path`; before the first window only
  finish,            ///< no more commands; leave
};

/// One command. Time is counted in integers, never accumulated; windows may differ in length from one to the
/// next.
struct Command {
  Action action = Action::finish;
  bool fields = false;         ///< report: field frames are wanted too
  bool tentative = false;      ///< advance: the window may be taken back; its work is booked by the coupler
  std::int64_t window = 0;     ///< index of the regular window in which this one begins, from 0
  std::int32_t iteration = 0;  ///< of a strong scheme, from 0
  double time = 0;             ///< s; the start of the window
  double length = 0;           ///< s; of the window
  double regular_length = 0;   ///< s; of a window in which nothing makes the coupler choose another
  double force_shift = 0;      ///< s; advance of particles: how much earlier than the window the interval
                               ///< begins and ends over which the mean of the forces is wanted
  std::string path{};          ///< of a checkpoint
};

/// What a structure does with the forces of a window, which is the time level it wants them at.
enum class ForceUse : std::uint32_t {
  /// Kicks at the start of each of its steps (leapfrog). A kick covers half a step before and after it, so all
  /// of them together cover the window moved back by half a step.
  kicks,
  /// A load over the window, no more and no less (implicit methods).
  load
};

/// A limit of the solver's step, as `talus check` lists it.
struct StepLimit {
  std::string name;       ///< "contact dashpot on node masses"
  double seconds = 0;     ///< largest step that keeps it
  bool stability = true;  ///< false: exceeding it costs accuracy only, a warning
  std::string reason;     ///< the formula and the entity that sets it
};

/// An effect of the program, as `talus explain` lists it.
struct Effect {
  std::string name;  ///< "friction"
  bool present = false;
  std::string reason;  ///< "particles.contacts[0].friction is given" or what the scene would have to name
  // What `talus explain` of a result needs to advise; empty where the effect has no such thing.
  std::string key = {};          ///< of the scene, which names it: "particles.contacts[0].friction"
  std::string ledger_line = {};  ///< whose energy appears where it acts: "structure.bulk_damping_J"
  /// It may act without doing work, as friction that holds a block at rest: only where its line stays at round-off has
  /// it not acted.
  bool may_hold = false;
  /// What is exceeded where it is missing: the name of a step limit, or "compression of <group>" of the field output.
  std::string limit = {};
};

/// What a participant says of itself before time 0.
struct Declaration {
  std::string program;  ///< "fem_solver 0.1.0"
  double step = 0;      ///< s; its own step inside a window; 0: one step a window, whatever its length
  bool insists_on_step =
      false;  ///< the scene allows a step above a stability limit; else the coupler refuses it before time 0
  bool free_velocity = false;  ///< structure: it can fill StructureFields::free_velocity; particles: they
                               ///< need it
  bool light_boundary =
      false;  ///< particles: they can fill ParticleFields::moved_displacement and moved_velocity
  bool loses_cells = false;  ///< structure: cells of Ω_S may break; it fills StructureFields::lost
  bool checkpoints = false;  ///< it answers write_checkpoint and read_checkpoint
  ForceUse force_use = ForceUse::kicks;  ///< structure
  std::vector<StepLimit> limits{};
  std::vector<Effect> effects{};
  core::OutputDescription outputs{};
  std::vector<std::string> warnings{};  ///< that it has shown so far, for log.txt and the summary

  /// In a window of this length (s).
  std::int64_t steps_in(double window_length) const;
  bool takes_several_steps(double window_length) const { return steps_in(window_length) > 1; }
  /// s; Command::force_shift of a window of this length, where this is the structure.
  double force_shift(double window_length) const;
};

/// Interface values of one window, at the nodes of this side's surface, 3 a node. The structure's
/// displacement and velocity hold its present state at every answer, so also after `restore_state`,
/// `read_checkpoint` and a `report` before the first window.
struct StructureFields {
  std::span<const double> force;    ///< N; mean over the interval that Declaration::force_use stands for
  std::span<double> displacement;   ///< m; at the window's end
  std::span<double> velocity;       ///< m/s; at the window's end (explicit leapfrog: half a step before)
  std::span<double> free_velocity;  ///< m/s; a step after `velocity`, if no interface force acted in between;
                                    ///< empty where the particles do not need it
  /// 1 for each cell of Ω_S that has broken, segments before triangles, at every answer; else 0. Empty: the structure
  /// has not declared that it loses cells.
  std::span<double> lost;
};
/// The boundary is given at both ends of the window where the particles take several steps in it, or where the
/// structure wants forces of another time than the window's start; else the two end arrays are empty (they are
/// not computed). Between the ends it moves on the parabola through both ends whose velocity changes by
/// end_velocity - start_velocity.
struct ParticleFields {
  std::span<const double> start_displacement;  ///< m; of Ω_D at the window's start
  std::span<const double> start_velocity;      ///< m/s
  std::span<const double>
      end_displacement;                  ///< m; predicted or iterated for the window's end; empty: not needed
  std::span<const double> end_velocity;  ///< m/s; likewise
  std::span<const double> free_velocity;  ///< m/s; the boundary's a step after start_velocity if nothing
                                          ///< touched it; empty where it was not asked for
  /// Where Ω_D is at the window's end if it moves as given and each node, besides, answers to its contact
  /// forces with its mass alone (m, m/s). Empty: Ω_D moves as given, whatever the forces.
  std::span<double> moved_displacement, moved_velocity;
  std::span<const double>
      lost;  ///< 1 for each cell of Ω_D that is gone, segments before triangles; empty: none can be
  std::span<double> force;  ///< N; that Ω_D receives, mean over the window moved back by Command::force_shift
};

struct JoinOptions {
  std::string segment;
  Role role = Role::structure;
  double timeout = 60;  ///< s without any sign of the coupler before a wait gives up
};

class Participant {
 public:
  /// @throws TransportError if the segment is missing, of another layout version, or smaller than it claims.
  static std::unique_ptr<Participant> join(const JoinOptions& options);
  virtual ~Participant() = default;

  // Before time 0, in this order. Calls out of order throw UsageError. A scene without an `interface` goes
  // the same way, with a surface of no nodes.
  /// Structure only. @pre masses.size() == surface.node_count(); kg
  virtual void publish_surface(const mesh::Surface& surface, std::span<const double> node_masses) = 0;
  /// Particles only: Ω_D and the mass that moves behind each of its nodes (kg). Blocks until the structure
  /// has published.
  virtual mesh::Surface receive_surface(std::vector<double>& node_masses) = 0;
  virtual void declare(const Declaration& declaration) = 0;

  /// The next command; blocks, sleeping. @throws TransportError if the coupler is gone or silent.
  virtual Command next() = 0;
  /// Ends the command that next() returned; the sent fields are read by the coupler from here on.
  virtual void answer() = 0;
  /// Says why this participant cannot go on. The coupler stops the run and shows the message; call it before
  /// leaving with an error.
  virtual void fail(const std::exception& error) noexcept = 0;

  // Valid from the first next() on, for the participant's life.
  virtual StructureFields structure_fields() = 0;
  virtual ParticleFields particle_fields() = 0;
  /// Where report() puts its values.
  virtual std::span<double> probes() = 0;
  virtual std::span<double> ledger() = 0;
  virtual std::span<double> positions(std::size_t group) = 0;
  virtual std::span<double> field(std::size_t group, std::size_t field) = 0;
  virtual std::span<double> table(std::size_t table) = 0;  ///< room for all rows it may ever have
  virtual double& table_rows(std::size_t table) = 0;       ///< how many it has
  /// How often all forces were evaluated since the start, those of windows that were taken back included: a
  /// cost that does not depend on the machine, for the summary. Between next() and answer(), by who counts.
  virtual void tell_force_evaluations([[maybe_unused]] std::int64_t since_start) {}
  /// The work (J) of the window's forces on this side's surface, by whoever keeps a ledger of it: between an
  /// `advance` and its answer. Of a side that does not tell it is summed from forces and displacements.
  virtual void book_work([[maybe_unused]] double of_this_window) {}
};

/// The whole coupled life of a program: joins, serves, and tells the coupler what `serve` throws, which then
/// says it to the user. Only where the coupler itself is gone does this program say so. Never throws but what
/// join() throws.
core::ExitCode take_part(const JoinOptions& options, const std::function<void(Participant&)>& serve);

/// Answers write_checkpoint by `write`, which gets the path. Where the system refuses the file, this says so and
/// leaves none: the coupler then goes on without this checkpoint.
void write_checkpoint(const Command& command, const std::function<void(const std::filesystem::path&)>& write);

/// Answers write_checkpoint and read_checkpoint for a state that is one block of plain memory; does nothing
/// for other commands. @throws ConfigError where the checkpoint holds a state of another size or cannot be
/// read
void checkpoint_state(const Command& command, std::span<std::byte> state);

/// Answers Action::report from a source; the same for every solver.
void report(Participant& participant, const Command& command, const core::OutputSource& source);

}  // namespace talus::coupler
