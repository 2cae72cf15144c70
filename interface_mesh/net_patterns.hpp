#pragma once

#include <array>

#include "interface_mesh/lattice.hpp"

/// Wire patterns from the values of a data sheet. `opening` is the diameter of the largest sphere that passes
/// through the undeformed net (m), `wire_length_per_area` the length of single wire in a square metre (1/m).
namespace talus::mesh {

/// Wires along both axes, fixed to each other where they cross.
///     opening = p - d        length per area = 2 / p
struct SquarePattern {
  double pitch = 0;          ///< p, m
  double wire_diameter = 0;  ///< d, m
};

/// Chain-link: zigzag wires hooked into their neighbours; rhombic openings with diagonals x (along) and y
/// (across).
///     side s = sqrt(x^2 + y^2) / 2     distance of opposite sides = x y / (2 s)
///     opening = x y / (2 s) - d        length per area = 4 s / (x y)   (a rhombus of area x y / 2 owns two
///     of its sides)
struct RhombicPattern {
  std::array<double, 2> diagonals{};  ///< x, y, m
  double wire_diameter = 0;           ///< d, m
};

/// Hexagonal double twist: two wires twisted around each other over the length t; between twists they cross
/// over to the neighbouring one. D is the distance of two twists (the mesh size of data sheets, e.g. 80 mm of
/// an "8 x 10" mesh), H the length of an opening along the twists.
///     slanted side L = sqrt((D/2)^2 + ((H - t)/2)^2)
///     opening = 2 min(D/2 - d, D H / (4 L) - d/2)    a twist is as thick as its two wires side by side
///     length per area = (2 t + 2 L) / (D (H + t)/2)  an opening owns one twist of two wires and two slanted
///     sides
struct HexagonalPattern {
  std::array<double, 2> mesh_size{};  ///< D along, H across, m
  double twist_length = 0;            ///< t, m
  double wire_diameter = 0;           ///< d, m
};

/// Ring net, each ring linked with four neighbours. A ring is a bundle of n windings of wire; packed as
/// densely as circles can be (share pi / sqrt(12) of the area), its diameter is b = d sqrt(n sqrt(12) / pi).
/// Linked rings that touch have their centres 2 R - b = D apart, R = (D + b)/2 the radius of the bundle's
/// axis and D the inner diameter.
///     opening = D - 2 b      the four neighbours' bundles reach into the ring
///     length per area = 2 pi R n / D^2
/// The axis is a polygon: two chords inside each neighbour, `arc_chords` between two neighbours. Rings are
/// joined where their axes cross.
struct RingPattern {
  double inner_diameter = 0;  ///< D, m
  double wire_diameter = 0;   ///< d, m
  int windings = 1;           ///< n
  static constexpr int arc_chords = 4;

  double bundle_diameter() const;  ///< b, m
};

Lattice lattice(const SquarePattern& net);
Lattice lattice(const RhombicPattern& net);
Lattice lattice(const HexagonalPattern& net);
/// @pre b < D (sqrt(2) - 1) / 2: diagonal neighbours do not touch
Lattice lattice(const RingPattern& net);

double opening(const SquarePattern& net);
double opening(const RhombicPattern& net);
double opening(const HexagonalPattern& net);
double opening(const RingPattern& net);

double wire_length_per_area(const SquarePattern& net);
double wire_length_per_area(const RhombicPattern& net);
double wire_length_per_area(const HexagonalPattern& net);
double wire_length_per_area(const RingPattern& net);

}  // namespace talus::mesh
