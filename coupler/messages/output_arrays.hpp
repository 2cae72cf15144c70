#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/output/source.hpp"

namespace talus::coupler {

/// Where each output value of a participant stands in its block of output values: probes, ledger, then of
/// each group its positions and fields. Both sides compute it from the declaration, so only the block itself
/// is agreed on in shared memory.
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
};

}  // namespace talus::coupler
