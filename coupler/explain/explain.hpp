#pragma once

#include <filesystem>
#include <string>

#include "coupler/explain/facts.hpp"

namespace talus::explain {

/// `talus explain RESULT`: what took the time, where the energy went, what could be left out and what seems to
/// be missing, as text.
std::string explanation(const ResultFacts& facts);

}  // namespace talus::explain
