#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "dem_solver/contact/contact_model.hpp"
#include "dem_solver/contact/restitution.hpp"

using namespace talus::dem;

namespace {

Touch<double> touch_with(double overlap) {
  return {.normal = {0, 0, 1},
          .overlap = overlap,
          .velocity = {},
          .travelled = {},
          .spin = {},
          .reduced_radius = 0.05,
          .reduced_mass = 2};
}

template <class Law>
void check_derivatives(const ContactParameters<double>& p) {
  const double overlap = 1e-3, h = 1e-3 * overlap;  // central differences: relative error (h/d)^2/24
  const auto energy = [&](double d) { return Law::template energy<double>(touch_with(d), p); };
  const auto force = [&](double d) { return Law::template force<double>(touch_with(d), p).elastic; };
  CHECK((energy(overlap + h) - energy(overlap - h)) / (2 * h) == Approx(force(overlap)).epsilon(1e-6));
  CHECK((force(overlap + h) - force(overlap - h)) / (2 * h) ==
        Approx(Law::template force<double>(touch_with(overlap), p).stiffness).epsilon(1e-6));
}

}  // namespace

TEST_CASE("The normal force is the derivative of its energy, and the stiffness that of the force") {
  check_derivatives<Hertz>({.normal = {5e6, 3e6, 0, 0}, .friction = {}, .rolling = {}});
  check_derivatives<LinearSpring>({.normal = {5e6, 3e6, 0, 0}, .friction = {}, .rolling = {}});
}

TEST_CASE("A damped oscillator that may not pull rebounds as its integrated motion does") {
  const double z = GENERATE(0.05, 0.3, 0.7, 1.0, 1.5);
  double x = 0, v = 1;
  const double h = 1e-5;
  while (true) {  // midpoint rule until the force would pull
    const double vm = v + 0.5 * h * (-2 * z * v - x), xm = x + 0.5 * h * v;
    const double vn = v + h * (-2 * z * vm - xm), xn = x + h * vm;
    if (-2 * z * vn - xn > 0 && vn < 0) break;
    v = vn;
    x = xn;
  }
  CHECK(oscillator_restitution(z) == Approx(-v).epsilon(1e-4));
}

TEST_CASE("The damping ratio of a Hertz contact is that of the published solutions") {
  // Solutions of the scalar collision problem to four digits.
  for (const auto& [e, g] :
       {std::pair{0.1, 1.1349}, {0.2, 0.6675}, {0.3, 0.4539}, {0.5, 0.2330}, {0.7, 0.1116}, {0.9, 0.0313}})
    CHECK(hertz_damping_ratio(e) == Approx(g).margin(6e-5));
  CHECK(hertz_damping_ratio(1) == 0);
}

TEST_CASE("One contact and four at a time give the same bits") {
  using Law = ContactLaw<Hertz, Friction, NoTerm, NoTerm>;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  Touch<Lanes> four;
  Touch<double> one[4];
  Law::Memory<Lanes> memory{};
  for (int k = 0; k < 4; ++k) {
    one[k] = touch_with(1e-3 * (u(random) + 0.8));
    one[k].velocity = {u(random), u(random), u(random)};
    four.normal.x[k] = 0;
    four.normal.y[k] = 0;
    four.normal.z[k] = 1;
    four.overlap[k] = one[k].overlap;
    four.velocity.x[k] = one[k].velocity.x;
    four.velocity.y[k] = one[k].velocity.y;
    four.velocity.z[k] = one[k].velocity.z;
    four.reduced_radius[k] = one[k].reduced_radius;
    four.reduced_mass[k] = one[k].reduced_mass;
  }
  const Lanes none{};
  const ContactParameters<Lanes> p4{
      {none + 5e6, none + 3e6, none + 0.2, none}, {none + 0.4, none + 0.4, none, none}, {}};
  const ContactParameters<double> p1{{5e6, 3e6, 0.2, 0}, {0.4, 0.4, 0, 0}, {}};
  ContactLoss<Lanes> loss4;
  const ContactLoad<Lanes> loads = Law::evaluate(four, p4, 1e-5, memory, loss4);
  for (int k = 0; k < 4; ++k) {
    Law::Memory<double> own{};
    ContactLoss<double> loss;
    const ContactLoad<double> load = Law::evaluate(one[k], p1, 1e-5, own, loss);
    CHECK(load.force.x == loads.force.x[k]);
    CHECK(load.force.y == loads.force.y[k]);
    CHECK(load.force.z == loads.force.z[k]);
    CHECK(own[0].w == memory[0].w[k]);
  }
}

TEMPLATE_TEST_CASE(
    "A hysteretic contact gives back the asked part of its work, and of more work where it is pressed deeper",
    "", HystereticHertz, Foundation) {
  const double e = GENERATE(0.9, 0.5, 0.1), deepest = 2e-3, step = 1e-7;
  const ContactParameters<double> p{{5e6, 3e6, e * e, 0}, {}, {}};
  Quad<double> memory{};
  double last = 0, overlap = 0, given = 0, taken = 0;
  const auto move_to = [&](double target) {
    const int steps = static_cast<int>(std::ceil(std::abs(target - overlap) / step));
    const double way = (target - overlap) / steps;
    for (int n = 0; n < steps; ++n) {
      overlap += way;
      Touch<double> touch = touch_with(overlap);
      touch.area = 0.01;
      const double f = TestType::template force<double>(touch, p, &memory).elastic,
                   work = 0.5 * (last + f) * way;
      (way > 0 ? given : taken) += std::abs(work);
      last = f;
      if (overlap > 0)
        REQUIRE(given - taken == Approx(TestType::template energy<double>(touch, p, &memory) +
                                        TestType::template lost<double>(touch, p, &memory))
                                     .epsilon(1e-3)
                                     .margin(1e-9));
    }
  };
  move_to(deepest / 2);
  move_to(deepest / 2 * (1 - 0.5 * e * e));  // half of the way back: nothing more is lost
  move_to(deepest);
  move_to(0);
  const Quad<double> deep{0.01, 0, 0, deepest};
  const double work = TestType::template lost<double>(touch_with(deepest), p, &deep) / (1 - e * e);
  CHECK(given - taken == Approx((1 - e * e) * work).epsilon(1e-3));
  CHECK(memory.w == 0);  // forgotten where the contact ends
}

TEST_CASE(
    "A tangential spring under a tenth of its load returns what its softened stiffness holds, and no more") {
  ContactParameters<double> p{{5e6, 3e6, 0, 0}, {10, 10, 0, 0}, {}};
  Quad<double> memory{};
  double work = 0;
  const double step = 1e-5;
  const auto move = [&](double overlap, double speed) {
    Touch<double> touch = touch_with(overlap);
    touch.velocity = {speed, 0, 0};
    const double before = memory.x;
    const NormalForce<double> normal = Hertz::force<double>(touch, p);
    const Triple<double> f = Friction::force<double>(touch, normal, p, step, memory);
    work -= 0.5 * (before + f.x) * speed * step;  // put into the spring
  };
  for (int n = 0; n < 100; ++n) move(1e-3, 0.1);                 // stretch under full load
  for (int n = 0; n < 90; ++n) move(1e-3 * (1 - n / 100.0), 0);  // unload
  const double given = work;
  for (int n = 0; n < 1000 && memory.x < 0; ++n) move(1e-4, -0.1);  // let it pull back
  // Stretched by s it holds kt s^2/2; unloaded it keeps its stretch, and kt goes with the root of the overlap.
  const double stretch = 100 * 0.1 * step, kt = 8 * p.normal.y * std::sqrt(0.05 * 1e-3);
  CHECK(given == Approx(0.5 * kt * stretch * stretch).epsilon(1e-3));
  CHECK(given - work == Approx(std::sqrt(0.1) * given).epsilon(1e-2));
}
