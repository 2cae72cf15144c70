#pragma once

#include <array>
#include <concepts>

#include "dem_solver/contact/friction.hpp"
#include "dem_solver/contact/hysteretic.hpp"
#include "dem_solver/contact/normal.hpp"
#include "dem_solver/contact/rolling.hpp"
#include "dem_solver/contact/work.hpp"

namespace talus::dem {

/// What a contact does to its two partners: force and torque on the first; the partner gets the reversed
/// force, and of the torque the rolling part reversed.
template <class Real>
struct ContactLoad {
  Triple<Real> force;           ///< N
  Triple<Real> rolling_torque;  ///< N m; zero and unused without rolling resistance
  Real stiffness{};             ///< N/m; of the normal force, for limits of the step
};

/// Energy a contact has taken out of the motion since the last evaluation, J.
template <class Real>
struct ContactLoss {
  Real damping{}, friction{};
};

/// A contact law composed of its terms. A term that is NoTerm has no code and no memory.
template <class NormalTerm, class FrictionTerm, class RollingTerm, class LedgerTerm>
struct ContactLaw {
  static_assert(NormalLaw<NormalTerm>);
  using Normal = NormalTerm;
  using Friction = FrictionTerm;
  static constexpr bool has_friction = !std::same_as<FrictionTerm, NoTerm>;
  static constexpr bool has_rolling = !std::same_as<RollingTerm, NoTerm>;
  static constexpr bool has_ledger = !std::same_as<LedgerTerm, NoTerm>;
  static constexpr bool has_dashpots = NormalTerm::memory_rows == 0;
  static constexpr bool spreads_over_area = NormalTerm::spreads_over_area;
  static_assert(has_friction || !has_rolling, "rolling resistance needs friction, which turns the spheres");

  static constexpr int rolling_row = FrictionTerm::memory_rows;
  static constexpr int normal_row = rolling_row + RollingTerm::memory_rows;
  static constexpr int ledger_row = normal_row + NormalTerm::memory_rows;
  /// Rows that a contact remembers from one step to the next; all zero before it begins.
  static constexpr int memory_rows = ledger_row + LedgerTerm::memory_rows;
  template <class Real>
  using Memory = std::array<Quad<Real>, memory_rows>;
  using StoredMemory = std::array<Row, memory_rows>;

  /// Forces of a contact, and its memory moved on by one step. A contact that has ended (overlap <= 0) gives
  /// zero and forgets.
  template <class Real>
  TALUS_INLINE static ContactLoad<Real> evaluate(const Touch<Real>& touch,
                                                 const ContactParameters<Real>& parameters, double step,
                                                 Memory<Real>& memory, ContactLoss<Real>& loss) noexcept {
    const Real lost_before = lost(touch, parameters, memory);
    const NormalForce<Real> normal =
        NormalTerm::template force<Real>(touch, parameters, normal_memory(memory));
    ContactLoad<Real> load{normal.total * touch.normal, {}, normal.stiffness};
    Triple<Real> tangential{};
    if constexpr (has_friction) {
      tangential = FrictionTerm::template force<Real>(touch, normal, parameters, step, memory[0]);
      load.force = load.force + tangential;
    }
    if constexpr (has_rolling) {
      Quad<Real>* rolling_memory = nullptr;
      if constexpr (RollingTerm::memory_rows > 0) rolling_memory = &memory[rolling_row];
      load.rolling_torque =
          RollingTerm::template torque<Real>(touch, normal, parameters, step, rolling_memory);
    }
    if constexpr (has_ledger) {
      loss = account(touch, parameters, normal, tangential, load.rolling_torque, step, memory);
      if constexpr (NormalTerm::memory_rows > 0)
        loss.damping =
            loss.damping + (touch.overlap > Real{} ? lost(touch, parameters, memory) - lost_before : Real{});
    }
    return load;
  }

  /// The memory seen from the partner: what acted on the first sphere acts on the other, reversed.
  static void reverse(StoredMemory& memory) noexcept {
    for (int k = 0; k < memory_rows; ++k) {
      if (has_ledger && k == ledger_row + 1) continue;  // energies have no direction
      memory[k] = row({-memory[k].x, -memory[k].y, -memory[k].z}, memory[k].w);
    }
  }

  /// N; of the normal dashpot at the last evaluation.
  static double dashpot_force(const StoredMemory& memory) noexcept requires has_ledger {
    return memory[ledger_row].w;
  }
  /// J; of the springs at the last evaluation.
  static double stored_energy(const StoredMemory& memory) noexcept requires has_ledger {
    return memory[ledger_row + 1].x + memory[ledger_row + 1].y;
  }

 private:
  /// nullptr: the law remembers nothing.
  template <class Real>
  TALUS_INLINE static Quad<Real>* normal_memory(Memory<Real>& memory) noexcept {
    if constexpr (NormalTerm::memory_rows > 0)
      return &memory[normal_row];
    else
      return nullptr;
  }
  /// J; by a normal law that remembers, since the contact began.
  template <class Real>
  TALUS_INLINE static Real lost(const Touch<Real>& touch, const ContactParameters<Real>& parameters,
                                Memory<Real>& memory) noexcept {
    if constexpr (has_ledger && NormalTerm::memory_rows > 0)
      return NormalTerm::template lost<Real>(touch, parameters, normal_memory(memory));
    else
      return Real{};
  }

  template <class Real>
  TALUS_INLINE static ContactLoss<Real> account(const Touch<Real>& touch,
                                                const ContactParameters<Real>& parameters,
                                                const NormalForce<Real>& normal,
                                                const Triple<Real>& tangential,
                                                const Triple<Real>& rolling_torque, double step,
                                                Memory<Real>& memory) noexcept {
    const double half = 0.5 * step;
    Quad<Real>& forces = memory[ledger_row];
    Quad<Real>& energies = memory[ledger_row + 1];
    const Real damping_force = normal.total - normal.elastic;
    ContactLoss<Real> loss;
    loss.damping = -half * (forces.w + damping_force) * dot(touch.travelled, touch.normal);
    Real held{};
    if constexpr (has_friction) {
      const Triple<Real> vt = touch.travelled - dot(touch.travelled, touch.normal) * touch.normal;
      const Real rolling_power = has_rolling ? dot(rolling_torque, touch.spin) : Real{};
      held = FrictionTerm::template energy<Real>(memory[0]);
      loss.friction =
          -half * (dot(triple(forces) + tangential, vt) + energies.z + rolling_power) - (held - energies.y);
      energies.z = rolling_power;
    }
    forces = quad(tangential, damping_force);
    energies.x = NormalTerm::template energy<Real>(touch, parameters, normal_memory(memory));
    energies.y = held;
    return loss;
  }
};

}  // namespace talus::dem
