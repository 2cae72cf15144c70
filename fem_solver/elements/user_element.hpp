#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

/// Elements that a program of its own brings along: a class with virtual functions on plain spans. The elements of
/// this project are batches without virtual calls (model.hpp); this is the short way for what is new and few.
namespace talus::fem {

/// One element between the nodes of a line (2) or a triangle (3). Constant: answers for positions and keeps nothing.
class UserElement {
 public:
  virtual ~UserElement() = default;

  /// What it stores (J). @param positions m; current, 3 a node. Zero in the reference state, by custom
  virtual double energy(std::span<const double> positions) const = 0;
  /// The derivative of the energy by the positions (N, 3 a node): the forces its nodes must be held with. Must be zero
  /// in sum, and turn with the positions: else momentum is not kept.
  virtual void force(std::span<const double> positions, std::span<double> force) const = 0;
  /// The derivative of the force (N/m), rows one behind the other. Where a class does not say it, central differences
  /// of the force stand in: enough for implicit and static runs, to half the digits.
  virtual void stiffness(std::span<const double> positions, std::span<double> stiffness) const;
  /// kg; of each of its nodes
  virtual void masses(std::span<double> masses) const = 0;
};

/// Makes an element from its reference positions (m, 3 a node) and the numbers that the scene gives.
using MakeUserElement = std::function<std::shared_ptr<const UserElement>(
    std::span<const double> reference, const std::vector<double>& parameters)>;

/// From here on scenes of this program know the element: `user_element: {name: ..., parameters: [...]}`.
void add_user_element(const std::string& name, MakeUserElement make);
/// @throws core::ConfigError where the program has none of this name; lists those it has
const MakeUserElement& user_element(const std::string& name);

}  // namespace talus::fem
