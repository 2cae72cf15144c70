#pragma once

#include <span>
#include <string>
#include <vector>

#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// The largest forces over all steps, not only over those that are written, and what broke first. Its numbers stand in
/// State::record, so that they are taken back with a window that is; this knows what each of them means.
class ForceRecord {
 public:
  explicit ForceRecord(const Model& model);

  /// Before the first step.
  std::vector<double> begin() const;
  /// After the forces of a state that is accepted. @param at with the memory from before the step.
  /// @param next what elements remember from here on
  void note_elements(double time, const Configuration& at, std::span<const double> next,
                     std::span<double> record) const;
  /// @param reactions N, 3 a node of every support in turn
  void note_supports(double time, std::span<const double> reactions, std::span<double> record) const;

  /// A table of what is recorded: names of its rows and columns, whose values are those of the record in this order.
  struct Table {
    const char* name;
    std::vector<std::string> columns;
    std::vector<std::string> rows;
    std::size_t begin = 0;  ///< in the record
    std::size_t values() const { return rows.size() * columns.size(); }
  };
  /// `largest_forces` of the parts with an axial force, `support_forces`, `ruptures` of the parts that break, and
  /// `utilisation` of those whose breaking load is known and `buckling` of bars whose section is; tables without rows are
  /// left out.
  std::vector<Table> tables() const;

 private:
  const Model& model_;
  Table forces_, supports_, ruptures_, utilisation_, buckling_;
};

}  // namespace talus::fem
