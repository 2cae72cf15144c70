#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <random>

#include "coupler/acceleration/iqn_ils.hpp"
#include "coupler/acceleration/relaxation.hpp"

using namespace talus::coupler;

namespace {

/// H(x) = A x + b with the fixed point (I - A)^-1 b.
struct LinearProblem {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;

  static LinearProblem random(int unknowns, double size, unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> value(-1, 1);
    const auto draw = [&] { return value(generator); };
    return {.a = size * Eigen::MatrixXd::NullaryExpr(unknowns, unknowns, draw),
            .b = Eigen::VectorXd::NullaryExpr(unknowns, draw)};
  }
  Eigen::VectorXd fixed_point() const {
    return (Eigen::MatrixXd::Identity(a.rows(), a.cols()) - a).lu().solve(b);
  }
};

std::span<double> span_of(Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

/// Iterations until the residual is below `tolerance` of the first one; `most` where it never is.
template <class Acceleration>
int iterations(const LinearProblem& problem, Acceleration& acceleration, double tolerance, int most) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(problem.b.size());
  acceleration.begin_window();
  for (int k = 1; k <= most; ++k) {
    Eigen::VectorXd made = problem.a * x + problem.b;
    if ((made - x).norm() <= tolerance * problem.b.norm()) return k - 1;
    acceleration.update(span_of(x), span_of(made));
  }
  return most;
}

}  // namespace

TEST_CASE(
    "IQN-ILS converges in at most n + 1 iterations on a linear problem of n unknowns, also where plain "
    "iteration diverges") {
  const int unknowns = GENERATE(1, 2, 5, 10);
  const double size = GENERATE(0.2, 3.0);
  const auto problem = LinearProblem::random(unknowns, size, 7);
  IqnIls acceleration({.filter = 1e-7});
  // Normal equations square the condition number of up to ten columns; a tenth of the digits is left for
  // that.
  CHECK(iterations(problem, acceleration, 1e-8, 100) <= unknowns + 1);
}

TEST_CASE("IQN-ILS keeps what it learned in one window for the next") {
  const auto problem = LinearProblem::random(8, 0.5, 3);
  IqnIls acceleration({.filter = 1e-7});
  const int first = iterations(problem, acceleration, 1e-8, 100);
  CHECK(first >= 8);
  CHECK(iterations(problem, acceleration, 1e-8, 100) <= 2);
}

namespace {

/// Columns at the end of each of the first windows, all of three iterations: two columns each.
std::vector<std::size_t> columns_of_windows(IqnIls::Settings settings) {
  const auto problem = LinearProblem::random(8, 0.4, 1);
  IqnIls acceleration(settings);
  std::vector<std::size_t> columns;
  for (int window = 0; window < 5; ++window) {
    iterations(problem, acceleration, 0, 3);
    columns.push_back(acceleration.columns());
  }
  return columns;
}

}  // namespace

TEST_CASE("IQN-ILS forgets windows that are too old and never holds more columns than allowed") {
  using Columns = std::vector<std::size_t>;
  CHECK(columns_of_windows({.most_columns = 50, .reused_windows = 2}) == Columns{2, 4, 6, 6, 6});
  CHECK(columns_of_windows({.most_columns = 50, .reused_windows = 0}) == Columns{2, 2, 2, 2, 2});
  CHECK(columns_of_windows({.most_columns = 5, .reused_windows = 2}) == Columns{2, 4, 5, 5, 5});
}

TEST_CASE("IQN-ILS drops its oldest columns first: of another problem, once it holds as many of its own") {
  constexpr int unknowns = 4;
  IqnIls acceleration({.most_columns = unknowns, .reused_windows = 8, .filter = 1e-7});
  iterations(LinearProblem::random(unknowns, 0.5, 5), acceleration, 1e-8, 20);
  const auto other = LinearProblem::random(unknowns, 0.5, 6);
  CHECK(iterations(other, acceleration, 1e-8, 50) <= unknowns + 2);
  // By now all columns are the other problem's own. Were the newest dropped, this would take seven.
  CHECK(iterations(other, acceleration, 1e-8, 50) <= 2);
}

TEST_CASE("a column that says nothing new does not spoil the model") {
  const auto problem = LinearProblem::random(2, 0.5, 11);
  IqnIls acceleration({.filter = 1e-6});
  for (int window = 0; window < 5; ++window) CHECK(iterations(problem, acceleration, 1e-9, 20) <= 4);
}

TEST_CASE("Aitken finds the fixed point of one linear unknown in two steps") {
  const double slope = GENERATE(-3.0, -0.5, 0.5, 0.99);
  const LinearProblem problem{.a = Eigen::MatrixXd::Constant(1, 1, slope),
                              .b = Eigen::VectorXd::Constant(1, 1.5)};
  Aitken acceleration(0.1);
  CHECK(iterations(problem, acceleration, 1e-12, 10) == 2);
}

TEST_CASE("relaxation reduces the residual of one linear unknown by 1 - w (1 - a) each time") {
  const double slope = GENERATE(-2.0, 0.3), factor = GENERATE(0.2, 0.6, 1.0);
  std::vector<double> x{0};
  FixedRelaxation relaxation{factor};
  for (int k = 0; k < 4; ++k) {
    const std::vector<double> made{slope * x[0] + 1};
    const double residual = made[0] - x[0];
    relaxation.update(x, made);
    CHECK(slope * x[0] + 1 - x[0] == Approx(residual * (1 - factor * (1 - slope))).margin(1e-12));
  }
}

TEST_CASE(
    "columns of a window that mislead are dropped: after a change of the problem as few iterations as "
    "without any") {
  // Old columns of another problem make the residual grow; from then on only the window's own count.
  constexpr int unknowns = 8;
  const auto before = LinearProblem::random(unknowns, 0.9, 21),
             after = LinearProblem::random(unknowns, 0.9, 22);
  IqnIls remembers({.most_columns = 50, .reused_windows = 8, .filter = 1e-7}), fresh({.filter = 1e-7});
  for (int window = 0; window < 5; ++window) iterations(before, remembers, 1e-8, 50);
  CHECK(iterations(after, remembers, 1e-8, 50) <= iterations(after, fresh, 1e-8, 50) + 2);
}

TEST_CASE("Aitken does not judge a step that it has not made") {
  const LinearProblem problem{.a = Eigen::MatrixXd::Constant(1, 1, 0.5),
                              .b = Eigen::VectorXd::Constant(1, 1.5)};
  Aitken acceleration(0.25);
  acceleration.begin_window();
  std::vector<double> x{0};
  const auto made = [&] { return std::vector<double>{0.5 * x[0] + 1.5}; };
  acceleration.update(x, made());
  x = made();  // nothing touched: the scheme went on without it
  acceleration.step_aside();
  acceleration.update(x, made());
  CHECK(acceleration.factor() == 0.25);  // as at a window's start
}

TEST_CASE("Aitken begins a window with what it has learned, but never with more than its first factor") {
  const auto factor_after = [](double slope) {
    Aitken acceleration(0.25);
    std::vector<double> x{0};
    const auto made = [&] { return std::vector<double>{slope * x[0] + 1.5}; };
    acceleration.update(x, made());
    acceleration.update(x, made());  // 1/(1 - slope) for one linear unknown
    CHECK(acceleration.factor() == Approx(1 / (1 - slope)));
    acceleration.begin_window();
    acceleration.update(x, made());
    return acceleration.factor();
  };
  CHECK(factor_after(0.5) == 0.25);         // it had learned 2
  CHECK(factor_after(-9) == Approx(0.1));   // less is kept
  CHECK(factor_after(5) == Approx(-0.25));  // and the direction, too
}
