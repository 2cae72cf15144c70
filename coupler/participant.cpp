#include "coupler/participant.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/output/file.hpp"
#include "core/program/log.hpp"
#include "core/steps.hpp"
#include "coupler/channel_participant.hpp"
#include "coupler/transport/segment.hpp"

namespace talus::coupler {

std::int64_t Declaration::steps_in(double window_length) const {
  return step > 0 ? core::steps_in(window_length, step) : 1;
}

double Declaration::force_shift(double window_length) const {
  return force_use == ForceUse::load ? 0 : 0.5 * window_length / static_cast<double>(steps_in(window_length));
}

std::unique_ptr<Participant> Participant::join(const JoinOptions& options) {
  return std::make_unique<ChannelParticipant>(transport::open_shared_segment(options.segment), options);
}

core::ExitCode take_part(const JoinOptions& options, const std::function<void(Participant&)>& serve) {
  const auto participant = Participant::join(options);
  try {
    serve(*participant);
    return core::ExitCode::success;
  } catch (const RunAborted& error) {
    return core::exit_code(error);
  } catch (const core::TransportError& error) {
    core::log_error(error.what());  // nobody is left to be told
    return core::exit_code(error);
  } catch (const std::exception& error) {
    participant->fail(error);
    return core::exit_code(error);
  }
}

void write_checkpoint(const Command& command,
                      const std::function<void(const std::filesystem::path&)>& write) {
  try {
    write(command.path);
  } catch (const core::MachineError& error) {
    core::log_warning(error.what());
    std::error_code ignored;
    std::filesystem::remove(command.path, ignored);
  }
}

void checkpoint_state(const Command& command, std::span<std::byte> state) {
  if (command.action == Action::write_checkpoint) {
    write_checkpoint(command, [&](const std::filesystem::path& path) {
      core::OutputFile file(path, core::OutputFile::Mode::create);
      file.write_at(0, state);
      file.close();
    });
  }
  if (command.action == Action::read_checkpoint) {
    std::error_code absent;
    if (std::filesystem::file_size(command.path, absent) != state.size() || absent)
      throw core::ConfigError("the checkpoint " + command.path + " does not hold a state of " +
                              std::to_string(state.size()) + " bytes");
    std::ifstream(command.path, std::ios::binary)
        .read(reinterpret_cast<char*>(state.data()), static_cast<std::streamsize>(state.size()));
  }
}

namespace {

/// Of events only those that are new.
void report_table(Participant& participant, const core::OutputSource& source, std::size_t table) {
  const core::TableDescription& description = source.description().tables[table];
  const std::int64_t rows = source.table_rows(table);
  const auto there = static_cast<std::int64_t>(participant.table_rows(table));
  const std::int64_t first = description.kind == core::TableKind::events ? std::min(there, rows) : 0;
  const std::size_t columns = description.columns.size();
  source.fill_table(table, first,
                    participant.table(table).subspan(static_cast<std::size_t>(first) * columns,
                                                     static_cast<std::size_t>(rows - first) * columns));
  participant.table_rows(table) = static_cast<double>(rows);
}

}  // namespace

void report(Participant& participant, const Command& command, const core::OutputSource& source) {
  source.fill_probes(participant.probes());
  source.fill_ledger(participant.ledger());
  for (std::size_t table = 0; table < source.description().tables.size(); ++table)
    report_table(participant, source, table);
  if (!command.fields) return;
  const auto& groups = source.description().groups;
  for (std::size_t group = 0; group < groups.size(); ++group) {
    source.fill_positions(group, participant.positions(group));
    for (std::size_t field = 0; field < groups[group].fields.size(); ++field) {
      source.fill_field(group, field, participant.field(group, field));
    }
  }
}

}  // namespace talus::coupler
