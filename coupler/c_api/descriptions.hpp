#pragma once

#include <vector>

#include "coupler/c_api/talus.h"
#include "coupler/participant.hpp"

/// The structs of talus.h as what they stand for in coupler/participant.hpp. All throw UsageError where a member
/// is missing or cannot be.
namespace talus::c_api {

mesh::SurfacePart part_from(const talus_part* said);
/// @param parts empty: the surface is one part
mesh::Surface surface_from(const talus_surface& said, const std::vector<mesh::SurfacePart>& parts);
coupler::StepLimit limit_from(const talus_limit* said);
coupler::Effect effect_from(const talus_effect* said);
core::GroupDescription group_from(const talus_group* said);
core::FieldDescription field_from(const talus_field& said);
core::TableDescription table_from(const talus_table* said);
core::Complaint complaint_from(const talus_complaint* said);
core::NumericalError::Details numerical_error_from(const talus_numerical_details* said);

/// @param added limits, effects and outputs that were added before
coupler::Declaration declaration_from(const talus_declaration* said, coupler::Declaration added);

}  // namespace talus::c_api
