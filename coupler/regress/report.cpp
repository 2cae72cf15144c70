#include "coupler/regress/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>

#include "core/output/file.hpp"

namespace talus::coupler::regress {
namespace {

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::same:
      return "same";
    case Verdict::different:
      return "DIFFERENT";
    case Verdict::failed:
      return "FAILED";
    case Verdict::updated:
      break;
  }
  return "updated";
}

std::size_t width_of_names(const std::vector<Outcome>& outcomes) {
  std::size_t width = 10;
  for (const auto& outcome : outcomes) width = std::max(width, outcome.name.size());
  return width;
}

auto bad_ones(const std::vector<Outcome>& outcomes) {
  return std::ranges::count_if(outcomes, &Outcome::bad);
}

}  // namespace

std::string table_of(const std::vector<Outcome>& outcomes) {
  const std::size_t width = width_of_names(outcomes);
  std::string page = fmt::format("{:<{}}  {:<9}  {:>7}  {:>9}  {}\n", "regression", width, "verdict",
                                 "wall s", "distance", "farthest column (distance 1 is the tolerance)");
  for (const auto& o : outcomes) {
    page += fmt::format("{:<{}}  {:<9}  {:>7.2f}  {:>9.2g}  {}\n", o.name, width, name_of(o.verdict),
                        o.seconds, o.worst, o.worst_column);
  }
  for (const auto& o : outcomes) {
    if (o.bad()) page += fmt::format("{}: {}\n", o.name, o.message);
  }
  return page + fmt::format("{} regressions, {} bad\n", outcomes.size(), bad_ones(outcomes));
}

void write_junit(const std::vector<Outcome>& outcomes, const std::filesystem::path& path) {
  pugi::xml_document document;
  auto suite = document.append_child("testsuites").append_child("testsuite");
  suite.append_attribute("name") = "talus regress";
  suite.append_attribute("tests") = static_cast<unsigned long long>(outcomes.size());
  suite.append_attribute("failures") = static_cast<long long>(bad_ones(outcomes));
  for (const auto& outcome : outcomes) {
    auto test = suite.append_child("testcase");
    test.append_attribute("classname") = "regression";
    test.append_attribute("name") = outcome.name.c_str();
    test.append_attribute("time") = outcome.seconds;
    if (!outcome.bad()) continue;
    auto failure = test.append_child("failure");
    failure.append_attribute("type") = name_of(outcome.verdict);
    failure.append_attribute("message") = outcome.message.c_str();
  }
  std::ostringstream text;
  document.save(text, "  ");
  core::replace_file(path, text.str());
}

}  // namespace talus::coupler::regress
