#pragma once

#include <cmath>
#include <span>
#include <vector>

namespace talus::core {

/// The value of largest magnitude that each column had, and when it first had it.
class Peaks {
 public:
  struct Peak {
    double value = 0;
    double time = 0;  ///< s
  };

  void add(double time, std::span<const double> values) {
    peaks_.resize(values.size(), {.value = 0, .time = time});
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::abs(values[i]) > std::abs(peaks_[i].value)) peaks_[i] = {values[i], time};
  }
  const std::vector<Peak>& all() const { return peaks_; }

 private:
  std::vector<Peak> peaks_;
};

}  // namespace talus::core
