#include "dem_solver/scene/particles_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/scene/plausible.hpp"
#include "dem_solver/scene/scene_rules.hpp"

namespace talus::dem {

void describe(core::Fields& fields, SphereScene& sphere) {
  fields.required("material", sphere.material, {.help = "contact material; its density gives the mass"});
  fields.required("radius", sphere.radius,
                  {.unit = "m",
                   .range = core::positive,
                   .help = "of the sphere",
                   .plausible = core::plausible::rock_size});
  fields.required("at", sphere.at, {.unit = "m", .help = "the centre at time 0"});
  fields.with_default("velocity", sphere.velocity,
                      {.unit = "m/s", .help = "at time 0", .plausible = core::plausible::velocity});
  fields.with_default("spin", sphere.spin,
                      {.unit = "rad/s",
                       .help = "angular velocity at time 0; needs friction somewhere",
                       .plausible = core::plausible::spin});
}

void describe(core::Fields& fields, ImplicitContactScene& contact) {
  fields.with_default("tolerance", contact.tolerance,
                      {.range = {.low = 1e-12, .high = 0.1},
                       .help = "largest change of a contact force in a sweep, and of what its dashpot "
                               "answers to it, over the largest force"});
  fields.with_default("most_sweeps", contact.most_sweeps,
                      {.range = {.low = 1, .high = 100000},
                       .help = "sweeps after which a step goes on with what it has, counted in the summary"});
}

void describe(core::Fields& fields, ParticlesScene& particles) {
  fields.section("solver", particles.solver,
                 "the program that plays the particles' part, and how it is started");
  fields.optional("gravity", particles.gravity,
                  {.unit = "m/s^2",
                   .help = "acceleration of free fall; absent: none",
                   .plausible = core::plausible::gravity});
  fields.map("materials", particles.materials, "contact materials, by name", 1);
  fields.list("contacts", particles.contacts,
              "what happens between two materials; every pair that can meet needs an entry");
  fields.map("spheres", particles.spheres, "single spheres, by name");
  fields.map("rocks", particles.rocks, "rigid bodies of spheres, by name");
  fields.map("streams", particles.streams, "many spheres released from a box, by name");
  fields.map("planes", particles.planes, "infinite planes, by name");
  fields.map("boundaries", particles.boundaries,
             "rigid wires and faces at rest or at constant velocity, by name");
  fields.map("gates", particles.gates, "planes that count the stones which pass them, by name");
  fields.optional("step", particles.step,
                  {.unit = "s", .range = core::positive, .help = "of the particles; absent: time.step"});
  fields.section(
      "implicit_contact", particles.implicit_contact,
      "contacts with the structure's light nodes act with the velocity at the step's end, which is found "
      "together with the nodes' own motion; absent: with the velocity half a step ago");
  fields.rule(!(particles.step && particles.implicit_contact), "step",
              "contradicts implicit_contact, which takes one step a coupling window");
  fields.choice(
      "contact_rule", particles.contact_rule, {"automatic", "local_minima", "tangent_plane"},
      "which of the wires and faces that a sphere overlaps count: every local minimum of the distance as far "
      "as it "
      "stands out, or those not beyond a nearer one's tangent plane, as published curves have it; automatic: "
      "tangent_plane where a structure moves the boundary, else local_minima");
  fields.choice("unstable_step", particles.unstable_step, {"refused", "allowed"},
                "what to do with a step above a stability limit");
  fields.with_default("threads", particles.threads,
                      {.range = {.low = 1, .high = 1024}, .help = "any number gives the same bits"});
  for (const char* file : {"probes", "energy"})
    fields.rule(std::ranges::count(particles.gates, file, [](const auto& gate) { return gate.first; }) == 0,
                "gates", fmt::format("may not be named `{0}`: {0}.csv is another file of the result", file));
  check_references(fields, particles);
}

}  // namespace talus::dem
