#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace talus::report {

/// Bytes that the numbers of a page's replays take at most, and frames of one.
constexpr std::int64_t replay_budget = 3'000'000, most_frames = 150;

/// What the page's moving picture is made of: positions of all groups at the frames that are shown, as whole numbers
/// of 16 bits within the group's own box, and what colours cells as whole numbers of 8 bits. The first and the last
/// frame are shown, that of the largest displacement and that of the first contact, and between them as many as the
/// budget allows. Where not even two dozen frames of all cells fit, every so many cells are left out. What was left
/// out stands in the data, for the page to say so; so does what a result lacks (`lacks`), and then there is no frame,
/// or just one.
/// @param budget bytes of this one
/// @throws std::runtime_error where the file is damaged
nlohmann::json replay(const std::filesystem::path& fields, std::int64_t budget = replay_budget);

}  // namespace talus::report
