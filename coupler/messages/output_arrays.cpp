#include "coupler/messages/output_arrays.hpp"

namespace talus::coupler {

OutputArrays::OutputArrays(const core::OutputDescription& description)
    : probes_(take(description.probes.size())), ledger_(take(description.ledger.size())) {
  for (const auto& group : description.groups) {
    Group& arrays = groups_.emplace_back();
    arrays.positions = take(3 * static_cast<std::size_t>(group.nodes));
    for (const auto& field : group.fields) {
      const auto places = field.location == core::FieldLocation::node ? group.nodes : group.cell_count();
      arrays.fields.push_back(take(field.components * static_cast<std::size_t>(places)));
    }
  }
  for (const auto& table : description.tables)
    tables_.push_back(take(1 + static_cast<std::size_t>(table.capacity) * table.columns.size()));
}

OutputArrays::Part OutputArrays::take(std::size_t count) {
  const Part part{size_, count};
  size_ += count;
  return part;
}

}  // namespace talus::coupler
