#include "coupler/acceleration/iqn_ils.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/output/checkpoint.hpp"

namespace talus::coupler {

IqnIls::IqnIls(const Settings& settings) : settings_(settings) {}

void IqnIls::begin_window() {
  ++window_;
  first_ = true;
  std::erase_if(columns_,
                [this](const Column& column) { return column.window + settings_.reused_windows < window_; });
}

void IqnIls::forget() {
  columns_.clear();
  used_ = 0;
}

void IqnIls::start_in(Index unknowns) {
  const auto most = static_cast<Index>(settings_.most_columns);
  residual_changes_.resize(unknowns, most);
  made_changes_.resize(unknowns, most);
  gram_.setZero(most, most);
  against_.resize(unknowns, 2);
}

IqnIls::Index IqnIls::free_place() const {
  Index place = 0;
  while (std::ranges::find(columns_, place, &Column::place) != columns_.end()) ++place;
  return place;
}

void IqnIls::add_column(const Eigen::VectorXd& made) {
  if (columns_.size() == settings_.most_columns) columns_.erase(columns_.begin());
  const Index place = free_place();
  used_ = std::max(used_, place + 1);
  residual_changes_.col(place) = against_.col(1);
  made_changes_.col(place) = made - made_;
  columns_.push_back({place, window_});
  const Eigen::MatrixXd products = residual_changes_.leftCols(used_).transpose() * against_;
  products_ = products.col(0);
  gram_.col(place).head(used_) = products.col(1);
  gram_.row(place).head(used_) = products.col(1).transpose();
}

void IqnIls::drop_earlier_windows() {
  std::erase_if(columns_, [this](const Column& column) { return column.window < window_; });
}

/// Cholesky over the newest columns first. Rows of `factor` belong to the columns kept, in that order.
Eigen::VectorXd IqnIls::coefficients() const {
  std::vector<Index> kept;
  std::vector<std::vector<double>> factor;
  std::vector<double> forward;  // solution of  factor y = -b
  for (auto newest = columns_.rbegin(); newest != columns_.rend(); ++newest) {
    const Index column = newest->place;
    std::vector<double> row;
    double pivot = gram_(column, column), value = -products_[column];
    for (std::size_t k = 0; k < kept.size(); ++k) {
      double entry = gram_(column, kept[k]);
      for (std::size_t l = 0; l < k; ++l) entry -= row[l] * factor[k][l];
      row.push_back(entry / factor[k][k]);
      pivot -= row[k] * row[k];
      value -= row[k] * forward[k];
    }
    if (!(pivot > settings_.filter * settings_.filter * gram_(column, column))) continue;
    row.push_back(std::sqrt(pivot));
    forward.push_back(value / row.back());
    factor.push_back(std::move(row));
    kept.push_back(column);
  }
  Eigen::VectorXd result = Eigen::VectorXd::Zero(used_);
  for (std::size_t k = kept.size(); k-- > 0;) {
    double value = forward[k];
    for (std::size_t l = k + 1; l < kept.size(); ++l) value -= factor[l][k] * result[kept[l]];
    result[kept[k]] = value / factor[k][k];
  }
  return result;
}

void IqnIls::update(std::span<double> x, std::span<const double> made) {
  const auto unknowns = static_cast<Index>(x.size());
  Eigen::Map<Eigen::VectorXd> iterate(x.data(), unknowns);
  const Eigen::Map<const Eigen::VectorXd> result(made.data(), unknowns);
  if (residual_changes_.rows() != unknowns) start_in(unknowns);
  against_.col(0) = result - iterate;
  if (first_) {
    products_ = residual_changes_.leftCols(used_).transpose() * against_.col(0);
  } else {
    if (against_.col(0).squaredNorm() > residual_.squaredNorm()) drop_earlier_windows();
    against_.col(1) = against_.col(0) - residual_;
    add_column(result);
  }
  residual_ = against_.col(0);
  if (columns_.empty()) {
    iterate += settings_.initial_factor * residual_;
  } else {
    iterate = result;
    iterate.noalias() += made_changes_.leftCols(used_) * coefficients();
  }
  made_ = result;
  first_ = false;
}

namespace {

void archive_values(core::StateArchive& archive, const std::string& name,
                    Eigen::Ref<Eigen::VectorXd> values) {
  std::vector<double> copy(values.begin(), values.end());
  archive.values(name, copy);
  std::ranges::copy(copy, values.begin());
}

}  // namespace

void IqnIls::archive(core::StateArchive& archive) {
  auto count = static_cast<std::int64_t>(columns_.size());
  std::int64_t unknowns = residual_changes_.rows(), used = used_;
  archive.count("acceleration_window", window_);
  archive.count("columns", count);
  archive.count("places", used);
  archive.count("unknowns", unknowns);
  if (residual_changes_.rows() != unknowns) start_in(unknowns);
  used_ = used;
  columns_.resize(static_cast<std::size_t>(count));
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    std::int64_t place = columns_[j].place;
    archive.count(fmt::format("column_{}_place", j), place);
    archive.count(fmt::format("column_{}_window", j), columns_[j].window);
    columns_[j].place = place;
  }
  for (Index place = 0; place < used_; ++place) {
    archive_values(archive, fmt::format("place_{}_residual", place), residual_changes_.col(place));
    archive_values(archive, fmt::format("place_{}_made", place), made_changes_.col(place));
    archive_values(archive, fmt::format("place_{}_products", place), gram_.col(place));
  }
}

}  // namespace talus::coupler
