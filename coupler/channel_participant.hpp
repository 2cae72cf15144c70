#pragma once

#include <memory>
#include <optional>

#include "coupler/coupler_watch.hpp"
#include "coupler/joined_signals.hpp"
#include "coupler/messages/output_arrays.hpp"
#include "coupler/participant.hpp"
#include "coupler/transport/layout.hpp"
#include "coupler/transport/process.hpp"
#include "coupler/transport/segment.hpp"
#include "coupler/work_meter.hpp"

namespace talus::coupler {

/// The coupler ended the run, and it is the one who says why.
class RunAborted : public core::TransportError {
  using core::TransportError::TransportError;
};

/// A participant over one channel of a segment, be it shared memory or this process's own.
class ChannelParticipant final : public Participant {
 public:
  /// Takes the channel of `options.role`.
  /// @throws TransportError if the segment's checks fail or the coupler awaits nobody in this role
  ChannelParticipant(std::shared_ptr<transport::Segment> segment, const JoinOptions& options);
  ~ChannelParticipant() override;

  void publish_surface(const mesh::Surface& surface, std::span<const double> node_masses) override;
  mesh::Surface receive_surface(std::vector<double>& node_masses) override;
  void declare(const Declaration& declaration) override;
  Command next() override;
  void answer() override;
  void fail(const std::exception& error) noexcept override;
  StructureFields structure_fields() override;
  ParticleFields particle_fields() override;
  std::span<double> probes() override { return output_arrays_.probes(outputs()); }
  std::span<double> ledger() override { return output_arrays_.ledger(outputs()); }
  std::span<double> positions(std::size_t group) override {
    return output_arrays_.positions(outputs(), group);
  }
  std::span<double> field(std::size_t group, std::size_t field) override {
    return output_arrays_.field(outputs(), group, field);
  }
  std::span<double> table(std::size_t table) override { return output_arrays_.table(outputs(), table); }
  double& table_rows(std::size_t table) override { return output_arrays_.table_rows(outputs(), table); }
  void tell_force_evaluations(std::int64_t since_start) override { channel_.force_evaluations = since_start; }
  void book_work(double of_this_window) override;

 private:
  enum class Stage { joined, surface_known, declared, idle, answering, finished };

  void expect(Stage stage, const char* call) const;
  void look_around(double seconds_waited);
  core::TransportError::Details details(std::string reason) const;
  [[noreturn]] void give_up(std::string reason) const {
    throw core::TransportError(details(std::move(reason)));
  }
  void map_arrays();
  // The ledger of the interface: each side sums the work on its own surface, whose values its core has just
  // written or is about to read; where both sides have the same arrays, the structure does for both. In windows
  // that may be taken back the coupler does, once they are accepted.
  void meter_before();
  void meter_after();
  bool is_metered() const;
  void refuse_no_numbers();
  void begin_metering();
  std::span<double> array(transport::ArrayName name) const { return arrays_[static_cast<std::size_t>(name)]; }
  std::span<double> outputs() const;

  std::shared_ptr<transport::Segment> segment_;
  transport::Control& control_;
  transport::Channel& channel_;
  transport::ProcessHandle coupler_;
  std::optional<CouplerWatch> watch_;            ///< where the coupler is another process
  std::optional<SignalsLeftToCoupler> signals_;  ///< likewise
  JoinOptions options_;
  Stage stage_ = Stage::joined;
  std::string waited_for_ = "the coupler to begin";
  Command command_;  ///< the last one
  Declaration declaration_;
  std::optional<WorkMeter> meter_;  ///< of the window whose work is not yet known
  std::size_t surface_nodes_ = 0;
  std::uint64_t surface_cells_ = 0;
  OutputArrays output_arrays_;
  std::array<std::span<double>, transport::array_count> arrays_;
  bool one_set_ = false;  ///< both sides have the same arrays
  std::uint64_t last_heartbeat_ = 0;
  double last_heartbeat_at_ = 0;  ///< s into the present wait
};

/// A participant that is a thread of the coupler's own process, for tests.
std::unique_ptr<Participant> join_in_process(std::shared_ptr<transport::Segment> segment, Role role);

}  // namespace talus::coupler
