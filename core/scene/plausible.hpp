#pragma once

#include "core/scene/fields.hpp"

/// What the quantities of scenes can mean. Bounds are wide: they are there for lost and mistaken units, not to
/// judge a design.
namespace talus::core::plausible {

inline constexpr const char* pascals = "megapascals are written MPa; mPa is a thousandth of a pascal";
inline constexpr const char* lengths = "millimetres are written mm; Mm is a million metres";

/// Of a material that carries loads.
inline constexpr Plausible modulus{
    .usual = {.low = 1e3, .high = 2e12}, .possible = {.low = 1e3, .high = 1e15}, .hint = pascals};
/// Of a contact: rigid partners are written as 1e20 Pa.
inline constexpr Plausible contact_modulus{
    .usual = {.low = 1e3}, .possible = {.low = 1e3, .high = 1e25}, .hint = pascals};
inline constexpr Plausible strength{
    .usual = {.low = 1e3, .high = 1e11}, .possible = {.low = 1e3, .high = 1e13}, .hint = pascals};
/// Small ones are meant where a sheet is to be straight and no more.
inline constexpr Plausible prestress{
    .usual = {.low = 100, .high = 1e11}, .possible = {.low = 10, .high = 1e13}, .hint = pascals};
/// Structures without mass and rocks beyond any matter are both used on purpose.
inline constexpr Plausible density{
    .usual = {.low = 30, .high = 3e4},
    .possible = {.high = 5e6},
    .hint = "grams a cubic centimetre are written g/cm^3, tonnes a cubic metre t/m^3"};
inline constexpr Plausible friction{.usual = {.high = 2},
                                    .possible = {.high = 5},
                                    .hint = "a coefficient is the tangent of the angle of friction"};
inline constexpr Plausible contraction{
    .usual = {.high = 0.5}, .hint = "above 0.5 only nets and fabrics contract, no solid sheet does"};
inline constexpr Plausible area{
    .usual = {.high = 0.5}, .possible = {.high = 100}, .hint = "square millimetres are written mm^2"};
inline constexpr Plausible thickness{.usual = {.high = 1}, .possible = {.high = 100}, .hint = lengths};
inline constexpr Plausible wire_diameter{.usual = {.high = 0.1}, .possible = {.high = 1}, .hint = lengths};
inline constexpr Plausible wire_radius{.usual = {.high = 0.5}, .possible = {.high = 100}, .hint = lengths};
/// Radius or edge of a stone or rock.
inline constexpr Plausible rock_size{.usual = {.high = 50}, .possible = {.high = 1e4}, .hint = lengths};
inline constexpr Plausible rock_mass{
    .usual = {.high = 1e6}, .possible = {.high = 1e9}, .hint = "tonnes are written t"};
inline constexpr Plausible velocity{
    .usual = {.high = 300}, .possible = {.high = 1e4}, .hint = "kilometres an hour are written km/h"};
inline constexpr Plausible spin{
    .usual = {.high = 300}, .possible = {.high = 1e5}, .hint = "turns a minute are written rpm"};
inline constexpr Plausible rotation{.usual = {.high = 6.3}, .hint = "degrees are written deg"};
inline constexpr Plausible gravity{
    .usual = {.high = 30}, .possible = {.high = 1e4}, .hint = "free fall on Earth is 9.81 m/s^2"};
inline constexpr Plausible foundation{.usual = {.low = 1e4, .high = 1e14},
                                      .possible = {.low = 1, .high = 1e20},
                                      .hint = "soil has 10 to 1000 MPa/m"};
inline constexpr Plausible stiffness{.usual = {.low = 10, .high = 1e14},
                                     .possible = {.low = 1, .high = 1e20},
                                     .hint = "meganewtons are written MN; mN is a thousandth of a newton"};
/// That a rope, wire or brake bears.
inline constexpr Plausible strength_in_force{
    .usual = {.low = 1, .high = 1e8},
    .possible = {.low = 0.1, .high = 1e11},
    .hint = "kilonewtons are written kN; mN is a thousandth of a newton"};
inline constexpr Plausible mass_per_length{.usual = {.low = 1e-3, .high = 1e3},
                                           .possible = {.low = 1e-5, .high = 1e6},
                                           .hint = "grams a metre are written g/m"};
/// Of a node: a shackle, a post's head, a block.
inline constexpr Plausible point_mass{
    .usual = {.low = 1e-3, .high = 1e6},
    .possible = {.low = 1e-6, .high = 1e9},
    .hint = "kilograms are written kg, tonnes t; mg is a millionth of a kilogram"};
inline constexpr Plausible duration{.possible = {.high = 1e5},
                                    .hint = "milliseconds are written ms; Ms is a million seconds"};

}  // namespace talus::core::plausible
