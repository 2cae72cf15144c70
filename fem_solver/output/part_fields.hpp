#pragma once

#include <span>
#include <vector>

#include "core/output/source.hpp"
#include "fem_solver/model/model.hpp"

namespace talus::fem {

/// What the elements of a part are drawn as.
core::CellKind cell_kind(const ElementBatch& elements);

/// The values each element of a part has: axial force and stress of bars and cables.
std::vector<core::FieldDescription> element_fields(const ElementBatch& elements);

/// @param field index into element_fields(). @param values components of each element in turn
void fill_element_field(const ElementBatch& elements, std::size_t field, std::span<const double> displacement,
                        std::span<double> values);

}  // namespace talus::fem
