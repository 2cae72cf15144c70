"""Explicit central differences as a leapfrog: positions at whole steps, velocities half a step before."""
from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from cable_net.cables import CableNet


@dataclass
class State:
    """All that changes while time goes on, and what the ledger needs of the step before. Shapes (nodes, 3)."""

    displacement: np.ndarray  #: m, at t_n
    velocity: np.ndarray  #: m/s, at t_n - step/2
    old_displacement: np.ndarray  #: m, at t_(n-1), where forces were evaluated last
    old_velocity: np.ndarray  #: m/s, at t_(n-1) - step/2
    damped: float = 0.0  #: J, taken by damping up to t_(n-1)
    damped_since: float = 0.0  #: J, from then to t_n - step/2
    supplied: float = 0.0  #: J, work of the outer forces up to t_(n-1)
    supplied_since: float = 0.0  #: J, from then to t_n - step/2
    steps: int = 0

    def copy(self) -> State:
        """A state of its own. Steps replace the arrays and never write into them, so the copy may share them."""
        return replace(self)


def at_rest(nodes: int) -> State:
    """The reference state at time 0."""
    return State(*(np.zeros((nodes, 3)) for _ in range(4)))


@dataclass
class Motion:
    """What moves the nodes: M a = f_ext + M g + f_cables - alpha M v, with supported components held at zero."""

    net: CableNet
    supported: np.ndarray  #: (nodes, 3), true where a component is held
    mass_damping: float  #: alpha, 1/s
    gravity: np.ndarray = field(default_factory=lambda: np.zeros(3))  #: m/s^2

    def step(self, state: State, force: np.ndarray, step: float) -> None:
        """Advances `state` by `step` (s) under `force` (N, shape (nodes, 3)).

            v+ = ((1 - alpha h/2) v- + h a)/(1 + alpha h/2),   u+ = u + h v+
            first step, from rest at time 0, where (v- + v+)/2 = 0:   v+ = h a/2

        h is the step, v- and v+ the velocities half a step before and after, a the acceleration by all forces but damping,
        which is centred: alpha (v- + v+)/2. [Belytschko, Liu, Moran: Nonlinear Finite Elements, box 6.1; physics as in
        docs/structure.md] Stable for h below CableNet.largest_stable_step.
        """
        masses = self.net.node_masses[:, None]
        acceleration = (self.net.forces(state.displacement) + force) / masses + self.gravity
        acceleration[self.supported] = 0
        before = state.velocity
        state.velocity = self._new_velocity(state, acceleration, step)
        state.old_velocity = before if state.steps > 0 else -state.velocity
        state.old_displacement = state.displacement
        state.displacement = state.displacement + step * state.velocity
        self._account(state, force, step)
        state.steps += 1

    def kinetic_energy(self, state: State) -> float:
        """At t_(n-1), J: the product of the velocities half a step before and after, which an undamped linear leapfrog
        conserves together with the elastic energy there."""
        products = np.einsum("ij,ij->i", state.old_velocity, state.velocity)
        return float(self.net.node_masses @ products) / 2

    def _new_velocity(self, state: State, acceleration: np.ndarray, step: float) -> np.ndarray:
        if state.steps == 0:
            return step / 2 * acceleration
        half = self.mass_damping * step / 2
        return ((1 - half) * state.velocity + step * acceleration) / (1 + half)

    def _account(self, state: State, force: np.ndarray, step: float) -> None:
        """The force at t_n acts over half a step before, with the velocity there, and over half a step after."""
        middle = (state.old_velocity + state.velocity) / 2
        drag = self.mass_damping * self.net.node_masses[:, None] * middle
        outer = force + self.net.node_masses[:, None] * self.gravity
        before, after = step / 2 * state.old_velocity, step / 2 * state.velocity
        state.damped += state.damped_since + float(np.sum(drag * before))
        state.supplied += state.supplied_since + float(np.sum(outer * before))
        state.damped_since, state.supplied_since = float(np.sum(drag * after)), float(np.sum(outer * after))
