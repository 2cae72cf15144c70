#pragma once

#include <vector>

#include "dem_solver/boundary/feature_grid.hpp"

namespace talus::dem {

/// The triangles of some parts of a boundary seen along one direction: which of them stand above or below a
/// point.
class FacesInPlan {
 public:
  /// @param up unit. @param parts numbers of the parts whose triangles count
  FacesInPlan(const mesh::Surface& surface, std::span<const Index> parts, const Triple<double>& up);

  struct Face {
    Index part = 0;
    double height = 0;  ///< m; of the face over the point, along `up`; negative below it
    double slope = 0;   ///< |normal . up|: 1 for a level face, 0 for an upright one
  };
  /// Replaces `found` by the faces that the line through a point along `up` meets.
  void on_line_through(const Triple<double>& point, std::vector<Face>& found) const;

 private:
  struct Projection {
    Triple<double> east, north, up;
  };
  Row flattened(const Triple<double>& point) const noexcept;  ///< w: its height

  Projection to_;
  std::vector<Row> nodes_;  ///< flattened
  Boundary flat_;           ///< the same triangles, all in one plane
  std::vector<Index> part_of_;
  std::vector<double> slope_;
  FeatureGrid grid_;
};

}  // namespace talus::dem
