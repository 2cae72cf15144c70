#include "coupler/report/colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "coupler/report/packed.hpp"

namespace talus::report {

namespace {

using core::FieldReader;
using core::GroupDescription;
using nlohmann::json;

constexpr int coarse = 254;           // steps of a colour
constexpr std::uint8_t broken = 255;  // the colour of a cell that is there no more

/// What colours cells; stresses of a sheet as the larger principal one.
struct Colouring {
  const char *name, *unit, *field;
};
constexpr std::array<Colouring, 2> colourings{
    {{"axial force", "N", "axial_force"}, {"stress of membranes", "Pa", "stress_xx"}}};

/// Nothing where the group has no such colour.
const Colouring* colouring_of(const GroupDescription& group) {
  const auto found = std::ranges::find_if(
      colourings, [&](const Colouring& colouring) { return has_field(group, colouring.field); });
  return found == colourings.end() ? nullptr : &*found;
}

std::vector<double> colour_values(const FieldReader& fields, const Drawing& drawing,
                                  const Colouring& colouring, std::int64_t frame) {
  const auto values = [&](const char* name) {
    return at_cells(drawing, fields.read(*drawing.group, name, frame));
  };
  std::vector<double> first = values(colouring.field);
  if (colouring.field != std::string("stress_xx")) return first;
  const auto yy = values("stress_yy"), xy = values("stress_xy");
  for (std::size_t i = 0; i < first.size(); ++i)
    first[i] = 0.5 * (first[i] + yy[i]) + std::hypot(0.5 * (first[i] - yy[i]), xy[i]);
  return first;
}

/// What colours the cells of a group in all frames, and from where to where it goes.
struct Colours {
  std::size_t drawing = 0;
  const Colouring* colouring = nullptr;
  std::vector<double> values;
  std::vector<bool> gone;  ///< a cell a frame, as values are
};

Colours colours_of(const FieldReader& fields, const Drawing& drawing, const Colouring& colouring,
                   const std::vector<std::int64_t>& frames) {
  Colours colours{.drawing = 0, .colouring = &colouring, .values = {}, .gone = {}};
  for (const auto frame : frames) {
    const auto values = colour_values(fields, drawing, colouring, frame);
    colours.values.insert(colours.values.end(), values.begin(), values.end());
    if (!has_field(*drawing.group, "broken")) continue;
    for (const double state : at_cells(drawing, fields.read(*drawing.group, "broken", frame)))
      colours.gone.push_back(state > 0.5);
  }
  return colours;
}

/// Of all that are coloured by one quantity.
Range scale_of(const std::vector<Colours>& all, const Colouring& colouring) {
  Range scale = nothing_yet;
  for (const Colours& colours : all) {
    if (colours.colouring != &colouring || colours.values.empty()) continue;
    const Range range = range_of(colours.values);
    scale.take(range.low);
    scale.take(range.high);
  }
  // What hardly differs is not to look as if it did.
  if (scale.high - scale.low <= 1e-3 * std::abs(scale.high)) scale.take(0);
  return scale;
}

std::string packed_on(const Range& scale, const Colours& colours) {
  std::vector<std::uint8_t> numbers;
  for (std::size_t i = 0; i < colours.values.size(); ++i)
    numbers.push_back(!colours.gone.empty() && colours.gone[i]
                          ? broken
                          : static_cast<std::uint8_t>(quantised(colours.values[i], scale, coarse)));
  return base64(numbers);
}

}  // namespace

bool is_coloured(const GroupDescription& group) {
  return colouring_of(group) != nullptr;
}

json add_colours(json& groups, const FieldReader& fields, const std::vector<Drawing>& drawings,
                 const std::vector<std::int64_t>& frames) {
  std::vector<Colours> all;
  for (std::size_t i = 0; i < drawings.size(); ++i)
    if (const Colouring* colouring = colouring_of(*drawings[i].group)) {
      all.push_back(colours_of(fields, drawings[i], *colouring, frames));
      all.back().drawing = i;
    }
  json scales = json::array();
  for (const Colouring& colouring : colourings) {
    const Range scale = scale_of(all, colouring);
    if (scale.high <= scale.low) continue;
    for (const Colours& colours : all) {
      if (colours.colouring != &colouring) continue;
      groups[colours.drawing]["colour"] = scales.size();
      groups[colours.drawing]["values"] = packed_on(scale, colours);
      groups[colours.drawing]["breaks"] = !colours.gone.empty();
    }
    scales.push_back({{"name", colouring.name},
                      {"unit", colouring.unit},
                      {"low", scale.low},
                      {"step", scale.step(coarse)}});
  }
  return scales;
}

}  // namespace talus::report
