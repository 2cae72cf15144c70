#include "core/output/ledger.hpp"

#include <cmath>

namespace talus::core {
namespace {

bool is_kinetic(const LedgerDescription& line) {
  return line.kind == LedgerKind::stored && line.name.find("kinetic") != std::string::npos;
}

double sign(LedgerKind kind) {
  switch (kind) {
    case LedgerKind::stored:
    case LedgerKind::dissipated:
      return 1;
    case LedgerKind::supplied:
      return -1;
    case LedgerKind::memo:
      break;
  }
  return 0;
}

}  // namespace

LedgerBalance::Row LedgerBalance::add(std::span<const double> joules) {
  double balance = 0, kinetic = 0;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    balance += sign(lines_[i].kind) * joules[i];
    if (is_kinetic(lines_[i])) kinetic += joules[i];
  }
  if (!started_) first_balance_ = balance;
  started_ = true;
  largest_kinetic_ = std::max(largest_kinetic_, kinetic);
  last_.error = balance - first_balance_;
  last_.error_relative = largest_kinetic_ > 0 ? last_.error / largest_kinetic_ : 0;
  if (std::abs(last_.error) > std::abs(largest_.error)) largest_ = last_;
  return last_;
}

}  // namespace talus::core
