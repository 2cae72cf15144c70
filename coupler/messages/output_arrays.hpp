#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/output/source.hpp"

namespace talus::coupler {

/// Where each output value of a participant stands in its block of output values: probes, ledger, of each
/// group its positions and fields, then of each table its number of rows and room for all of them. Both sides
/// compute it from the declaration, so only the block itself is agreed on in shared memory.
class OutputArrays {
 public:
  OutputArrays() = default;
  explicit OutputArrays(const core::OutputDescription& description);

  std::size_t size() const { return size_; }  ///< doubles
  std::span<double> probes(std::span<double> block) const { return part(block, probes_); }
  std::span<double> ledger(std::span<double> block) const { return part(block, ledger_); }
  std::span<double> positions(std::span<double> block, std::size_t group) const {
    return part(block, groups_.at(group).positions);
  }
  std::span<double> field(std::span<double> block, std::size_t group, std::size_t field) const {
    return part(block, groups_.at(group).fields.at(field));
  }
  /// The rows a table has now, as a number that may be set.
  double& table_rows(std::span<double> block, std::size_t table) const {
    return block[tables_.at(table).begin];
  }
  std::span<double> table(std::span<double> block, std::size_t table) const {
    return part(block, tables_.at(table)).subspan(1);
  }

 private:
  struct Part {
    std::size_t begin = 0, count = 0;
  };
  struct Group {
    Part positions;
    std::vector<Part> fields;
  };
  Part take(std::size_t count);
  static std::span<double> part(std::span<double> block, const Part& part) {
    return block.subspan(part.begin, part.count);
  }

  std::size_t size_ = 0;  // first: the constructor counts in it while it makes the others
  Part probes_, ledger_;
  std::vector<Group> groups_;
  std::vector<Part> tables_;
};

}  // namespace talus::coupler
