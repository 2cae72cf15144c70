#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace talus::core {
class StateArchive;
}

namespace talus::coupler {

/// Interface quasi-Newton with an inverse least-squares model [Degroote, Bathe, Vierendeels 2009, Comput.
/// Struct. 87, 793; Degroote 2013, Arch. Comput. Methods Eng. 20, 185, section 6]:
///
///     x' = H(x_k) + sum_j c_j w_j        c minimises |r_k + sum_j c_j v_j|
///     v_j = r_i - r_i-1,  w_j = H(x_i) - H(x_i-1)   of earlier iterations i, of this window and of windows
///     before
///
/// | symbol | variable   | meaning                                  | unit            | shape             |
/// |--------|------------|------------------------------------------|-----------------|-------------------|
/// | x, H   | x, made    | iterate, what the two sides made of it   | that of x       | n                 |
/// | v, w   | columns_   | changes of residual and of H             | that of x       | m columns of n    |
/// | G      | gram_      | G_ij = v_i . v_j                         | that of x^2     | m x m             |
/// | b      | products_  | b_j = v_j . r_k                          | that of x^2     | m                 |
///
/// The normal equations G c = -b are solved by Cholesky over the newest columns first; a column whose part
/// across those before it is less than `filter` of its length is skipped. G is not recomputed: with v = r_k -
/// r_k-1 its new row is b_k - b_k-1, so an iteration reads each v once and each w once. The price of normal
/// equations is that directions below 1e-8 of a column cannot be told apart, which is why the filter may not
/// be smaller. On a linear problem of n unknowns the model is exact after n iterations ("converges in at most
/// n + 1 iterations" in acceleration_test.cpp).
class IqnIls {
 public:
  struct Settings {
    double initial_factor = 0.5;  ///< relaxation of an iteration without any column
    std::size_t most_columns = 50;
    std::int64_t reused_windows = 8;  ///< columns older than so many windows are dropped
    double filter = 1e-6;             ///< >= 1e-7
  };
  explicit IqnIls(const Settings& settings);

  void begin_window();
  void update(std::span<double> x, std::span<const double> made);
  void end_window(std::span<const double>, std::span<const double>) {}
  std::size_t columns() const { return columns_.size(); }
  /// The columns and their products.
  void archive(core::StateArchive& archive);

 private:
  struct Column {
    std::vector<double> residual_change, made_change;  ///< v, w
    std::int64_t window = 0;
  };
  /// v_j . r of all columns.
  std::vector<double> project(std::span<const double> residual) const;
  void add_column(std::span<const double> residual, std::span<const double> made,
                  const std::vector<double>& products);
  void drop_oldest_column();
  std::vector<double> coefficients() const;
  double& gram(std::size_t i, std::size_t j) { return gram_[i * settings_.most_columns + j]; }
  double gram(std::size_t i, std::size_t j) const { return gram_[i * settings_.most_columns + j]; }

  Settings settings_;
  std::int64_t window_ = 0;
  bool first_ = true;                    ///< no iteration of this window yet
  std::vector<Column> columns_;          ///< oldest first
  std::vector<double> gram_;             ///< rows of most_columns values
  std::vector<double> products_;         ///< b of the last iteration
  std::vector<double> residual_, made_;  ///< of the last iteration
  // Memory of large vectors comes from the system page by page; what was used once is used again.
  Column spare_;
  std::vector<double> new_residual_;
};

}  // namespace talus::coupler
