#pragma once

#include <span>
#include <vector>

#include "core/output/source.hpp"
#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// What the elements of a part are drawn as.
core::CellKind cell_kind(const ElementBatch& elements);

/// The values each cell of a part has: axial force and stress of bars and ropes; stresses in material axes
/// and the wrinkle state (0 taut, 1 wrinkled, 2 slack) of membranes.
std::vector<core::FieldDescription> element_fields(const ElementBatch& elements);

/// @param field index into element_fields(). @param values one a cell
void fill_element_field(const ElementBatch& elements, std::size_t field, const Configuration& at,
                        std::span<double> values);

/// What a part has as a whole, by name with unit: "axial_force_max_N".
std::vector<const char*> part_quantities(const ElementBatch& elements);
/// @param quantity index into part_quantities()
double part_quantity(const ElementBatch& elements, std::size_t quantity, const Configuration& at);

}  // namespace talus::fem
