#include <fmt/format.h>

#include "bench/impacts/impacts.hpp"

/// Prints the table of errors; fails where one is above its tolerance.
int main() {
  bool all_pass = true;
  fmt::print("{:>4}  {:<28}  {:<38}  {:>12}  {:>12}  {:>9}  {:>9}\n", "test", "situation", "quantity",
             "computed", "theory", "error", "allowed");
  for (const talus::bench::ImpactResult& row : talus::bench::run_impacts()) {
    fmt::print("{:>4}  {:<28}  {:<38}  {:>12.6g}  {:>12.6g}  {:>9.1e}  {:>9.1e}{}\n", row.test, row.situation,
               row.quantity, row.computed, row.expected, row.error(), row.tolerance,
               row.passes() ? "" : "  too large");
    all_pass = all_pass && row.passes();
  }
  return all_pass ? 0 : 1;
}
