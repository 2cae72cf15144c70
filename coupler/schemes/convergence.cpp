#include "coupler/schemes/convergence.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "core/output/checkpoint.hpp"

namespace talus::coupler {
namespace {

/// Change over what is allowed; infinite where a value is none.
double ratio_of(const FieldChange& field, double relative, double absolute) {
  double change = 0, size = 0;
  for (std::size_t i = 0; i < field.after.size(); ++i) {
    const double difference = field.after[i] - field.before[i];
    change += difference * difference;
    size += field.after[i] * field.after[i];
  }
  if (change == 0) return 0;
  const double ratio =
      field.unit * std::sqrt(change) / std::fmax(absolute, relative * field.unit * std::sqrt(size));
  return std::isfinite(ratio) ? ratio : std::numeric_limits<double>::infinity();
}

}  // namespace

const char* name_of(FieldName field) {
  constexpr std::array<const char*, 3> names{"displacement", "velocity", "force"};
  return names[static_cast<std::size_t>(field)];
}

Convergence::Verdict Convergence::judge(const std::array<FieldChange, 3>& changes) const {
  Verdict verdict;
  for (const auto& field : changes) {
    const double ratio = ratio_of(field, relative, absolute[static_cast<std::size_t>(field.name)]);
    if (ratio > verdict.ratio) verdict = {.worst = field.name, .ratio = ratio};
  }
  return verdict;
}

void fail_not_converged(const Window& window, int iterations, const Convergence::Verdict& verdict) {
  throw core::NumericalError(
      {.what = fmt::format("the coupling has not converged after {} iterations of window {}{}", iterations,
                           window.regular_index(),
                           window.halvings > 0 ? fmt::format(", halved {} times", window.halvings) : ""),
       .entity = fmt::format("the change of {} over what is allowed", name_of(verdict.worst)),
       .step = window.regular_index(),
       .time = window.start(),
       .value = verdict.ratio});
}

void IterationTally::archive(core::StateArchive& archive) {
  archive.count("iterated_windows", windows);
  archive.count("iterations", iterations);
  archive.count("windows_not_converged", not_converged);
  archive.count("most_iterations", most);
  archive.count("windows_in_contact", in_contact);
  archive.count("most_iterations_in_contact", most_in_contact);
  archive.count("windows_halved", halved);
  archive.count("most_halvings", most_halvings);
}

}  // namespace talus::coupler
