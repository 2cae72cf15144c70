#include "coupler/acceleration/iqn_ils.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/output/checkpoint.hpp"

namespace talus::coupler {
namespace {

/// Columns are read block by block, so that the one vector that meets all of them stays in the first-level
/// cache.
constexpr std::size_t block_size = 2048;

/// Eight partial sums: a fixed order that the compiler can keep in vector registers.
double dot(const double* a, const double* b, std::size_t count) noexcept {
  std::array<double, 8> sums{};
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8) {
    for (std::size_t lane = 0; lane < 8; ++lane) sums[lane] += a[i + lane] * b[i + lane];
  }
  double rest = 0;
  for (; i < count; ++i) rest += a[i] * b[i];
  for (const double sum : sums) rest += sum;
  return rest;
}

/// Calls `work(begin, count)` for each block of `size` values.
template <class Work>
void for_blocks(std::size_t size, Work&& work) {
  for (std::size_t begin = 0; begin < size; begin += block_size)
    work(begin, std::min(block_size, size - begin));
}

}  // namespace

IqnIls::IqnIls(const Settings& settings)
    : settings_(settings), gram_(settings.most_columns * settings.most_columns) {}

void IqnIls::begin_window() {
  ++window_;
  first_ = true;
  while (!columns_.empty() && columns_.front().window + settings_.reused_windows < window_)
    drop_oldest_column();
}

std::vector<double> IqnIls::project(std::span<const double> residual) const {
  std::vector<double> products(columns_.size());
  for_blocks(residual.size(), [&](std::size_t begin, std::size_t count) {
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      products[j] += dot(columns_[j].residual_change.data() + begin, residual.data() + begin, count);
    }
  });
  return products;
}

void IqnIls::add_column(std::span<const double> residual, std::span<const double> made,
                        const std::vector<double>& products) {
  Column column = std::exchange(spare_, {});
  column.window = window_;
  column.residual_change.resize(residual.size());
  column.made_change.resize(residual.size());
  for (std::size_t i = 0; i < residual.size(); ++i) {
    column.residual_change[i] = residual[i] - residual_[i];
    column.made_change[i] = made[i] - made_[i];
  }
  const std::size_t row = columns_.size();
  for (std::size_t j = 0; j < row; ++j) gram(row, j) = gram(j, row) = products[j] - products_[j];
  gram(row, row) = dot(column.residual_change.data(), column.residual_change.data(), residual.size());
  columns_.push_back(std::move(column));
}

void IqnIls::drop_oldest_column() {
  const std::size_t count = columns_.size();
  for (std::size_t i = 1; i < count; ++i) {
    for (std::size_t j = 1; j < count; ++j) gram(i - 1, j - 1) = gram(i, j);
  }
  spare_ = std::move(columns_.front());
  columns_.erase(columns_.begin());
  if (!products_.empty()) products_.erase(products_.begin());
}

/// Cholesky over the newest columns first. Rows of `factor` belong to the columns kept, in that order.
std::vector<double> IqnIls::coefficients() const {
  const std::size_t count = columns_.size();
  std::vector<std::size_t> kept;
  std::vector<std::vector<double>> factor;
  std::vector<double> forward;  // solution of  factor y = -b
  for (std::size_t newest = 0; newest < count; ++newest) {
    const std::size_t column = count - 1 - newest;
    std::vector<double> row;
    double pivot = gram(column, column), value = -products_[column];
    for (std::size_t k = 0; k < kept.size(); ++k) {
      double entry = gram(column, kept[k]);
      for (std::size_t l = 0; l < k; ++l) entry -= row[l] * factor[k][l];
      row.push_back(entry / factor[k][k]);
      pivot -= row[k] * row[k];
      value -= row[k] * forward[k];
    }
    if (!(pivot > settings_.filter * settings_.filter * gram(column, column))) continue;
    row.push_back(std::sqrt(pivot));
    forward.push_back(value / row.back());
    factor.push_back(std::move(row));
    kept.push_back(column);
  }
  std::vector<double> result(count);
  for (std::size_t k = kept.size(); k-- > 0;) {
    double value = forward[k];
    for (std::size_t l = k + 1; l < kept.size(); ++l) value -= factor[l][k] * result[kept[l]];
    result[kept[k]] = value / factor[k][k];
  }
  return result;
}

void IqnIls::update(std::span<double> x, std::span<const double> made) {
  std::vector<double>& residual = new_residual_;
  residual.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) residual[i] = made[i] - x[i];
  if (!first_ && columns_.size() == settings_.most_columns) drop_oldest_column();
  std::vector<double> products = project(residual);
  if (!first_) {
    add_column(residual, made, products);
    products.push_back(dot(columns_.back().residual_change.data(), residual.data(), residual.size()));
  }
  products_ = std::move(products);
  if (columns_.empty()) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += settings_.initial_factor * residual[i];
  } else {
    const std::vector<double> c = coefficients();
    std::copy(made.begin(), made.end(), x.begin());
    for_blocks(x.size(), [&](std::size_t begin, std::size_t count) {
      for (std::size_t j = 0; j < columns_.size(); ++j) {
        const double* change = columns_[j].made_change.data() + begin;
        for (std::size_t i = 0; i < count; ++i) x[begin + i] += c[j] * change[i];
      }
    });
  }
  std::swap(residual_, new_residual_);
  made_.assign(made.begin(), made.end());
  first_ = false;
}

void IqnIls::archive(core::StateArchive& archive) {
  auto count = static_cast<std::int64_t>(columns_.size());
  auto size = static_cast<std::int64_t>(columns_.empty() ? 0 : columns_.front().made_change.size());
  archive.count("columns", count);
  archive.count("column_size", size);
  archive.count("acceleration_window", window_);
  columns_.resize(static_cast<std::size_t>(count));
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    Column& column = columns_[j];
    const std::string name = "column_" + std::to_string(j);
    column.residual_change.resize(static_cast<std::size_t>(size));
    column.made_change.resize(static_cast<std::size_t>(size));
    archive.values(name + "_residual", column.residual_change);
    archive.values(name + "_made", column.made_change);
    archive.count(name + "_window", column.window);
  }
  archive.values("gram", gram_);
}

}  // namespace talus::coupler
