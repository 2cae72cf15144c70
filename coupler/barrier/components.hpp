#pragma once

#include <optional>
#include <string>

#include "core/scene/fields.hpp"

/// What a data sheet calls by name: ropes by their diameter, posts by their profile, nets by their kind.
namespace talus::barrier {

/// A wire rope of grade 1770 MPa.
struct Rope {
  double diameter = 0;       ///< m
  double area = 0;           ///< m^2; metallic
  double breaking_load = 0;  ///< N; minimum breaking load of the trade's tables
};
/// nullptr: there is none of this diameter.
const Rope* find_rope(double diameter);
std::string known_ropes();
/// A complaint about a diameter that is not in the table.
void check_rope(core::Fields& fields, const char* key, double diameter);

/// A rolled section, bending about its weak axis counts for buckling.
struct Profile {
  std::string name;
  double area = 0;           ///< m^2
  double second_moment = 0;  ///< m^4; about the weaker axis
};
const Profile* find_profile(const std::string& name);
std::string known_profiles();

/// A net of rhombic meshes of single wires, and the membrane that stands for it: constants as `talus homogenise` gives them.
struct Net {
  std::string kind;
  double diagonal_along = 0, diagonal_across = 0;              ///< m; of a mesh
  double wire_diameter = 0;                                    ///< m
  double thickness = 0, density = 0;                           ///< m, kg/m^3
  double youngs_modulus_along = 0, youngs_modulus_across = 0;  ///< Pa
  double poissons_ratio = 0, shear_modulus = 0;                ///< 1, Pa
};
const Net* find_net(const std::string& kind);

/// A net of interlocked rings, each of several windings of one wire.
struct RingNet {
  int windings = 0;
  double wire_diameter = 0, diameter = 0;  ///< m; of the wire, of a ring inside
};
/// "ring_7_3_300": windings, diameter of the wire and of a ring in millimetres; empty for other names.
std::optional<RingNet> find_ring_net(const std::string& kind);
/// Both kinds.
std::string known_nets();

}  // namespace talus::barrier
