#include "coupler/channel_participant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/errors.hpp"
#include "coupler/messages/messages.hpp"
#include "coupler/messages/validate.hpp"
#include "coupler/transport/mailbox.hpp"
#include "coupler/transport/signal.hpp"

namespace talus::coupler {
namespace {

using namespace transport;

Channel& channel_of(Control& control, Role role) {
  return control.channels[static_cast<std::size_t>(role)];
}

const char* name_of(Role role) {
  return role == Role::structure ? "structure" : "particles";
}

std::string text_of(const Header& header) {
  const auto bytes = std::min<std::size_t>(load(header.abort_text_bytes), header.abort_text.size());
  return {header.abort_text.data(), bytes};
}

bool have_one_set(const Control& control) {
  const auto force_of = [&](Role role) {
    const Channel& channel = control.channels[static_cast<std::size_t>(role)];
    return channel.arrays[static_cast<std::size_t>(ArrayName::force)];
  };
  const ArraySlot structure = force_of(Role::structure), particles = force_of(Role::particles);
  return structure.count > 0 && structure.count == particles.count && structure.offset == particles.offset;
}

/// What this side is about to say. @throws UsageError naming the call
template <class Message>
void check_own(const Message& message, const char* call) {
  try {
    validate(message);
  } catch (const std::invalid_argument& error) {
    throw core::UsageError(fmt::format("{}: {}", call, error.what()));
  }
}

const char* name_of(ArrayName name) {
  static constexpr std::array<const char*, array_count> names{
      "force",        "displacement",  "velocity",           "end_displacement",
      "end_velocity", "free_velocity", "moved_displacement", "moved_velocity",
      "lost",         "outputs"};
  return names[static_cast<std::size_t>(name)];
}

/// A sum of zeros, unless a value is infinite or none at all: compiles to a few vector instructions.
bool all_finite(std::span<const double> values) {
  std::array<double, 8> sums{};
  const std::size_t whole = values.size() / sums.size() * sums.size();
  for (std::size_t i = 0; i < whole; i += sums.size())
    for (std::size_t lane = 0; lane < sums.size(); ++lane) sums[lane] += 0 * values[i + lane];
  double sum = 0;
  for (std::size_t i = whole; i < values.size(); ++i) sum += 0 * values[i];
  for (const double lane : sums) sum += lane;
  return sum == 0;
}

struct Handed {
  const char *side, *field;
  const Command& command;
};
/// @pre a value is not finite
core::NumericalError::Details no_number(std::span<const double> values, const Handed& handed) {
  const auto bad = std::ranges::find_if_not(values, [](double value) { return std::isfinite(value); });
  const auto place = bad - values.begin();
  return {.what = fmt::format("the {} handed over a value that is not finite", handed.side),
          .entity = fmt::format("{} {} of node {} of its surface in window {}", "xyz"[place % 3],
                                handed.field, place / 3, handed.command.window),
          .step = handed.command.window,
          .time = handed.command.time,
          .value = *bad};
}

bool is_stopped(pid_t pid) {
  const auto activity = pid > 0 ? activity_of(pid) : std::nullopt;
  return activity && activity->state == ProcessActivity::State::stopped;
}

Command command_of(const CommandRecord& record) {
  return {.action = static_cast<Action>(record.action),
          .fields = record.fields != 0,
          .tentative = record.tentative != 0,
          .window = record.window,
          .iteration = record.iteration,
          .time = record.time,
          .length = record.length,
          .regular_length = record.regular_length,
          .force_shift = record.force_shift,
          .path = std::string(record.path.data(), strnlen(record.path.data(), record.path.size()))};
}

}  // namespace

ChannelParticipant::ChannelParticipant(std::shared_ptr<Segment> segment, const JoinOptions& options)
    : segment_(std::move(segment)),
      control_(checked_control(segment_->control(), segment_->real_bytes())),
      channel_(channel_of(control_, options.role)),
      options_(options) {
  const Header& header = control_.header;
  if (header.coupler_pid != 0) {
    const ProcessIdentity coupler{.pid = static_cast<pid_t>(header.coupler_pid),
                                  .start = header.coupler_start};
    coupler_ = ProcessHandle(coupler);
    watch_.emplace(coupler, name_of(options.role));
    signals_.emplace(header.state);
    ask_for_early_turns();
  }
  auto expected = static_cast<std::uint32_t>(ChannelState::awaited);
  if (!std::atomic_ref(channel_.state)
           .compare_exchange_strong(expected, static_cast<std::uint32_t>(ChannelState::joined))) {
    give_up(fmt::format("awaits nobody in the role '{}'", name_of(options.role)));
  }
  const ProcessIdentity self = this_process();
  channel_.pid = self.pid;
  channel_.start_time = self.start;
  post(channel_.answer_posted);
}

ChannelParticipant::~ChannelParticipant() {
  auto expected = static_cast<std::uint32_t>(ChannelState::joined);
  std::atomic_ref(channel_.state)
      .compare_exchange_strong(expected, static_cast<std::uint32_t>(ChannelState::left));
  post(channel_.answer_posted);
}

void ChannelParticipant::expect(Stage stage, const char* call) const {
  if (stage_ == stage) return;
  static constexpr std::array<const char*, 6> after{
      "join()", "the surface was passed", "declare()", "answer()", "next()", "the command 'finish'"};
  throw core::UsageError(fmt::format("{} may not follow {}", call, after[static_cast<std::size_t>(stage_)]));
}

core::TransportError::Details ChannelParticipant::details(std::string reason) const {
  return {.peer = control_.header.coupler_pid == 0
                      ? std::string("the coupler")
                      : fmt::format("the coupler (pid {})", control_.header.coupler_pid),
          .waited_for = waited_for_,
          .window = command_.window,
          .reason = std::move(reason),
          .waiter = name_of(options_.role)};
}

/// Called each slice of a wait: throws where waiting on is no use.
void ChannelParticipant::look_around(double seconds_waited) {
  const auto state = static_cast<RunState>(load(control_.header.state));
  if (state == RunState::aborted) throw RunAborted(details("ended the run: " + text_of(control_.header)));
  if (state == RunState::ended) give_up("left");
  if (!coupler_.alive()) {
    segment_->remove_name();  // the coupler can no longer do it
    give_up("died");
  }
  const std::uint64_t heartbeat = load(control_.header.heartbeat);
  if (heartbeat != last_heartbeat_ || seconds_waited < last_heartbeat_at_) {
    last_heartbeat_ = heartbeat;
    last_heartbeat_at_ = seconds_waited;
  } else if (seconds_waited - last_heartbeat_at_ > options_.timeout) {
    last_heartbeat_at_ = seconds_waited;
    if (is_stopped(coupler_.pid())) return;  // by Ctrl-Z: it may go on
    give_up(fmt::format("gave no sign of life for {:g} s", options_.timeout));
  }
}

void ChannelParticipant::publish_surface(const mesh::Surface& surface, std::span<const double> node_masses) {
  expect(Stage::joined, "publish_surface()");
  if (options_.role != Role::structure) throw core::UsageError("publish_surface() is the structure's");
  if (node_masses.size() != static_cast<std::size_t>(surface.node_count())) {
    throw core::UsageError(
        fmt::format("publish_surface(): {} masses for {} nodes", node_masses.size(), surface.node_count()));
  }
  const PublishedSurface published{surface, {node_masses.begin(), node_masses.end()}};
  check_own(published, "publish_surface()");
  waited_for_ = "its surface to be taken";
  send(channel_, Side::participant, MessageKind::surface, encode(published),
       [this](double seconds) { look_around(seconds); });
  surface_nodes_ = node_masses.size();
  surface_cells_ = surface.cell_count();
  stage_ = Stage::surface_known;
}

mesh::Surface ChannelParticipant::receive_surface(std::vector<double>& node_masses) {
  expect(Stage::joined, "receive_surface()");
  if (options_.role != Role::particles) throw core::UsageError("receive_surface() is the particles'");
  waited_for_ = "its boundary";
  const LookAround look = [this](double seconds) { look_around(seconds); };
  send(channel_, Side::participant, MessageKind::surface_request, {}, look);
  PublishedSurface published = decode_surface(receive(channel_, Side::participant, look).bytes);
  node_masses = std::move(published.node_masses);
  surface_nodes_ = node_masses.size();
  surface_cells_ = published.surface.cell_count();
  stage_ = Stage::surface_known;
  return std::move(published.surface);
}

void ChannelParticipant::declare(const Declaration& declaration) {
  expect(Stage::surface_known, "declare()");
  check_own(declaration, "declare()");
  waited_for_ = "its declaration to be taken";
  send(channel_, Side::participant, MessageKind::declaration, encode(declaration),
       [this](double seconds) { look_around(seconds); });
  output_arrays_ = OutputArrays(declaration.outputs);
  declaration_ = declaration;
  stage_ = Stage::declared;
}

Command ChannelParticipant::next() {
  if (stage_ != Stage::declared) expect(Stage::idle, "next()");
  waited_for_ = "the next command";
  wait(channel_.command_posted, [this](double seconds) { look_around(seconds); });
  if (load(control_.header.state) != static_cast<std::uint32_t>(RunState::running)) look_around(0);
  if (stage_ == Stage::declared) map_arrays();
  command_ = command_of(channel_.command);
  channel_.books_work = 0;
  meter_before();
  stage_ = command_.action == Action::finish ? Stage::finished : Stage::answering;
  return command_;
}

void ChannelParticipant::answer() {
  expect(Stage::answering, "answer()");
  refuse_no_numbers();
  stage_ = Stage::idle;
  meter_after();
  post(channel_.answer_posted);
}

void ChannelParticipant::book_work(double of_this_window) {
  expect(Stage::answering, "book_work()");
  channel_.window_work = of_this_window;
  channel_.books_work = 1;
}

// Here and not in the coupler: the values are in this core's cache, and every language's participant comes by.
void ChannelParticipant::refuse_no_numbers() {
  if (command_.action != Action::advance && command_.action != Action::read_checkpoint) return;
  const bool is_structure = options_.role == Role::structure;
  using enum ArrayName;
  static constexpr std::array of_structure{displacement, velocity, free_velocity, lost};
  static constexpr std::array of_particles{force, moved_displacement, moved_velocity};
  for (const ArrayName name :
       is_structure ? std::span<const ArrayName>(of_structure) : std::span<const ArrayName>(of_particles)) {
    const auto values = array(name);
    if (all_finite(values)) continue;
    const core::NumericalError error(
        no_number(values, {.side = name_of(options_.role), .field = name_of(name), .command = command_}));
    fail(error);
    throw error;
  }
}

void ChannelParticipant::fail(const std::exception& error) noexcept {
  // A second time, as where an error that this has told already reaches main(): the coupler may be reading the first.
  if (load(channel_.state) == static_cast<std::uint32_t>(ChannelState::failed)) return;
  try {
    Bytes bytes = encode_failure(error);
    if (bytes.size() > channel_.failure.size())
      bytes = encode_failure(std::runtime_error(std::string(error.what()).substr(0, 30000)));
    std::copy(bytes.begin(), bytes.end(), channel_.failure.begin());
    channel_.failure_bytes = static_cast<std::uint32_t>(bytes.size());
  } catch (...) {
    channel_.failure_bytes = 0;  // out of memory: the coupler then says that no reason was given
  }
  store(channel_.state, static_cast<std::uint32_t>(ChannelState::failed));
  post(channel_.answer_posted);
}

// The structure's force is there at the window's start, the particles' when they answer; the place at which the
// boundary then arrives comes with the next command, unless it came with this one.
void ChannelParticipant::meter_before() {
  if (meter_) channel_.work += meter_->end(array(ArrayName::force), array(ArrayName::displacement));
  meter_.reset();
  if (is_metered() && options_.role == Role::structure) begin_metering();
}

void ChannelParticipant::meter_after() {
  if (!is_metered()) return;
  if (channel_.books_work != 0) {
    channel_.work += channel_.window_work;
    meter_.reset();
    return;
  }
  const auto force = array(ArrayName::force), displacement = array(ArrayName::displacement);
  if (options_.role == Role::structure) {
    channel_.work += meter_->end(force, displacement);
    meter_.reset();
  } else if (!declaration_.takes_several_steps(command_.length)) {
    begin_metering();
  } else {
    channel_.work += work_on_path(force, displacement, array(ArrayName::end_displacement));
  }
}

/// Only windows that are never taken back, and one set of arrays only once.
bool ChannelParticipant::is_metered() const {
  const bool other_side_does = one_set_ && options_.role == Role::particles;
  return command_.action == Action::advance && !command_.tentative && !other_side_does;
}

void ChannelParticipant::begin_metering() {
  const bool is_mean = declaration_.takes_several_steps(command_.length);
  meter_.emplace(WorkMeter::Window{is_mean ? ForceMeaning::mean : ForceMeaning::at_start, command_.length},
                 array(ArrayName::force),
                 WorkMeter::Motion{array(ArrayName::displacement), array(ArrayName::velocity)});
}

void ChannelParticipant::map_arrays() {
  segment_->attach_data(control_.header.data_bytes);
  const std::span<std::byte> data = segment_->data();
  const std::uint64_t values = 3 * surface_nodes_;
  for (std::size_t i = 0; i < array_count; ++i) {
    const auto name = static_cast<ArrayName>(i);
    const bool may_be_absent = name != ArrayName::force && name != ArrayName::displacement &&
                               name != ArrayName::velocity && name != ArrayName::outputs;
    const ArraySlot& slot = channel_.arrays[i];
    const std::uint64_t expected = name == ArrayName::outputs ? output_arrays_.size()
                                   : name == ArrayName::lost  ? surface_cells_
                                                              : values;
    arrays_[i] = checked_array(data, slot, may_be_absent && slot.count == 0 ? 0 : expected);
  }
  one_set_ = have_one_set(control_);
}

std::span<double> ChannelParticipant::outputs() const {
  if (stage_ < Stage::idle) throw core::UsageError("output values exist from the first next() on");
  return array(ArrayName::outputs);
}

StructureFields ChannelParticipant::structure_fields() {
  if (stage_ < Stage::idle) throw core::UsageError("interface fields exist from the first next() on");
  return {.force = array(ArrayName::force),
          .displacement = array(ArrayName::displacement),
          .velocity = array(ArrayName::velocity),
          .free_velocity = array(ArrayName::free_velocity),
          .lost = array(ArrayName::lost)};
}

ParticleFields ChannelParticipant::particle_fields() {
  if (stage_ < Stage::idle) throw core::UsageError("interface fields exist from the first next() on");
  return {.start_displacement = array(ArrayName::displacement),
          .start_velocity = array(ArrayName::velocity),
          .end_displacement = array(ArrayName::end_displacement),
          .end_velocity = array(ArrayName::end_velocity),
          .free_velocity = array(ArrayName::free_velocity),
          .moved_displacement = array(ArrayName::moved_displacement),
          .moved_velocity = array(ArrayName::moved_velocity),
          .lost = array(ArrayName::lost),
          .force = array(ArrayName::force)};
}

std::unique_ptr<Participant> join_in_process(std::shared_ptr<Segment> segment, Role role) {
  return std::make_unique<ChannelParticipant>(std::move(segment), JoinOptions{.segment = "", .role = role});
}

}  // namespace talus::coupler
