#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/errors.hpp"
#include "coupler/session/session.hpp"
#include "interface_mesh/mapping.hpp"

/// Before the first window: participants say what they are, the interface is made, arrays are laid out.
namespace talus::coupler {

/// Makes Ω_D from Ω_S and ties the two.
struct InterfacePlan {
  std::function<mesh::Surface(const mesh::Surface& structure)> make_boundary;
  std::function<mesh::TiedSurfaces(const mesh::Surface& boundary, const mesh::Surface& structure)> tie;
};
/// Ω_D is Ω_S itself.
InterfacePlan identical_surfaces();

/// The interface as it was agreed on.
struct Interface {
  mesh::Surface structure;               ///< Ω_S
  mesh::Surface boundary;                ///< Ω_D
  std::vector<double> structure_masses;  ///< kg
  std::vector<double> boundary_masses;   ///< kg; what moves behind each node of Ω_D
  mesh::TiedSurfaces tie;
};

/// Hears every participant's surface and declaration and answers with the boundary. A plan that is absent
/// means a run without an interface: a side then has a surface of no nodes.
/// @param complaints of the caller about the same scene; thrown together with those of the participants,
/// sorted by place
/// @throws core::ConfigError with the complaints of all programs, TransportError, Interrupted
std::optional<Interface> introduce(Session& session, const std::optional<InterfacePlan>& plan,
                                   std::vector<core::Complaint> complaints = {});

/// Whether the particles ask for the boundary's free velocity.
/// @throws core::ConfigError where the structure cannot say it, or a side takes several steps a window (s)
bool needs_free_velocity(Session& session, double window_length);

/// How a scheme lets the two sides run over a window, which decides what arrays they need.
enum class Order {
  in_turn,   ///< one after the other: where Ω_D is Ω_S, both use the same arrays and nothing is copied
  together,  ///< at the same time: each has its own
  iterated,  ///< again and again: the particles also get the boundary at the window's end
  iterated_light,  ///< likewise, and say where its light nodes went under the contact forces
};

/// s
struct WindowLengths {
  double regular = 0;
  double longest = regular;  ///< in free flight
};

/// Sizes every array of every participant and makes the data block. Particles that take several steps in the
/// longest window get the boundary at a window's end, in arrays of their own, whatever the order.
void lay_out_arrays(Session& session, const std::optional<Interface>& interface, const WindowLengths& windows,
                    Order order = Order::together);

}  // namespace talus::coupler
