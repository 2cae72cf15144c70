#include "fem_solver/elements/user_element.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/errors.hpp"

namespace talus::fem {
namespace {

std::map<std::string, MakeUserElement>& known_elements() {
  static std::map<std::string, MakeUserElement> known;
  return known;
}

}  // namespace

void UserElement::stiffness(std::span<const double> positions, std::span<double> stiffness) const {
  const std::size_t n = positions.size();
  const auto [least, most] = std::ranges::minmax(positions);
  const double h =
      1e-6 * std::max(most - least, 1e-9);  // of the element's size: half the digits of a difference
  std::vector<double> moved(positions.begin(), positions.end()), ahead(n), behind(n);
  for (std::size_t j = 0; j < n; ++j) {
    moved[j] = positions[j] + h;
    force(moved, ahead);
    moved[j] = positions[j] - h;
    force(moved, behind);
    moved[j] = positions[j];
    for (std::size_t i = 0; i < n; ++i) stiffness[n * i + j] = (ahead[i] - behind[i]) / (2 * h);
  }
}

void add_user_element(const std::string& name, MakeUserElement make) {
  known_elements()[name] = std::move(make);
}

const MakeUserElement& user_element(const std::string& name) {
  const auto found = known_elements().find(name);
  if (found != known_elements().end()) return found->second;
  std::string names;
  for (const auto& [known, make] : known_elements()) names += (names.empty() ? "" : ", ") + known;
  throw core::ConfigError(
      fmt::format("user_element.name: this program has no element '{}'; it has {}", name,
                  names.empty() ? "none of its own (see docs/extending_structure.md)" : names));
}

}  // namespace talus::fem
