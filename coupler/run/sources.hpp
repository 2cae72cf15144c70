#pragma once

#include "core/output/source.hpp"
#include "coupler/schemes/exchange.hpp"
#include "coupler/session/introduction.hpp"
#include "coupler/session/peer.hpp"

/// What the coupler writes into results: the values that participants report through shared memory, and its
/// own of the interface.
namespace talus::coupler {

/// The values a participant filled in at its last report.
class PeerSource final : public core::OutputSource {
 public:
  explicit PeerSource(const Peer& peer) : peer_(peer) {}
  const core::OutputDescription& description() const override { return peer_.declaration().outputs; }
  void fill_probes(std::span<double> values) const override;
  void fill_ledger(std::span<double> joules) const override;
  void fill_positions(std::size_t group, std::span<double> positions) const override;
  void fill_field(std::size_t group, std::size_t field, std::span<double> values) const override;
  std::int64_t table_rows(std::size_t table) const override;
  void fill_table(std::size_t table, std::int64_t first, std::span<double> values) const override;

 private:
  std::span<double> block() const { return peer_.array(transport::ArrayName::outputs); }
  const Peer& peer_;
};

/// The interface: the total force on Ω_D, the works of the interface ledger, and Ω_D itself with its forces.
class InterfaceSource final : public core::OutputSource {
 public:
  InterfaceSource(const Interface& interface, const Peer& particles, const Exchange& exchange);
  const core::OutputDescription& description() const override { return description_; }
  void fill_probes(std::span<double> values) const override;
  void fill_ledger(std::span<double> joules) const override;
  void fill_positions(std::size_t group, std::span<double> positions) const override;
  void fill_field(std::size_t group, std::size_t field, std::span<double> values) const override;

 private:
  const Interface& interface_;
  const Peer& particles_;
  const Exchange& exchange_;
  core::OutputDescription description_;
};

}  // namespace talus::coupler
