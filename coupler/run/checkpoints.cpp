#include "coupler/run/checkpoints.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "core/errors.hpp"
#include "core/output/checkpoint.hpp"
#include "core/output/file.hpp"
#include "core/program/log.hpp"
#include "core/units/units.hpp"
#include "coupler/schemes/commands.hpp"

namespace talus::coupler {
namespace {

namespace fs = std::filesystem;

constexpr const char* owner = "talus run";
constexpr const char *checkpoint = "checkpoint.h5", *checkpoint_before = "checkpoint_before.h5";

/// A participant's own file, between it and the checkpoint.
struct Part {
  Part(const Peer& peer, const fs::path& folder)
      : name(name_of(peer.role())),
        path(fs::absolute(folder / (std::string("checkpoint_of_") + name + ".part"))) {
    remove();  // an older one must not pass for that of a participant which writes none
  }
  ~Part() { remove(); }
  Part(const Part&) = delete;
  void remove() const {
    std::error_code ignored;
    fs::remove(path, ignored);
  }

  std::string name;
  fs::path path;
};

std::vector<std::byte> bytes_of(const Part& part) {
  std::ifstream file(part.path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file)
    throw core::FileError("the " + part.name +
                          " could not write its part of the checkpoint: its warning says why");
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

void write_bytes(const fs::path& path, const std::vector<std::byte>& bytes) {
  core::OutputFile file(path, core::OutputFile::Mode::create);
  file.write_at(0, bytes);
  file.close();
}

void write_identity(core::CheckpointWriter& writer, const RunIdentity& identity) {
  writer.text("scene_hash", identity.scene_hash);
  writer.text("scheme", identity.scheme);
  writer.text("programs", text_of(identity.programs));
  writer.text("scene", text_of(identity.scene));
}

/// Says which other one there is where this one cannot be read.
std::unique_ptr<core::CheckpointReader> opened(const fs::path& file) {
  try {
    return std::make_unique<core::CheckpointReader>(file, owner);
  } catch (const core::ConfigError& error) {
    const fs::path before = file.parent_path() / checkpoint_before;
    std::error_code absent;
    if (file.filename() == checkpoint_before || !fs::exists(before, absent)) throw;
    throw core::ConfigError(fmt::format("{}; the checkpoint before it is {}", error.what(), before.string()));
  }
}

Command about_checkpoint(const Window& window, Action action, const fs::path& path) {
  Command command = command_at(window, action);
  command.path = path.string();
  return command;
}

}  // namespace

std::string without_checkpoints(Session& session) {
  std::string names;
  for (const Peer* peer : session.peers())
    if (!peer->declaration().checkpoints) names += (names.empty() ? "" : ", ") + peer->declaration().program;
  return names;
}

Checkpoints::Checkpoints(Session& session, Plan plan, ArchiveOwnState archive)
    : session_(session),
      plan_(std::move(plan)),
      archive_(std::move(archive)),
      possible_(without_checkpoints(session).empty()) {}

void Checkpoints::at(std::int64_t window) {
  if (!plan_.every || std::chrono::duration<double>(Clock::now() - last_).count() < *plan_.every) return;
  try {
    write(window);
    failing_ = false;
  } catch (const core::MachineError& error) {
    if (!failing_)
      core::log_warning(fmt::format("no checkpoint at {}, the run goes on without: {}",
                                    core::readable(plan_.span.window(window).start(), "s"), error.what()));
    failing_ = true;
    last_ = Clock::now();
  }
}

void Checkpoints::write(std::int64_t window) {
  if (!possible_) return;
  core::CheckpointWriter writer(plan_.folder / checkpoint, owner);
  if (plan_.identity) write_identity(writer, identity_ ? *identity_ : identity_.emplace(plan_.identity()));
  std::vector<double> window_length{plan_.span.window_length};
  writer.count("window", window);
  writer.values("window_length", window_length);
  for (Peer* peer : session_.peers()) {
    const Part part(*peer, plan_.folder);
    session_.ask(*peer, about_checkpoint(plan_.span.window(window), Action::write_checkpoint, part.path));
    writer.bytes(part.name, bytes_of(part));
  }
  archive_(writer);  // last: with this command the particles have booked the work of the last window
  writer.commit({.durability = core::Durability::power_loss, .before = plan_.folder / checkpoint_before});
  last_ = Clock::now();
}

RestartPoint::RestartPoint(const fs::path& file, const Span& span)
    : file_(file), span_(span), reader_(opened(file)) {
  std::vector<double> window_length(1);
  reader_->count("window", window_);
  reader_->values("window_length", window_length);
  if (window_length.front() != span.window_length)
    throw core::ConfigError(
        fmt::format("{} was written by a run with windows of {:g} s, this scene has windows of {:g} s; only "
                    "equal ones can be counted on",
                    file.string(), window_length.front(), span.window_length));
  if (window_ > span.windows())
    throw core::ConfigError(
        fmt::format("time.end: {:g} s lies before the time of the checkpoint {}, {:g} s; give a later end",
                    span.end, file.string(), static_cast<double>(window_) * span.window_length));
}

void RestartPoint::compare(const RunIdentity& now) {
  const auto scene = reader_->text("scene");
  if (!scene) {
    core::log_warning(file_.string() + " does not say which scene it was written for; it is taken on trust");
    return;
  }
  FlatScene before = flat_scene(reader_->text("programs").value_or("")), present = now.programs;
  before["coupling scheme"] = reader_->text("scheme").value_or("");
  present["coupling scheme"] = now.scheme;
  before.merge(flat_scene(*scene));
  present.insert(now.scene.begin(), now.scene.end());
  const SceneDifference different = difference(before, present);
  if (!different.changed.empty())
    core::log_warning("the run goes on with other values than the checkpoint was written with:" +
                      lines_of(different.changed));
  if (different.state.empty()) return;
  throw core::ConfigError(
      "a restart has the state from the checkpoint, so a change of it in the scene would have no effect; "
      "take "
      "these back, or start from time 0:" +
      lines_of(different.state));
}

RestartPoint::~RestartPoint() = default;

void RestartPoint::restore(Session& session, const fs::path& folder, const ArchiveOwnState& archive) {
  for (Peer* peer : session.peers()) {
    const Part part(*peer, folder);
    write_bytes(part.path, reader_->bytes(part.name));
    session.ask(*peer, about_checkpoint(span_.window(window_), Action::read_checkpoint, part.path));
  }
  archive(*reader_);
}

}  // namespace talus::coupler
