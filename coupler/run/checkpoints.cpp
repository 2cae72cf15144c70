#include "coupler/run/checkpoints.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "core/errors.hpp"
#include "core/output/checkpoint.hpp"
#include "coupler/schemes/commands.hpp"

namespace talus::coupler {
namespace {

namespace fs = std::filesystem;

constexpr const char* owner = "talus run";

/// A participant's own file, between it and the checkpoint.
struct Part {
  Part(const Peer& peer, const fs::path& folder)
      : name(name_of(peer.role())),
        path(fs::absolute(folder / (std::string("checkpoint_of_") + name + ".part"))) {}
  ~Part() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
  Part(const Part&) = delete;

  std::string name;
  fs::path path;
};

std::vector<std::byte> bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file) throw std::runtime_error("the participant's checkpoint " + path.string() + " is not there");
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

void write_bytes(const fs::path& path, const std::vector<std::byte>& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
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
  if (plan_.every && std::chrono::duration<double>(Clock::now() - last_).count() >= *plan_.every)
    write(window);
}

void Checkpoints::write(std::int64_t window) {
  if (!possible_) return;
  core::CheckpointWriter writer(plan_.folder / "checkpoint.h5", owner);
  std::vector<double> window_length{plan_.span.window_length};
  writer.count("window", window);
  writer.values("window_length", window_length);
  for (Peer* peer : session_.peers()) {
    const Part part(*peer, plan_.folder);
    session_.ask(*peer, about_checkpoint(plan_.span.window(window), Action::write_checkpoint, part.path));
    writer.bytes(part.name, bytes_of(part.path));
  }
  archive_(writer);  // last: with this command the particles have booked the work of the last window
  writer.commit();
  last_ = Clock::now();
}

RestartPoint::RestartPoint(const fs::path& file, const Span& span)
    : file_(file), span_(span), reader_(std::make_unique<core::CheckpointReader>(file, owner)) {
  std::vector<double> window_length(1);
  reader_->count("window", window_);
  reader_->values("window_length", window_length);
  if (window_length.front() == span.window_length) return;
  throw core::ConfigError(
      fmt::format("{} was written by a run with windows of {:g} s, this scene has windows of {:g} s; only "
                  "equal ones can be "
                  "counted on",
                  file.string(), window_length.front(), span.window_length));
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
