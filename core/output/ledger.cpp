#include "core/output/ledger.hpp"

#include <algorithm>
#include <cmath>

namespace talus::core {
namespace {

bool is_kinetic(const LedgerDescription& line) {
  return line.kind == LedgerKind::stored && line.name.find("kinetic") != std::string::npos;
}

bool is_elastic(const LedgerDescription& line) {
  return line.kind == LedgerKind::stored && line.name.find("elastic") != std::string::npos;
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
  double balance = 0, kinetic = 0, supplied = 0, stored = 0, elastic = 0;
  most_fallen_.reset();
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const LedgerKind kind = lines_[i].kind;
    balance += sign(kind) * joules[i];
    if (is_kinetic(lines_[i])) kinetic += joules[i];
    if (is_elastic(lines_[i])) elastic += joules[i];
    if (kind == LedgerKind::supplied) supplied += joules[i];
    if (kind == LedgerKind::stored) stored += std::abs(joules[i]);
    highest_[i] = started_ ? std::max(highest_[i], joules[i]) : joules[i];
    const double fallen = highest_[i] - joules[i];
    if (kind == LedgerKind::dissipated && fallen > (most_fallen_ ? most_fallen_->joules : 0))
      most_fallen_ = Fall{i, fallen};
  }
  if (!started_) first_balance_ = balance;
  if (!started_) first_supplied_ = supplied;
  if (!started_) first_elastic_ = elastic;
  started_ = true;
  scale_ = std::max({scale_, kinetic, std::abs(supplied - first_supplied_)});
  // in a static run a prestress that is let go does no work on anything
  if (scale_ > 0) scale_ = std::max(scale_, first_elastic_ - elastic);
  largest_stored_ = std::max(largest_stored_, stored);
  last_.error = balance - first_balance_;
  last_.error_relative = scale_ > 0 ? last_.error / scale_ : 0;
  if (std::abs(last_.error) > std::abs(largest_error_)) largest_error_ = last_.error;
  return last_;
}

LedgerBalance::Row LedgerBalance::largest() const {
  return {largest_error_, scale_ > 0 ? largest_error_ / scale_ : 0};
}

}  // namespace talus::core
