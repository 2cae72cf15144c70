#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "coupler/study/study_scene.hpp"

namespace talus::study {

/// What a quantity is in one run: a single number, or a history with its times.
struct Values {
  std::vector<double> times;  ///< s; empty for a single number
  std::vector<double> numbers;
};

/// Reads a quantity from a result folder. @throws ConfigError where the result has no such column or number
Values read_values(const Quantity& quantity, const std::filesystem::path& result);

/// |a - b| / |b| of single numbers, and of histories the root mean square of the difference over that of b,
/// at the times of b. Where b is zero: the difference itself.
double relative_difference(const Values& a, const Values& b);

/// The plain difference a - b of single numbers; of histories, which have no sign, the root mean square of it at the
/// times of b.
double change(const Values& a, const Values& b);

/// fine + weight (fine - coarse), of histories at each time of the finer run.
Values beyond(const Values& fine, const Values& coarse, double weight);

}  // namespace talus::study
