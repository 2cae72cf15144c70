#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "fem_solver/constraints/penalty_sliding.hpp"
#include "fem_solver/constraints/slide_constraint.hpp"
#include "fem_solver/constraints/slide_projection.hpp"
#include "tests/support/finite_differences.hpp"
#include "tests/unit/fem_solver/elements_support.hpp"

using namespace talus;
using namespace talus::fem;
using namespace talus::test;

namespace {

using Vector9 = Eigen::Matrix<double, 9, 1>;
constexpr double alpha = 2069;

PenaltySlide slide_at(const Eigen::VectorXd& x) {
  return {{x.segment<3>(0), x.segment<3>(3), x.segment<3>(6)}, alpha};
}

Eigen::VectorXd penalty_force(const Eigen::VectorXd& x) {
  const PenaltySlide slide = slide_at(x);
  const double t = slide.fraction();
  Vector9 f;
  f << -(1 - t) * slide.slider_force(), -t * slide.slider_force(), slide.slider_force();
  return f;
}

/// A segment about a metre long and a slider beside it, before its start (-1), along it (0) or past its end
/// (1).
Vector9 random_slide(Dice& dice, int place) {
  const Vector3 A = dice.vector(1), w = dice.rotation().col(0) * dice.uniform(0.5, 2);
  const double t = place < 0   ? dice.uniform(-1, -0.1)
                   : place > 0 ? dice.uniform(1.1, 2)
                               : dice.uniform(0.05, 0.95);
  const Vector3 aside = w.cross(dice.vector(1)).normalized() * dice.uniform(0.01, 0.5);
  Vector9 x;
  x << A, A + w, A + t * w + aside;
  return x;
}

Vector3 moment(const Vector9& x, const Vector9& f) {
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < 9; i += 3) sum += Vector3(x.segment<3>(i)).cross(Vector3(f.segment<3>(i)));
  return sum;
}

}  // namespace

TEST_CASE("the force of penalty sliding is the derivative of [P eq. 6] and its stiffness that of its force") {
  Dice dice(51);
  for (int trial = 0; trial < 90; ++trial) {
    const int place = trial % 3 - 1;
    const Vector9 x = random_slide(dice, place);
    const auto eq6 = [&](const Eigen::VectorXd& y) {
      const Vector3 A = y.segment<3>(0), B = y.segment<3>(3), C = y.segment<3>(6);
      const double between = (A - C).cross(B - A).squaredNorm() / (B - A).squaredNorm();  // [P eq. 5]
      const double d2 = place < 0 ? (C - A).squaredNorm() : place > 0 ? (C - B).squaredNorm() : between;
      return as_vector(0.5 * alpha * d2);
    };
    CHECK(slide_at(x).energy() == Approx(eq6(x)[0]).epsilon(1e-12));
    // steps of 1e-6 m on metres: 1e-12 of curvature, 1e-10 of round-off
    CHECK((central_differences(eq6, x, 1e-6).transpose() - penalty_force(x)).norm() < 1e-8 * alpha);
    const PenaltySlide::Matrix9 K = slide_at(x).stiffness();
    CHECK((central_differences(penalty_force, x, 1e-6) - K).norm() < 1e-8 * alpha);
    CHECK((K - K.transpose()).norm() < 1e-13 * alpha);
  }
}

TEST_CASE("the printed [P eq. 7] is not the derivative of [P eq. 6]") {
  Dice dice(52);
  const Vector9 x = random_slide(dice, 0);
  const auto distance = [](const Eigen::VectorXd& y) { return as_vector(slide_at(y).gap()); };
  const Eigen::VectorXd printed = alpha * central_differences(distance, x, 1e-6).transpose();
  CHECK((printed * slide_at(x).gap() - penalty_force(x)).norm() < 1e-6 * alpha);  // with the factor d it is
  CHECK((printed - penalty_force(x)).norm() > 0.1 * alpha);
}

TEST_CASE("a slider pulled by 1000 N leaves a gap of force over penalty") {
  const double penalty = 206900, gap = 1000 / penalty;
  const PenaltySlide slide({Vector3(0, 0, 0), Vector3(2, 0, 0), Vector3(0.7, gap, 0)}, penalty);
  CHECK(slide.slider_force()[1] == Approx(1000).epsilon(1e-12));
  CHECK(gap == Approx(4.8332e-3).epsilon(1e-4));
}

TEST_CASE("penalty sliding has no resultant, no moment and turns with its nodes") {
  Dice dice(53);
  for (int trial = 0; trial < 30; ++trial) {
    const Vector9 x = random_slide(dice, trial % 3 - 1);
    const Vector9 f = penalty_force(x);
    CHECK((f.segment<3>(0) + f.segment<3>(3) + f.segment<3>(6)).norm() < 1e-13 * alpha);
    CHECK(moment(x, f).norm() < 1e-12 * alpha);
    const Eigen::Matrix3d R = dice.rotation();
    CHECK((penalty_force(turned(R, x)) - turned(R, f)).norm() < 1e-12 * alpha);
  }
}

TEST_CASE("a slider is handed over at a corner without a jump of energy and held at the ends of its rope") {
  const std::vector<Vector3> rope{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  const auto node = [&](std::size_t k) { return rope[k]; };
  const auto slide = [&](const Vector3& C) {
    const NearestSegment nearest = nearest_segment(2, node, C);
    return PenaltySlide({rope[nearest.segment], rope[nearest.segment + 1], C}, alpha);
  };
  Vector3 before_force = slide(Vector3(0.5, -0.05, 0.02)).slider_force();
  double before = slide(Vector3(0.5, -0.05, 0.02)).energy();
  // around the outside of the corner in steps of a millimetre: energy and force change by no more than a step
  // allows
  for (int k = 1; k < 1000; ++k) {
    const double s = 1e-3 * k;
    const Vector3 C = s < 0.5    ? Vector3(0.5 + s, -0.05, 0.02)
                      : s < 0.55 ? Vector3(0.5 + s, -0.05 + (s - 0.5), 0.02)
                                 : Vector3(1.05, s - 0.55, 0.02);
    const PenaltySlide now = slide(C);
    CHECK(std::abs(now.energy() - before) < 0.5 * alpha * 2 * 0.08 * 1.5e-3);
    CHECK((now.slider_force() - before_force).norm() < alpha * 1.5e-3);
    before = now.energy();
    before_force = now.slider_force();
  }
  // inside the corner both segments are equally near: the energy is the same from either
  CHECK(slide(Vector3(0.9 - 1e-9, 0.1, 0)).energy() ==
        Approx(slide(Vector3(0.9 + 1e-9, 0.1, 0)).energy()).epsilon(1e-6));
  const Vector3 past_end = slide(Vector3(1, 1.2, 0)).slider_force();
  CHECK((past_end - Vector3(0, 0.2 * alpha, 0)).norm() < 1e-12 * alpha);
}

TEST_CASE("the weights of a slide constraint are the derivative of [P eq. 11]") {
  Dice dice(54);
  for (int trial = 0; trial < 50; ++trial) {
    const Vector9 x = random_slide(dice, 0);
    const SlideConstraint slide({x.segment<3>(0), x.segment<3>(3), x.segment<3>(6)});
    const int a = slide.pivot;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto [b, weights, constant] = slide.row(i);
      const auto eq11 = [a, b = b](const Eigen::VectorXd& y) {  // position of C along b
        return as_vector(y[b] + (y[6 + a] - y[a]) * (y[3 + b] - y[b]) / (y[3 + a] - y[a]));
      };
      const Eigen::RowVectorXd slope = central_differences(eq11, x, 1e-6);
      const int masters[5] = {b, 3 + b, 6 + a, a, 3 + a};
      for (int k = 0; k < 5; ++k)
        CHECK(slope[masters[k]] == Approx(weights[static_cast<std::size_t>(k)]).margin(1e-8));
      CHECK(constant == Approx(eq11(x)[0] - x[6 + b]).margin(1e-13));
    }
    // the largest component leads, so that no weight exceeds 2 between the ends
    CHECK(std::abs(slide.slopes[0]) <= 1);
    CHECK(std::abs(slide.slopes[1]) <= 1);
    const Vector3 w = x.segment<3>(3) - x.segment<3>(0), v = x.segment<3>(0) - x.segment<3>(6);
    CHECK(slide.violation() == Approx(v.cross(w).norm() / w.norm()).epsilon(1e-10));
  }
}

TEST_CASE("the curvature of a slide constraint is the derivative of what its weights carry over") {
  Dice dice(59);
  for (int trial = 0; trial < 50; ++trial) {
    const Vector9 x = random_slide(dice, 0);
    const std::array<double, 2> pulls{dice.uniform(-10, 10), dice.uniform(-10, 10)};
    const auto at = [](const Eigen::VectorXd& y) {
      return SlideConstraint({y.segment<3>(0), y.segment<3>(3), y.segment<3>(6)});
    };
    const auto carried = [&](const Eigen::VectorXd& y) {
      Eigen::VectorXd force = Eigen::VectorXd::Zero(9);
      const SlideConstraint slide = at(y);
      for (std::size_t i = 0; i < 2; ++i) {
        const auto [b, weights, constant] = slide.row(i);
        const int masters[5] = {b, 3 + b, 6 + slide.pivot, slide.pivot, 3 + slide.pivot};
        for (std::size_t k = 0; k < 5; ++k) force[masters[k]] += weights[k] * pulls[i];
      }
      return force;
    };
    const Eigen::MatrixXd expected = central_differences(carried, x, 1e-6);
    CHECK((at(x).curvature(pulls) - expected).norm() < 1e-6 * (1 + expected.norm()));
  }
}

TEST_CASE(
    "the weights of a slide constraint carry force and moment over exactly, those of the printed eq. 13 do "
    "not") {
  Dice dice(55);
  for (int trial = 0; trial < 50; ++trial) {
    Vector9 x = random_slide(dice, 0);
    const Vector3 A = x.segment<3>(0), B = x.segment<3>(3);
    const SlideConstraint slide({A, B, A + 0.3 * (B - A)});
    x.segment<3>(6) = A + 0.3 * (B - A);
    Vector9 residual = Vector9::Zero();
    residual.segment<3>(6) = dice.vector(100);
    const Eigen::Matrix<double, 7, 1> reduced = slide.condensation().transpose() * residual;
    Vector9 carried = Vector9::Zero();
    carried.head<6>() = reduced.head<6>();
    carried[6 + slide.pivot] = reduced[6];
    const Vector3 sum = carried.segment<3>(0) + carried.segment<3>(3) + carried.segment<3>(6);
    CHECK((sum - residual.segment<3>(6)).norm() < 1e-12 * 100);
    CHECK((moment(x, carried) - moment(x, residual)).norm() < 1e-12 * 100);
    // eq. 13: u_A has -d_Y/d_X and u_B nothing
    const auto [b, weights, constant] = slide.row(0);
    Vector9 printed = Vector9::Zero();
    printed[6 + slide.pivot] = weights[2] * residual[6 + b];
    printed[slide.pivot] = -weights[2] * residual[6 + b];
    printed[b] = weights[0] * residual[6 + b];
    printed[3 + b] = weights[1] * residual[6 + b];
    Vector9 along_b = Vector9::Zero();
    along_b[6 + b] = residual[6 + b];
    if (std::abs(weights[2]) > 0.1 && std::abs(residual[6 + b]) > 10)
      CHECK((moment(x, printed) - moment(x, along_b)).norm() > 1e-3 * 100);
  }
}

namespace {

/// One rope along nodes 0, 1, ...; the sliders behind them.
SlideNetwork one_rope(std::size_t rope_nodes, std::size_t sliders) {
  SlideNetwork network{.nodes = rope_nodes + sliders, .ropes = {{}}, .sliders = {}};
  for (std::size_t k = 0; k < rope_nodes; ++k) network.ropes[0].push_back(k);
  for (std::size_t k = 0; k < sliders; ++k) network.sliders.push_back({rope_nodes + k, 0});
  return network;
}

}  // namespace

TEST_CASE("stopping velocities equals the condensed equations of motion") {
  // One rope segment and a slider of unlike masses: minimise the kinetic energy of the change over all
  // velocities that keep the constraint, with the slave directions eliminated: v = L z, (L^T M L) z = L^T M
  // v_free.
  Dice dice(56);
  for (int trial = 0; trial < 30; ++trial) {
    Vector9 x = random_slide(dice, 0);
    const Vector3 A = x.segment<3>(0), B = x.segment<3>(3);
    x.segment<3>(6) = A + dice.uniform(0.1, 0.9) * (B - A);
    const SlideConstraint slide({A, B, x.segment<3>(6)});
    const SlideConstraint::Condensation L = slide.condensation();
    Vector9 mass, v = Vector9::Random();
    for (int node = 0; node < 3; ++node) mass.segment<3>(3 * node).setConstant(dice.decades(0.1, 10));
    const Vector9 expected =
        L * (L.transpose() * mass.asDiagonal() * L).inverse() * (L.transpose() * mass.asDiagonal() * v);
    SlideProjection projection(one_rope(2, 1));
    const Vector9 inverse = mass.cwiseInverse();
    double segment = 0;
    REQUIRE(projection.stop({{x.data(), 9}, {&segment, 1}}, {inverse.data(), 9}, {v.data(), 9}));
    CHECK((v - expected).norm() < 1e-10);
  }
}

TEST_CASE("sliders that share rope nodes are held all at once and momentum stays") {
  Dice dice(57);
  constexpr std::size_t rope_nodes = 6, sliders = 9;
  SlideProjection projection(one_rope(rope_nodes, sliders));
  Eigen::VectorXd x(3 * (rope_nodes + sliders)), v = Eigen::VectorXd::Random(x.size()), inverse(x.size());
  for (std::size_t k = 0; k < rope_nodes; ++k)
    x.segment<3>(3 * static_cast<Eigen::Index>(k)) = Vector3(double(k), 0.2 * double(k * k), 0);
  for (std::size_t k = 0; k < sliders; ++k) {
    const auto segment = static_cast<Eigen::Index>(k % (rope_nodes - 1));
    const double t = dice.uniform(0.1, 0.9);
    x.segment<3>(3 * static_cast<Eigen::Index>(rope_nodes + k)) =
        (1 - t) * x.segment<3>(3 * segment) + t * x.segment<3>(3 * segment + 3);
  }
  for (Eigen::Index i = 0; i < x.size(); i += 3) inverse.segment<3>(i).setConstant(dice.decades(0.1, 10));
  const auto momentum = [&] {
    Vector3 sum = Vector3::Zero();
    for (Eigen::Index i = 0; i < x.size(); i += 3) sum += v.segment<3>(i) / inverse[i];
    return sum;
  };
  const Vector3 before = momentum();
  std::vector<double> segments(sliders);
  projection.search({span_of(x), segments});
  REQUIRE(projection.stop({span_of(x), segments}, span_of(inverse),
                          {v.data(), static_cast<std::size_t>(v.size())}));
  CHECK((momentum() - before).norm() < 1e-11);
  for (std::size_t k = 0; k < sliders; ++k) {
    const auto& contact = projection.contacts()[k];
    const auto C = static_cast<Eigen::Index>(rope_nodes + k), A = static_cast<Eigen::Index>(contact.near);
    const Vector3 relative = v.segment<3>(3 * C) - (1 - contact.fraction) * v.segment<3>(3 * A) -
                             contact.fraction * v.segment<3>(3 * A + 3);
    CHECK(relative.cross(contact.along).norm() < 1e-11);
  }
}

TEST_CASE("a slider off its rope is moved back without speed and one at the rope's end stays there") {
  SlideProjection projection(one_rope(2, 1));
  double segment = 0, moves[9];
  const double inverse[9] = {0, 0, 0, 0, 0, 0, 1, 1, 1};
  double x[9] = {0, 0, 0, 1, 0, 0, 0.4, 1e-3, 0}, v[9] = {0, 0, 0, 0, 0, 0, 3, 0.1, 0.2};
  REQUIRE(projection.stop({x, {&segment, 1}}, inverse, v));
  CHECK(projection.contacts()[0].violation == Approx(1e-3));
  CHECK(v[6] == 3);
  CHECK(v[7] == Approx(0).margin(1e-15));
  CHECK(v[8] == Approx(0).margin(1e-15));
  REQUIRE(projection.put_back({x, {&segment, 1}}, inverse, moves));
  CHECK(moves[6] == Approx(0).margin(1e-18));
  CHECK(x[7] + moves[7] == Approx(0).margin(1e-15));
  const double past_end[9] = {0, 0, 0, 1, 0, 0, 1.25, 0, 0};
  REQUIRE(projection.put_back({past_end, {&segment, 1}}, inverse, moves));
  CHECK(moves[6] == Approx(-0.25));
  double at_end[9] = {0, 0, 0, 1, 0, 0, 1, 0, 0}, leaving[9] = {0, 0, 0, 0, 0, 0, 3, 0, 0};
  REQUIRE(projection.stop({at_end, {&segment, 1}}, inverse, leaving));
  CHECK(projection.contacts()[0].at_end);
  CHECK(leaving[6] == Approx(0).margin(1e-15));
  double returning[9] = {0, 0, 0, 0, 0, 0, -3, 0, 0};
  REQUIRE(projection.stop({at_end, {&segment, 1}}, inverse, returning));
  CHECK(returning[6] == -3);
}

TEST_CASE("a slider that nearly follows its rope by itself gets no more impulse than it needs") {
  // A rigid turn about the origin and a slide along the rope keep the constraint; the impulse must be that of
  // the small speed across, not round-off of the large speeds divided by round-off.
  Dice dice(58);
  for (int trial = 0; trial < 2000; ++trial) {
    Vector9 x = random_slide(dice, 0), v;
    const Vector3 w = x.segment<3>(3) - x.segment<3>(0);
    x.segment<3>(6) = x.segment<3>(0) + dice.uniform(0.1, 0.9) * w;
    const Vector3 spin = dice.vector(3);
    for (int i = 0; i < 9; i += 3) v.segment<3>(i) = spin.cross(x.segment<3>(i));
    const double across = dice.decades(1e-12, 1);
    v.segment<3>(6) += dice.uniform(-5, 5) * w + across * w.cross(dice.vector(1)).normalized();
    const Vector9 before = v, inverse = Vector9::Ones();
    SlideProjection projection(one_rope(2, 1));
    double segment = 0;
    REQUIRE(projection.stop({{x.data(), 9}, {&segment, 1}}, {inverse.data(), 9}, {v.data(), 9}));
    CHECK((v - before).norm() < across + 1e-12 * (before.norm() + x.norm()));
  }
}

TEST_CASE("ropes that share a slider, and a slider that leads another rope, are held at once") {
  // Rope 0 along x through nodes 0, 1; rope 1 from node 2, which slides on rope 0, to node 3; node 4 slides on
  // rope 1; node 5 slides on both, where they cross at node 2's place would be singular, so it has rope 1 alone and
  // rope 2, which crosses it.
  SlideNetwork network{
      .nodes = 8, .ropes = {{0, 1}, {2, 3}, {6, 7}}, .sliders = {{2, 0}, {4, 1}, {5, 1}, {5, 2}}};
  Eigen::VectorXd x(24), v(24), inverse(24);
  x << 0, 0, 0, 4, 0, 0, 2, 0, 0, 2, 3, 0, 2, 1, 0, 2, 2, 0, 1, 2, 0, 3, 2, 0;
  Dice dice(59);
  for (Eigen::Index i = 0; i < 24; ++i) v[i] = dice.uniform(-3, 3);
  for (Eigen::Index i = 0; i < 24; i += 3) inverse.segment<3>(i).setConstant(dice.decades(0.1, 10));
  SlideProjection projection(network);
  std::vector<double> segments(4);
  const double before = (v.array().square() / inverse.array()).sum();
  REQUIRE(projection.stop({span_of(x), segments}, span_of(inverse), {v.data(), 24}));
  const auto across = [&](int slider, int near, int far, double t) {
    const Vector3 rate =
        v.segment<3>(3 * slider) - (1 - t) * v.segment<3>(3 * near) - t * v.segment<3>(3 * far);
    const Vector3 along = (x.segment<3>(3 * far) - x.segment<3>(3 * near)).normalized();
    return rate.cross(along).norm();
  };
  CHECK(across(2, 0, 1, 0.5) < 1e-11);
  CHECK(across(4, 2, 3, 1.0 / 3) < 1e-11);
  CHECK(across(5, 2, 3, 2.0 / 3) < 1e-11);
  CHECK(across(5, 6, 7, 0.5) < 1e-11);
  // Gauss: what is taken is orthogonal to what stays
  CHECK((v.array().square() / inverse.array()).sum() < before);
}

TEST_CASE("a slider runs round a closed rope past the node where the rope begins") {
  SlideNetwork network{.nodes = 5, .ropes = {{0, 1, 2, 3, 0}}, .sliders = {{4, 0}}};
  SlideProjection projection(network);
  std::vector<double> inverse(15, 0.0), segment{3};
  inverse[12] = inverse[13] = inverse[14] = 1;
  // square with corners (0,0), (1,0), (1,1), (0,1); the slider comes down the last side towards (0,0)
  std::vector<double> x{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0.01, 0}, v(15, 0.0), moves(15);
  v[12] = 0.5;
  v[13] = -2;
  REQUIRE(projection.stop({x, segment}, inverse, v));
  CHECK(segment[0] == 3);
  CHECK(v[12] == Approx(0).margin(1e-14));
  CHECK(v[13] == -2);
  x[12] = 0.01;  // round the corner
  x[13] = -0.001;
  REQUIRE(projection.put_back({x, segment}, inverse, moves));
  CHECK(segment[0] == 0);
  CHECK(moves[12] == Approx(0).margin(1e-15));
  CHECK(moves[13] == Approx(0.001));
}
