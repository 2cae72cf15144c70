#pragma once

#include <Eigen/Core>
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
/// | v, w   | *_changes_ | changes of residual and of H             | that of x       | n x m             |
/// | G      | gram_      | G_ij = v_i . v_j                         | that of x^2     | m x m             |
/// | b      | products_  | b_j = v_j . r_k                          | that of x^2     | m                 |
///
/// The normal equations G c = -b are solved by Cholesky over the newest columns first; a column whose part
/// across those before it is less than `filter` of its length is skipped. An iteration reads each v once, for
/// its products with r_k and with the new column together, and each w once. (With v = r_k - r_k-1 the new row of
/// G is b_k - b_k-1, too, but that difference carries 1e-16 |r|/|v| of noise, more than the filter lets pass
/// where r hardly changes.) The price of normal equations is that directions below 1e-8 of a column cannot be
/// told apart, which is why the filter may not be smaller. On a linear problem of n unknowns the model is exact
/// after n iterations ("converges in at most n + 1 iterations" in acceleration_test.cpp).
///
/// Columns of earlier windows mislead where contacts have changed since. An iteration after which the residual
/// is larger than before it drops them ("columns of a window that mislead are dropped" in acceleration_test.cpp).
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
  void step_aside() { first_ = true; }
  void update(std::span<double> x, std::span<const double> made);
  void forget();
  std::size_t columns() const { return columns_.size(); }
  /// The columns and their products.
  void archive(core::StateArchive& archive);

 private:
  using Index = Eigen::Index;
  /// A column of the matrices, whose places are used again.
  struct Column {
    Index place = 0;
    std::int64_t window = 0;  ///< in which it was seen
  };
  void start_in(Index unknowns);
  Index free_place() const;
  void add_column(const Eigen::VectorXd& made);
  void drop_earlier_windows();
  /// c_j of all places, 0 where none or a skipped column is.
  Eigen::VectorXd coefficients() const;

  Settings settings_;
  std::int64_t window_ = 0;
  bool first_ = true;                                ///< no iteration of this window yet
  std::vector<Column> columns_;                      ///< oldest first
  Index used_ = 0;                                   ///< places that have held a column so far
  Eigen::MatrixXd residual_changes_, made_changes_;  ///< v, w; a column each place
  Eigen::MatrixXd gram_;                             ///< by places
  Eigen::VectorXd products_;                         ///< b of this iteration, by places
  Eigen::VectorXd residual_, made_;                  ///< of the last iteration
  Eigen::MatrixXd against_;  ///< residual of this iteration, and the new column; keeps its memory
};

}  // namespace talus::coupler
