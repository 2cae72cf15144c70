#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "coupler/barrier/sheet.hpp"

namespace talus::barrier {

/// The numbers of the impacts that were run, by name: "mel", "sel_1", "sel_2".
using Tests = std::map<std::string, nlohmann::json>;

/// Class by the energy of a MEL (kJ) after EAD 340059: 0 to 8; -1 below 100 kJ.
int energy_class(double kilojoules);
/// "A", "B" or "C" by the share of the height that is left after a MEL.
std::string category(double residual_share);

/// What the guideline asks, a rule each: test, what, value, unit, limit, passes (null: not decided), mark. Marks: S read
/// in public material, R recalled or assumed (verify), D derived (../shared/barrier.md names the sources).
nlohmann::json rules_of(const Tests& tests, const BarrierSheet& sheet);

}  // namespace talus::barrier
