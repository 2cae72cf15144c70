#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "coupler/study/study_scene.hpp"

namespace talus::study {

/// One quantity's way through a study: the reference and how far it is to be trusted, each point's error with its bar,
/// the front and the rankings.
///
///     {"name", "history": bool, "note": why there is no reference,
///      "reference", "reference_low", "reference_high": of a single number; "bar": relative, of both kinds;
///      "trusted": bool, "why": where it is not, "observed_order", "expected_order",
///      "second_differs": how far the second reference is from the first, relatively,
///      "points": [{"id", "method", "value", "position", "number", "error", "error_low", "error_high", "seconds", "front"}],
///      "fastest_to", "most_exact_within": ranking.hpp}
///
/// @param points of the study, as analyse() describes them
/// @param runs the folder of the runs' folders
nlohmann::json quantity_analysis(const StudyScene& study, const std::pair<std::string, Quantity>& quantity,
                                 const nlohmann::json& points, const std::filesystem::path& runs);

}  // namespace talus::study
