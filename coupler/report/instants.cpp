#include "coupler/report/instants.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace talus::report {

namespace {

/// The largest length of a vector field's values in a frame, over all groups that have it; nothing where none has.
std::optional<double> largest_length(const core::FieldReader& fields, const std::string& name,
                                     std::int64_t frame) {
  std::optional<double> largest;
  for (const auto& group : fields.groups()) {
    if (std::ranges::find(group.fields, name, &core::FieldDescription::name) == group.fields.end()) continue;
    const auto values = fields.read(group, name, frame);
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
      largest = std::max(largest.value_or(0), std::hypot(values[i], values[i + 1], values[i + 2]));
  }
  return largest;
}

std::optional<std::int64_t> peak_frame(const core::FieldReader& fields) {
  std::optional<std::int64_t> peak;
  double most = 0;
  for (std::int64_t frame = 0; frame < fields.frames(); ++frame) {
    const auto displacement = largest_length(fields, "displacement", frame);
    if (!displacement) return std::nullopt;
    if (*displacement > most) most = *displacement, peak = frame;
  }
  return peak;
}

std::optional<std::int64_t> first_contact(const core::FieldReader& fields) {
  for (std::int64_t frame = 0; frame < fields.frames(); ++frame) {
    const auto force = largest_length(fields, "contact_force", frame);
    if (!force) return std::nullopt;
    if (*force > 0) return frame;
  }
  return std::nullopt;
}

}  // namespace

Instants instants_of(const core::FieldReader& fields) {
  return {.peak = peak_frame(fields), .contact = first_contact(fields)};
}

std::vector<std::int64_t> chosen_frames(std::int64_t frames, std::int64_t most, const Instants& instants) {
  std::set<std::int64_t> chosen{0, frames - 1};
  for (const auto& instant : {instants.peak, instants.contact})
    if (instant) chosen.insert(*instant);
  const std::int64_t even =
      frames <= most ? frames
                     : std::max<std::int64_t>(2, most - std::ssize(chosen) + 2);  // both ends are even ones
  for (std::int64_t i = 0; i < even && even > 1; ++i) chosen.insert(i * (frames - 1) / (even - 1));
  return {chosen.begin(), chosen.end()};
}

}  // namespace talus::report
