#pragma once

#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "fem_solver/model/model.hpp"

/// Small structures that several tests are made of.
namespace talus::tests {

inline const fem::AxialPart steel{.section = {.area = 1e-4, .youngs_modulus = 2e11, .prestress = 0},
                                  .density = 7850};
inline const fem::AxialPart wire{.section = {.area = 1e-5, .youngs_modulus = 1e9, .prestress = 1e8},
                                 .density = 7850};

/// Puts a part of bars or cables over the nodes of `model` and lumps the masses anew.
template <class Batch>
void add_part(fem::Model& model, const std::string& name, const fem::AxialPart& part,
              std::vector<std::array<fem::Index, 2>> segments) {
  std::vector<fem::Index> nodes;
  for (const auto& [near, far] : segments) nodes.insert(nodes.end(), {near, far});
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  model.parts.push_back({name, Batch(part, std::move(segments), model.reference), std::move(nodes)});
  fem::lump_masses(model);
}

/// A straight chain of `divisions` elements along x.
template <class Batch>
fem::Model chain(const fem::AxialPart& part, double length, fem::Index divisions) {
  fem::Model model;
  std::vector<std::array<fem::Index, 2>> segments;
  for (fem::Index i = 0; i <= divisions; ++i)
    model.reference.insert(model.reference.end(), {length * i / divisions, 0.0, 0.0});
  for (fem::Index i = 0; i < divisions; ++i) segments.push_back({i, i + 1});
  add_part<Batch>(model, "chain", part, std::move(segments));
  return model;
}

/// A square net of n x n nodes in z = 0 with its rim held.
template <class Batch>
fem::Model net(const fem::AxialPart& part, double pitch, fem::Index n) {
  fem::Model model;
  std::vector<std::array<fem::Index, 2>> segments;
  fem::Support rim{.name = "rim", .nodes = {}, .fixed = {true, true, true}, .history = {}};
  for (fem::Index j = 0; j < n; ++j) {
    for (fem::Index i = 0; i < n; ++i) {
      model.reference.insert(model.reference.end(), {pitch * i, pitch * j, 0.0});
      if (i + 1 < n) segments.push_back({j * n + i, j * n + i + 1});
      if (j + 1 < n) segments.push_back({j * n + i, j * n + i + n});
      if (i == 0 || j == 0 || i == n - 1 || j == n - 1) rim.nodes.push_back(j * n + i);
    }
  }
  add_part<Batch>(model, "net", part, std::move(segments));
  model.supports.push_back(std::move(rim));
  return model;
}

inline fem::Support fixed(std::vector<fem::Index> nodes,
                          std::array<bool, 3> directions = {true, true, true}) {
  return {.name = "support", .nodes = std::move(nodes), .fixed = directions, .history = {}};
}

/// One free node on a bar: a linear oscillator for small motion along the bar.
inline fem::Model oscillator() {
  fem::Model model = chain<fem::BarBatch>(steel, 1, 1);
  model.supports = {fixed({0}), fixed({1}, {false, true, true})};
  return model;
}

inline fem::NodalLoad load(fem::Index node, const fem::Vector3& force) {
  return {.name = "load", .nodes = {node}, .force = force, .history = {}};
}

struct Damping {
  double mass = 0, stiffness = 0;  // 1/s, s
};
/// The same for the whole structure.
inline void damp(fem::Model& model, const Damping& damping) {
  model.damping_rates.assign(model.node_masses.size(), damping.mass);
  fem::damp_by_stiffness(model, damping.stiffness);
}

}  // namespace talus::tests
