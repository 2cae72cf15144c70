#include "bench/impacts/impacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "dem_solver/contact/restitution.hpp"
#include "dem_solver/solver.hpp"

namespace talus::bench {

namespace {

using namespace dem;

struct Substance {
  const char* name;
  double youngs_modulus, poissons_ratio, density;  ///< Pa, 1, kg/m^3
  Material material() const {
    return {
        .name = name, .density = density, .youngs_modulus = youngs_modulus, .poissons_ratio = poissons_ratio};
  }
};
constexpr Substance glass{"glass", 4.8e10, 0.20, 2800}, limestone{"limestone", 2.0e10, 0.25, 2500},
    aluminium{"aluminium", 7.0e10, 0.30, 2699}, magnesium{"magnesium", 4.0e10, 0.35, 1800},
    oxide{"aluminium oxide", 3.8e11, 0.23, 4000}, steel{"steel", 2.08e11, 0.30, 7850},
    polyethylene{"polyethylene", 1.0e9, 0.40, 1400}, nylon{"nylon", 2.5e9, 0.40, 1000};
constexpr Substance rigid{"rigid", 1e20, 0.25, 0};

/// A sphere that flies down at a partner below it: a rigid plane, or another sphere.
struct Impact {
  const Substance& substance;
  double radius = 0;
  double restitution = 1, friction = 0;
  double normal_speed = 0;                    ///< m/s; of approach
  double tangential_speed = 0;                ///< m/s; of the centre
  double spin = 0;                            ///< rad/s; about y
  std::optional<double> partner_radius = {};  ///< m; absent: a plane
  double partner_spin = 0;                    ///< rad/s
};

struct Outcome {
  double normal_speed = 0, tangential_speed = 0, spin = 0;  ///< after; of the first sphere
  double largest_overlap = 0, largest_force = 0, duration = 0;
};

double mass_of(const Substance& substance, double radius) {
  return substance.density * 4 / 3 * std::numbers::pi * radius * radius * radius;
}

/// Reduced radius, mass and modulus of an impact, and Hertz's exact values for e = 1 (Johnson, Contact
/// Mechanics, 1985, section 11.4).
struct Hertz {
  double radius, mass, modulus, speed;

  explicit Hertz(const Impact& i) : speed(i.normal_speed) {
    const double own = mass_of(i.substance, i.radius);
    const auto reduced = [](double a, double b) { return a * b / (a + b); };
    radius = i.partner_radius ? reduced(i.radius, *i.partner_radius) : i.radius;
    mass = i.partner_radius ? reduced(own, mass_of(i.substance, *i.partner_radius)) : own;
    modulus =
        effective_moduli(i.substance.material(), i.partner_radius ? i.substance.material() : rigid.material())
            .normal;
  }
  double overlap() const {
    return std::pow(15 * mass * speed * speed / (16 * modulus * std::sqrt(radius)), 0.4);
  }
  double force() const { return 4.0 / 3 * modulus * std::sqrt(radius) * std::pow(overlap(), 1.5); }
  double duration() const {
    return 2 * overlap() / speed * std::sqrt(std::numbers::pi) * std::tgamma(1.4) / std::tgamma(0.9);
  }
};

/// An oblique impact that sticks or slips to and fro has no closed form. What the law says of it [Mindlin's stiffness
/// without slip, cut by Coulomb's limit; friction.hpp] is integrated here once more, in scalars and steps a tenth as
/// long, for bodies whose contact point stays at R from the centre:
///     m* d'' = -Fn        m* s' = 7/2 Ft        S' = -8 G* sqrt(R* d) s + min(0, kt'/kt) S,  |S| <= mu Fn
///     Ft = S - ct s,  |Ft| <= mu Fn             d overlap, s slip, S the tangential spring's force
/// Against it only the code is checked, not the law.
struct Oblique {
  const Impact& impact;
  Hertz hertz;

  explicit Oblique(const Impact& i) : impact(i), hertz(i) {}

  /// N s; of the tangential force on the first sphere.
  double impulse(double slip) const {
    const double h = hertz.duration() / 20000;
    double overlap = 0, approach = hertz.speed, spring = 0, stiffness = 0, sum = 0;
    while (overlap > 0 || approach > 0) {
      const Forces f = forces(overlap, approach, slip, {spring * unloaded(overlap, stiffness), h});
      spring = f.spring;
      stiffness = tangential_stiffness(overlap);
      approach -= h * f.normal / hertz.mass;
      slip += h * 3.5 * f.tangential / hertz.mass;
      overlap += h * approach;
      sum += h * f.tangential;
    }
    return sum;
  }

 private:
  struct Forces {
    double normal, tangential, spring;
  };
  struct Spring {
    double force, step;  // N, s
  };
  /// 1/G* = sum (2 - v)/G, G = E/(2 (1 + v)); a rigid partner adds nothing.
  double shear_modulus() const {
    const Substance& s = impact.substance;
    const double one = 2 * (1 + s.poissons_ratio) * (2 - s.poissons_ratio) / s.youngs_modulus;
    return 1 / (impact.partner_radius ? 2 * one : one);
  }
  double tangential_stiffness(double overlap) const {
    return overlap > 0 ? 8 * shear_modulus() * std::sqrt(hertz.radius * overlap) : 0;
  }
  double unloaded(double overlap, double before) const {
    const double now = tangential_stiffness(overlap);
    return now < before ? now / before : 1;
  }
  Forces forces(double overlap, double approach, double slip, const Spring& before) const {
    if (overlap <= 0) return {0, 0, 0};
    const double normal_stiffness = 2 * hertz.modulus * std::sqrt(hertz.radius * overlap),
                 stiffness = tangential_stiffness(overlap), damping = hertz_damping_ratio(impact.restitution);
    const double normal =
        std::max(0.0, 2.0 / 3 * normal_stiffness * overlap +
                          2 * damping * std::sqrt(hertz.mass * normal_stiffness) * approach);
    const double limit = impact.friction * normal;
    const double stretched = before.force - stiffness * slip * before.step;
    const double spring = std::clamp(stretched, -limit, limit);
    const double wanted = stretched - 2 * damping * std::sqrt(hertz.mass * stiffness) * slip;
    return {normal, std::clamp(wanted, -limit, limit), spring};
  }
};

constexpr int steps_in_contact = 2000;

ParticleModel model_of(const Impact& i) {
  ParticleModel model;
  model.step = Hertz(i).duration() / steps_in_contact;
  model.pairs = PairTable(2);
  for (const auto& [partner, index] : {std::pair{i.substance, 0}, std::pair{rigid, 1}}) {
    PairParameters p = pair_parameters(HertzContact{i.restitution},
                                       effective_moduli(i.substance.material(), partner.material()));
    set_friction(p, {.at_rest = i.friction, .sliding = i.friction});
    model.pairs.set(0, index, p);
  }
  if (i.friction > 0) model.law.friction = LawChoice::FrictionKind::constant;
  const double touching = i.radius * (1 + 1e-12);
  // Two equal spheres share the approach; a plane and a larger sphere are met at rest.
  const bool shared = i.partner_radius && *i.partner_radius == i.radius;
  const double own_speed = shared ? i.normal_speed / 2 : i.normal_speed;
  model.spheres = {{.position = {0, 0, touching},
                    .velocity = {i.tangential_speed, 0, -own_speed},
                    .spin = {0, i.spin, 0},
                    .radius = i.radius,
                    .mass = mass_of(i.substance, i.radius)}};
  if (i.partner_radius)
    model.spheres.push_back({.position = {0, 0, -*i.partner_radius},
                             .velocity = {0, 0, i.normal_speed - own_speed},
                             .spin = {0, i.partner_spin, 0},
                             .radius = *i.partner_radius,
                             .mass = mass_of(i.substance, *i.partner_radius)});
  else
    model.planes = {{.name = "plane", .point = {}, .normal = {0, 0, 1}, .material = 1}};
  return model;
}

Outcome run(const Impact& i) {
  ParticleSolver solver(model_of(i));
  const auto centre = [&](Index id) { return triple<double>(solver.spheres().position[solver.place(id)]); };
  const auto overlap = [&] {
    return i.partner_radius ? i.radius + *i.partner_radius - length(centre(0) - centre(1))
                            : i.radius - centre(0).z;
  };
  Outcome out;
  int steps = 0;
  // A damped contact lasts longer, but never twice as long.
  for (int n = 0; n < 2 * steps_in_contact; ++n) {
    const double now = overlap();
    if (now > 0) ++steps;
    solver.step();
    out.largest_overlap = std::max(out.largest_overlap, now);
    out.largest_force =
        std::max(out.largest_force, length(triple<double>(solver.spheres().force[solver.place(0)])));
  }
  const Index own = solver.place(0);
  out.duration = steps * solver.step_length();
  out.normal_speed = solver.spheres().velocity[own].z;
  out.tangential_speed = solver.spheres().velocity[own].x;
  if (solver.spheres().rotates()) out.spin = solver.spheres().spin[own].y;
  return out;
}

/// Peaks are met within (pi/2 / steps)^2, begin and end of the contact within a step each.
constexpr double hertz_tolerance = 2e-3;
/// The dashpot's velocity is half a step old.
constexpr double restitution_tolerance = 2e-3;
/// The tangential spring needs a moment to stretch to the limit of friction. To this comes what the rigid
/// bodies of the theory don't have: the contact point is nearer to the centre than R, by up to the overlap.
constexpr double oblique_tolerance = 4e-3;

void head_on(std::vector<ImpactResult>& rows, int test, const Impact& impact) {
  const Outcome out = run(impact);
  const Hertz exact(impact);
  const auto add = [&](const char* quantity, double computed, double expected) {
    rows.push_back({test, impact.substance.name, quantity, computed, expected, expected, hertz_tolerance});
  };
  add("largest overlap, m", out.largest_overlap, exact.overlap());
  add("largest force, N", out.largest_force, exact.force());
  add("duration, s", out.duration, exact.duration());
}

/// Speeds after an oblique impact. Errors are relative to the slip before it, the scale of all of them.
void oblique(std::vector<ImpactResult>& rows, int test, const Impact& impact, const std::string& situation) {
  const Outcome out = run(impact);
  const double share = Hertz(impact).mass / mass_of(impact.substance, impact.radius);
  const double slip = impact.tangential_speed - impact.radius * impact.spin;
  const double impulse = impact.friction * (1 + impact.restitution) * impact.normal_speed;
  const double tolerance = oblique_tolerance + Hertz(impact).overlap() / impact.radius;
  const auto add = [&](const char* quantity, double computed, double expected) {
    rows.push_back({test, situation, quantity, computed, expected, std::abs(slip), tolerance});
  };
  // The slip changes by 7/2 of the impulse over m*, whichever sphere turns.
  if (std::abs(slip) > 1.1 * 3.5 * impulse) {
    const double gain = -std::copysign(impulse * share, slip);
    add("tangential speed after sliding, m/s", out.tangential_speed, impact.tangential_speed + gain);
    add("R x spin after sliding, m/s", impact.radius * out.spin, impact.radius * impact.spin - 2.5 * gain);
    return;
  }
  const double gain = Oblique(impact).impulse(slip) / mass_of(impact.substance, impact.radius);
  add("tangential speed after sticking, m/s", out.tangential_speed, impact.tangential_speed + gain);
  add("R x spin after sticking, m/s", impact.radius * out.spin, impact.radius * impact.spin - 2.5 * gain);
  rows.back().tolerance *=
      2.5;  // what the impulse is wrong by turns the sphere 5/2 times as fast as it moves it
}

void test_3(std::vector<ImpactResult>& rows) {
  for (const double e : {0.1, 0.2, 0.4, 0.6, 0.8, 1.0}) {
    const Impact impact{.substance = oxide, .radius = 0.0025, .restitution = e, .normal_speed = 3.9};
    rows.push_back({3, fmt::format("{}, e {:.1f}", oxide.name, e), "rebound over approach speed",
                    run(impact).normal_speed / 3.9, e, e, restitution_tolerance});
  }
}

void test_4(std::vector<ImpactResult>& rows) {
  for (const double degrees : {5, 20, 35, 45, 60, 80}) {
    const double angle = degrees * std::numbers::pi / 180;
    oblique(rows, 4,
            {.substance = oxide,
             .radius = 0.0025,
             .restitution = 0.98,
             .friction = 0.092,
             .normal_speed = 3.9 * std::cos(angle),
             .tangential_speed = 3.9 * std::sin(angle)},
            fmt::format("{}, {} degrees", oxide.name, degrees));
  }
}

void test_5(std::vector<ImpactResult>& rows) {
  for (const Substance* s : {&steel, &polyethylene})
    for (const double tangential : {1.0, 5.0, 15.0, 25.0})
      oblique(rows, 5,
              {.substance = *s,
               .radius = 1e-5,
               .friction = 0.3,
               .normal_speed = 5,
               .tangential_speed = tangential},
              fmt::format("{}, {} m/s along", s->name, tangential));
}

void test_6(std::vector<ImpactResult>& rows) {
  for (const Substance* s : {&aluminium, &nylon})
    for (const double spin : {0.175, 2.0, 6.0, 12.0, 22.86})
      oblique(rows, 6,
              {.substance = *s,
               .radius = 0.1,
               .restitution = 0.5,
               .friction = 0.4,
               .normal_speed = 0.2,
               .spin = spin},
              fmt::format("{}, {} rad/s", s->name, spin));
}

void test_7(std::vector<ImpactResult>& rows) {
  for (const Substance* s : {&aluminium, &nylon})
    for (const double spin : {0.175, 2.0, 22.86}) {
      const Outcome out = run({.substance = *s,
                               .radius = 0.1,
                               .restitution = 0.5,
                               .friction = 0.4,
                               .normal_speed = 0.4,
                               .spin = spin,
                               .partner_radius = 0.1,
                               .partner_spin = -spin});
      const std::string situation = fmt::format("{}, {} rad/s", s->name, spin);
      constexpr double round_off = 1e-12;
      rows.push_back({7, situation, "tangential speed, m/s", out.tangential_speed, 0, 0.1 * spin, round_off});
      rows.push_back({7, situation, "spin, rad/s", out.spin, spin, spin, round_off});
    }
}

void test_8(std::vector<ImpactResult>& rows) {
  for (const Substance* s : {&aluminium, &nylon})
    for (const double spin : {0.175, 2.0, 6.0, 12.0, 22.86})
      oblique(rows, 8,
              {.substance = *s,
               .radius = 0.1,
               .restitution = 0.5,
               .friction = 0.4,
               .normal_speed = 0.2,
               .spin = spin,
               .partner_radius = 0.5},
              fmt::format("{}, {} rad/s", s->name, spin));
}

}  // namespace

std::vector<ImpactResult> run_impacts() {
  std::vector<ImpactResult> rows;
  for (const Substance* s : {&glass, &limestone})
    head_on(rows, 1, {.substance = *s, .radius = 0.01, .normal_speed = 20, .partner_radius = 0.01});
  for (const Substance* s : {&aluminium, &magnesium})
    head_on(rows, 2, {.substance = *s, .radius = 0.1, .normal_speed = 0.2});
  test_3(rows);
  test_4(rows);
  test_5(rows);
  test_6(rows);
  test_7(rows);
  test_8(rows);
  return rows;
}

}  // namespace talus::bench
