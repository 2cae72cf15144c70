#include "coupler/acceleration/relaxation.hpp"

#include <cmath>

#include "core/output/checkpoint.hpp"

namespace talus::coupler {
namespace {

/// A factor beyond this comes from two residuals that hardly differ; a step so long has never helped.
constexpr double largest_factor = 1000;

}  // namespace

double Aitken::next_factor(std::span<const double> x, std::span<const double> made) const {
  if (residual_.empty()) return std::copysign(std::min(std::abs(factor_), initial_), factor_);
  double product = 0, square = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double change = made[i] - x[i] - residual_[i];
    product += residual_[i] * change;
    square += change * change;
  }
  if (square == 0) return factor_;
  return std::clamp(-factor_ * product / square, -largest_factor, largest_factor);
}

void Aitken::update(std::span<double> x, std::span<const double> made) {
  factor_ = next_factor(x, made);
  residual_.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    residual_[i] = made[i] - x[i];
    x[i] += factor_ * residual_[i];
  }
}

void Aitken::archive(core::StateArchive& archive) {
  std::vector<double> factor{factor_};
  archive.values("relaxation", factor);
  factor_ = factor.front();
}

}  // namespace talus::coupler
