#include "coupler/schemes/free_flight.hpp"

#include <algorithm>

#include "core/output/checkpoint.hpp"

namespace talus::coupler {

void FlightTally::archive(core::StateArchive& archive) {
  archive.count("grown_windows", windows);
  archive.count("regular_windows_spared", regular);
  archive.count("windows_taken_back", taken_back);
  archive.count("longest_window", longest);
}

void FreeFlight::archive(core::StateArchive& archive) {
  archive.count("next_window_in_flight", next_);
  tally_.archive(archive);
}

std::int64_t FreeFlight::compute(const Window& regular, std::int64_t most) {
  if (exchange_.touching()) {
    next_ = first_try;
    return 0;
  }
  bool taken_back = false;
  for (std::int64_t units = std::min(next_, most); units >= first_try; units /= 2) {
    Window window = regular;
    window.units = units;
    if (is_free(window)) {
      count(units);
      if (taken_back) {
        next_ = units / 2;  // something touches before another `units` have gone by
      } else if (units == next_) {
        next_ = std::min(2 * units, longest_);
      }
      return units;
    }
    ++tally_.taken_back;
    taken_back = true;
  }
  next_ = first_try;
  return 0;
}

void FreeFlight::count(std::int64_t units) {
  ++tally_.windows;
  tally_.regular += units;
  tally_.longest = std::max(tally_.longest, units);
}

bool FreeFlight::is_free(const Window& window) {
  constexpr int only_try = 0;
  exchange_.save_states(window);
  exchange_.release_structure();
  exchange_.advance_structure(window, only_try);
  exchange_.motion_to_boundary_end();
  exchange_.advance_particles(window, only_try);
  if (exchange_.touching()) {
    exchange_.take_back(window);
    return false;
  }
  exchange_.motion_to_boundary();
  return true;
}

}  // namespace talus::coupler
