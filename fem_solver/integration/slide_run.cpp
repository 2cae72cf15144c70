#include "fem_solver/integration/slide_run.hpp"

#include <algorithm>

#include "fem_solver/constraints/held_directions.hpp"

namespace talus::fem {
namespace {

std::vector<Index> nodes_that_take_part(const Model& model) {
  std::vector<Index> nodes;
  for (const auto& slide : model.constrained_slides)
    for (const auto* list : {&slide.line.rope, &slide.line.sliders})
      nodes.insert(nodes.end(), list->begin(), list->end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

SlideNetwork network_of(const Model& model, const std::vector<Index>& nodes) {
  const auto local = [&](Index node) {
    return static_cast<std::size_t>(std::ranges::lower_bound(nodes, node) - nodes.begin());
  };
  SlideNetwork network{.nodes = nodes.size(), .ropes = {}, .sliders = {}};
  for (const auto& slide : model.constrained_slides) {
    auto& rope = network.ropes.emplace_back();
    for (const Index node : slide.line.rope) rope.push_back(local(node));
    for (const Index node : slide.line.sliders)
      network.sliders.push_back({local(node), network.ropes.size() - 1});
  }
  return network;
}

}  // namespace

SlideRun::SlideRun(const Model& model)
    : model_(model), nodes_(nodes_that_take_part(model)), projection_(network_of(model, nodes_)) {
  for (const auto& slider : projection_.network().sliders) slides_.push_back(slider.rope);
  for (auto* array : {&positions_, &velocities_, &forces_, &pulls_}) array->resize(3 * nodes_.size());
  for (const Index node : nodes_)
    inverse_masses_.insert(inverse_masses_.end(), 3, 1 / model.node_masses[static_cast<std::size_t>(node)]);
  if (nodes_.empty()) return;
  for (const HeldDirection& h : held_directions(model)) {
    const auto found = std::ranges::lower_bound(nodes_, static_cast<Index>(h.direction / 3));
    if (found == nodes_.end() || *found != static_cast<Index>(h.direction / 3)) continue;
    const std::size_t local = 3 * static_cast<std::size_t>(found - nodes_.begin()) + h.direction % 3;
    inverse_masses_[local] = 0;
    held_.push_back({local, h.reaction});
  }
}

SlideState SlideRun::find(std::span<const double> displacement) {
  SlideState slides{.segments = std::vector<double>(slides_.size()),
                    .moves = std::vector<double>(positions_.size())};
  set_positions(displacement);
  projection_.search({positions_, slides.segments});
  return slides;
}

bool SlideRun::hold(const Step& step, const Arrays& arrays) noexcept {
  const bool stopped = stop(step, arrays);
  return put_back(arrays) && stopped;
}

void SlideRun::take(std::span<const double> from, std::span<double> to) const noexcept {
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    std::copy_n(&from[3 * static_cast<std::size_t>(nodes_[k])], 3, &to[3 * k]);
}

void SlideRun::set_positions(std::span<const double> displacement) noexcept {
  take(displacement, positions_);
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    Vector3::Map(&positions_[3 * k]) += model_.position(nodes_[k]);
}

/// From positions at the step's start and the velocities of the free step.
bool SlideRun::stop(const Step& step, const Arrays& arrays) noexcept {
  set_positions(arrays.displacement);
  take(arrays.velocity, velocities_);
  for (std::size_t i = 0; i < positions_.size(); ++i) positions_[i] -= step.length * velocities_[i];
  const bool converged = projection_.stop({positions_, arrays.slides.segments}, inverse_masses_, velocities_);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const auto node = 3 * static_cast<std::size_t>(nodes_[k]);
    for (std::size_t c = 0; c < 3; ++c) {
      const double change = velocities_[3 * k + c] - arrays.velocity[node + c];
      arrays.displacement[node + c] += step.length * change;
      arrays.velocity[node + c] += change;
      forces_[3 * k + c] = model_.node_masses[node / 3] * force_factor(step.kick, node / 3) * change;
      arrays.force[node + c] += forces_[3 * k + c];
    }
  }
  pull_supports(step.kick, arrays.reactions);
  return converged;
}

bool SlideRun::put_back(const Arrays& arrays) noexcept {
  set_positions(arrays.displacement);
  const bool converged =
      projection_.put_back({positions_, arrays.slides.segments}, inverse_masses_, arrays.slides.moves);
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    Vector3::Map(&arrays.displacement[3 * static_cast<std::size_t>(nodes_[k])]) +=
        Vector3::Map(&arrays.slides.moves[3 * k]);
  return converged;
}

double SlideRun::power(std::span<const double> velocity) const noexcept {
  double sum = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    sum +=
        Vector3::Map(&forces_[3 * k]).dot(Vector3::Map(&velocity[3 * static_cast<std::size_t>(nodes_[k])]));
  return sum;
}

double SlideRun::work_of_moves(const SlideState& slides, std::span<const double> force) const noexcept {
  double sum = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    sum +=
        Vector3::Map(&slides.moves[3 * k]).dot(Vector3::Map(&force[3 * static_cast<std::size_t>(nodes_[k])]));
  return sum;
}

void SlideRun::undo_moves(const SlideState& slides, std::span<double> displacement) const noexcept {
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    Vector3::Map(&displacement[3 * static_cast<std::size_t>(nodes_[k])]) -=
        Vector3::Map(&slides.moves[3 * k]);
}

/// Supports hold the share of the impulses that falls to their nodes.
void SlideRun::pull_supports(double kick, std::span<double> reactions) noexcept {
  if (held_.empty()) return;
  std::ranges::fill(pulls_, 0.0);
  for (std::size_t k = 0; k < projection_.contacts().size(); ++k) {
    const auto& contact = projection_.contacts()[k];
    const Vector3 impulse = Vector3::Map(&projection_.impulses()[3 * k]);
    Vector3::Map(&pulls_[3 * projection_.network().sliders[k].node]) += impulse;
    Vector3::Map(&pulls_[3 * contact.near]) -= (1 - contact.fraction) * impulse;
    Vector3::Map(&pulls_[3 * contact.far]) -= contact.fraction * impulse;
  }
  for (const auto& [direction, reaction] : held_) {
    const auto node = static_cast<std::size_t>(nodes_[direction / 3]);
    reactions[reaction] -= force_factor(kick, node) * pulls_[direction];
  }
}

double SlideRun::force_factor(double kick, std::size_t node) const noexcept {
  const double rate = model_.damping_rates.empty() ? 0 : model_.damping_rates[node];
  return (1 + 0.5 * rate * kick) / kick;
}

double SlideRun::largest_violation(std::size_t slide) const noexcept {
  double largest = 0;
  for (std::size_t k = 0; k < slides_.size(); ++k)
    if (slides_[k] == slide) largest = std::max(largest, projection_.contacts()[k].violation);
  return largest;
}

}  // namespace talus::fem
