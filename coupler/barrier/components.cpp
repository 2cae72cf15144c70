#include "coupler/barrier/components.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <regex>

namespace talus::barrier {

namespace {

// Minimum breaking loads of 1770 MPa ropes, and metallic areas 0.55 pi d^2/4.
constexpr std::array ropes{
    Rope{8e-3, 28e-6, 37.6e3},  Rope{10e-3, 43e-6, 58.8e3}, Rope{12e-3, 62e-6, 84.6e3},
    Rope{14e-3, 85e-6, 115e3},  Rope{16e-3, 110e-6, 150e3}, Rope{18e-3, 140e-6, 190e3},
    Rope{20e-3, 173e-6, 235e3}, Rope{22e-3, 209e-6, 284e3}, Rope{24e-3, 249e-6, 338e3},
};

// EN 10365.
const std::array profiles{
    Profile{"HEA140", 31.4e-4, 389e-8},  Profile{"HEA160", 38.8e-4, 616e-8},
    Profile{"HEA180", 45.3e-4, 925e-8},  Profile{"HEA200", 53.8e-4, 1336e-8},
    Profile{"HEB140", 43.0e-4, 550e-8},  Profile{"HEB160", 54.3e-4, 889e-8},
    Profile{"HEB180", 65.3e-4, 1363e-8}, Profile{"HEB200", 78.1e-4, 2003e-8},
    Profile{"HEB220", 91.0e-4, 2843e-8},
};

// talus homogenise of the wires between the corners of a mesh, E 177 GPa: docs/barriers.md.
const std::array nets{
    Net{"rhombic_83x137_3", 0.25 / 3, 0.1375, 3e-3, 1e-3, 1557.21, 1.43156e6, 10.6107e6, 2.72114, 3.89741e9},
};

template <class Table>
std::string names(const Table& table, const auto& name_of) {
  std::string list;
  for (const auto& entry : table) list += (list.empty() ? "" : ", ") + name_of(entry);
  return list;
}

template <class Table, class Is>
auto find(const Table& table, const Is& is) -> decltype(table.data()) {
  for (const auto& entry : table)
    if (is(entry)) return &entry;
  return nullptr;
}

}  // namespace

const Rope* find_rope(double diameter) {
  return find(ropes, [&](const Rope& rope) { return std::abs(rope.diameter - diameter) < 1e-6; });
}
std::string known_ropes() {
  return names(ropes, [](const Rope& rope) { return fmt::format("{:.0f} mm", 1e3 * rope.diameter); });
}
void check_rope(core::Fields& fields, const char* key, double diameter) {
  fields.rule(diameter <= 0 || find_rope(diameter) != nullptr, key,
              fmt::format("there is no rope of {:.4g} mm; known: {}", 1e3 * diameter, known_ropes()));
}

const Profile* find_profile(const std::string& name) {
  return find(profiles, [&](const Profile& profile) { return profile.name == name; });
}
std::string known_profiles() {
  return names(profiles, [](const Profile& profile) { return profile.name; });
}

const Net* find_net(const std::string& kind) {
  return find(nets, [&](const Net& net) { return net.kind == kind; });
}
std::optional<RingNet> find_ring_net(const std::string& kind) {
  static const std::regex form("ring_([0-9]{1,2})_([0-9]{1,2})_([0-9]{2,4})");
  std::smatch found;
  if (!std::regex_match(kind, found, form)) return {};
  const RingNet net{std::stoi(found[1]), 1e-3 * std::stoi(found[2]), 1e-3 * std::stoi(found[3])};
  if (net.windings == 0 || net.wire_diameter == 0 || net.diameter == 0) return {};
  return net;
}
std::string known_nets() {
  return names(nets, [](const Net& net) { return net.kind; }) +
         ", and rings as in ring_7_3_300 (windings, wire and ring in mm)";
}

}  // namespace talus::barrier
