#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/regress/outcome.hpp"

namespace talus::coupler::regress {

/// One line a regression, then what differs, then the count.
std::string table_of(const std::vector<Outcome>& outcomes);
/// The same as JUnit XML, as continuous integration reads it: a regression is a test case.
void write_junit(const std::vector<Outcome>& outcomes, const std::filesystem::path& path);

}  // namespace talus::coupler::regress
