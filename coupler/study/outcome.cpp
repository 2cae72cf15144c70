#include "coupler/study/outcome.hpp"

#include <fmt/format.h>

#include <cmath>

#include "coupler/study/runner.hpp"

namespace talus::study {
namespace {

using nlohmann::json;

std::string percent(double share) {
  return fmt::format("{:.2g} %", 100 * share);
}

std::string joined_warnings(const json& summary) {
  std::string text;
  for (const auto& warning : summary.value("warnings", json::array()))
    text += (text.empty() ? "" : "; ") + warning.get<std::string>();
  return text;
}

}  // namespace

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::ok:
      return "ok";
    case Outcome::warnings:
      return "warnings";
    case Outcome::inaccurate:
      return "inaccurate";
    case Outcome::failed:
      return "failed";
    case Outcome::missing:
      break;
  }
  return "missing";
}

double share_not_converged(const json& summary) {
  const json iterations = summary.value("iterations", json::object());
  const double not_converged = iterations.value("windows_not_converged", 0.0);
  if (not_converged == 0) return 0;
  return not_converged * iterations.at("mean").get<double>() / iterations.at("total").get<double>();
}

Worth worth_of(const json& record, double largest_energy_error) {
  if (record.at("ending") != name_of(Ending::good))
    return {Outcome::failed, record.at("ending"), record.at("message")};
  const json& summary = record.at("summary");
  const std::string message = joined_warnings(summary);
  const double error = std::abs(summary.value("/energy/largest_error_relative"_json_pointer, 0.0));
  if (!(error <= largest_energy_error))
    return {Outcome::inaccurate, "energy off by " + percent(error), message};
  if (const double share = share_not_converged(summary); share > 0)
    return {Outcome::warnings, percent(share) + " of windows not converged", message};
  if (!message.empty()) return {Outcome::warnings, "with warnings", message};
  return {Outcome::ok, "", ""};
}

}  // namespace talus::study
