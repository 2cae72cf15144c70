#include "dem_solver/scene/scene_rules.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace talus::dem {

std::int64_t material_index(const ParticlesScene& particles, const std::string& name) {
  const auto found =
      std::ranges::find(particles.materials, name, &std::pair<std::string, MaterialScene>::first);
  return found == particles.materials.end() ? -1 : found - particles.materials.begin();
}

const ContactScene* find_contact(const ParticlesScene& particles, const std::string& a,
                                 const std::string& b) {
  for (const ContactScene& contact : particles.contacts) {
    if (contact.between.size() != 2) continue;
    const auto &x = contact.between[0], &y = contact.between[1];
    if ((x == a && y == b) || (x == b && y == a)) return &contact;
  }
  return nullptr;
}

std::vector<Body> bodies_of(const ParticlesScene& particles) {
  std::vector<Body> bodies;
  for (const auto& [name, sphere] : particles.spheres) bodies.push_back({"spheres", name, sphere.material});
  for (const auto& [name, rock] : particles.rocks) bodies.push_back({"rocks", name, rock.material});
  for (const auto& [name, stream] : particles.streams)
    bodies.push_back({"streams", name, stream.material, stream.count});
  return bodies;
}

std::string missing_contact_message(const std::string& a, const std::string& b) {
  return "no contact between `" + a + "` and `" + b + "`, which can meet: add an entry with `between: [" + a +
         ", " + b + "]` to particles.contacts";
}

namespace {

std::string known_materials(const ParticlesScene& particles) {
  std::string names;
  for (const auto& [name, material] : particles.materials) names += (names.empty() ? "" : ", ") + name;
  return names;
}

/// Material names as they are used, each checked once.
class References {
 public:
  References(core::Fields& fields, const ParticlesScene& particles)
      : fields_(fields), particles_(particles) {}

  void material(const char* key, const std::string& user, const std::string& name) {
    const bool known = material_index(particles_, name) >= 0;
    fields_.rule(known, key,
                 user + ": there is no material `" + name + "`; known: " + known_materials(particles_));
  }

 private:
  core::Fields& fields_;
  const ParticlesScene& particles_;
};

void check_names(core::Fields& fields, const ParticlesScene& particles) {
  References check(fields, particles);
  for (const Body& body : bodies_of(particles)) {
    check.material(body.section, body.name, body.material);
    const auto index = material_index(particles, body.material);
    fields.rule(index < 0 || particles.materials[index].second.density, body.section,
                body.name + ": material `" + body.material + "` has no density, which its mass needs");
  }
  for (const auto& [name, plane] : particles.planes) check.material("planes", name, plane.material);
  for (const auto& [name, boundary] : particles.boundaries)
    check.material("boundaries", name, boundary.material);
  for (const ContactScene& contact : particles.contacts)
    for (const std::string& name : contact.between) check.material("contacts", "between", name);
}

void check_pairs(core::Fields& fields, const ParticlesScene& particles) {
  std::map<std::string, std::int64_t> moving;
  std::set<std::string> walls;
  for (const Body& body : bodies_of(particles)) moving[body.material] += body.count;
  for (const auto& [name, plane] : particles.planes) walls.insert(plane.material);
  for (const auto& [name, boundary] : particles.boundaries) walls.insert(boundary.material);
  const auto need = [&](const std::string& a, const std::string& b) {
    fields.rule(find_contact(particles, a, b) != nullptr, "contacts", missing_contact_message(a, b));
  };
  for (const auto& [a, count] : moving) {
    for (const auto& [b, other_count] : moving)
      if (a < b || (a == b && count > 1)) need(a, b);
    for (const std::string& wall : walls) need(a, wall);
  }
}

HertzScene::Loss loss_of(const ContactScene& contact) {
  const auto* hertz = std::get_if<HertzScene>(&contact.normal);
  return hertz != nullptr ? hertz->loss : HertzScene::Loss::dashpot;
}

bool has_dashpots(const ContactScene& contact) {
  return !std::holds_alternative<FoundationScene>(contact.normal) &&
         loss_of(contact) == HertzScene::Loss::dashpot;
}

void check_laws(core::Fields& fields, const ParticlesScene& particles) {
  const bool spreads = std::ranges::any_of(particles.contacts, [](const ContactScene& contact) {
    return std::holds_alternative<FoundationScene>(contact.normal);
  });
  for (const auto& [name, rock] : particles.rocks)
    fields.rule(
        !spreads || stands_for_surface(rock), "rocks",
        name +
            ": the contact law `foundation` needs spheres along the rock's surface: give `spacing` in place "
            "of `deviation`, half of what the smallest face measures or less");
  std::set<std::pair<std::string, std::string>> seen;
  for (const ContactScene& contact : particles.contacts) {
    const ContactScene& first = particles.contacts.front();
    fields.rule(contact.normal.index() == first.normal.index(), "contacts",
                "all contacts of a scene need the same normal law, `hertz`, `linear` or `foundation`");
    fields.rule(loss_of(contact) == loss_of(first), "contacts",
                "all contacts of a scene need the same `hertz.loss`");
    fields.rule(!contact.rolling || has_dashpots(contact), "contacts",
                "`rolling` needs a law with dashpots: `hertz` with `loss: dashpot`, or `linear`. The others "
                "are laws of "
                "rocks, whose resistance to rolling is not that of their spheres");
    fields.rule(
        !particles.implicit_contact || has_dashpots(contact), "implicit_contact",
        "is for laws with dashpots, which limit the step on light nodes; `foundation` and `loss: hysteretic` "
        "have none");
    fields.rule(!contact.rolling || std::ranges::all_of(particles.contacts,
                                                        [&](const ContactScene& other) {
                                                          return !other.rolling ||
                                                                 other.rolling->kind.index() ==
                                                                     contact.rolling->kind.index();
                                                        }),
                "contacts", "all contacts of a scene need the same kind of rolling resistance");
    if (contact.between.size() != 2) continue;
    const auto pair = std::minmax(contact.between[0], contact.between[1]);
    fields.rule(seen.insert({pair.first, pair.second}).second, "contacts",
                "there are two entries between `" + pair.first + "` and `" + pair.second + "`");
  }
}

}  // namespace

void check_references(core::Fields& fields, const ParticlesScene& particles) {
  check_names(fields, particles);
  check_pairs(fields, particles);
  check_laws(fields, particles);
}

}  // namespace talus::dem
