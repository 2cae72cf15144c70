"""Two-node cables of a whole net at once: total Lagrangian, Green-Lagrange strain, second Piola-Kirchhoff stress.

Differences along all cables are one product with the sparse incidence matrix B, sums at the nodes one with its transpose.
"""
from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import LinearOperator, eigsh

from cable_net.net import Net


@dataclass(frozen=True)
class CableProperties:
    """What all cables of a net share."""

    area: float  #: m^2, of the unstretched cable
    density: float  #: kg/m^3
    youngs_modulus: float  #: Pa
    prestress: float  #: Pa, second Piola-Kirchhoff


class CableNet:
    """Forces, energy and stiffness of a net of cables that carry no compression.

    With r = x_far - x_near, l = |r|, L its unstretched length, t = r/l (cable: second Piola-Kirchhoff stress S times l/L
    is the first one, which acts on the unstretched area):

        e = (l^2 - L^2)/(2 L^2)      S = E e + S_pre      N = A max(S, 0) l/L
        force on the far node -N t, on the near node N t
        U = A L (max(S, 0)^2 - S_pre^2)/(2 E)             so that dU/dl = N and U = 0 at the reference state

    | symbol | variable        | meaning                               | unit | shape      | sign                  |
    |--------|-----------------|---------------------------------------|------|------------|-----------------------|
    | r      | spans           | from the near to the far node         | m    | (wires, 3) |                       |
    | L      | rest_lengths    | length of the reference state         | m    | (wires,)   | > 0                   |
    | S      | stress          | second Piola-Kirchhoff stress         | Pa   | (wires,)   | tension > 0, never < 0|
    | N/l    | tension_density | cable force over length               | N/m  | (wires,)   | >= 0                  |

    Valid for any stretch of a linear law S(e). Tests: tests/unit/python/cable_net_test.py.
    """

    def __init__(self, net: Net, properties: CableProperties):
        count = len(net.wires)
        rows = np.repeat(np.arange(count), 2)
        signs = np.tile([-1.0, 1.0], count)
        shape = (count, len(net.positions))
        self.incidence = sparse.csr_matrix((signs, (rows, net.wires.ravel())), shape=shape)
        self._to_nodes = self.incidence.T.tocsr()
        self.properties = properties
        self.reference = net.positions
        self.rest_lengths = np.linalg.norm(self.incidence @ net.positions, axis=1)

    @cached_property
    def node_masses(self) -> np.ndarray:
        """Half of each cable's mass at each of its ends: shape (nodes,), kg."""
        masses = self.properties.density * self.properties.area * self.rest_lengths
        return abs(self._to_nodes) @ masses / 2

    def forces(self, displacement: np.ndarray) -> np.ndarray:
        """What the cables do to the nodes: shape (nodes, 3), N. `displacement` in m, same shape."""
        spans = self.incidence @ (self.reference + displacement)
        return -(self._to_nodes @ (self._tension_density(self._stress(spans))[:, None] * spans))

    def energy(self, displacement: np.ndarray) -> float:
        """Elastic energy and work of the prestress, J; 0 at the reference state."""
        cable = self.properties
        stress = self._stress(self.incidence @ (self.reference + displacement))
        density = (stress**2 - cable.prestress**2) / (2 * cable.youngs_modulus)
        return float(cable.area * self.rest_lengths @ density)

    def axial_forces(self, displacement: np.ndarray) -> np.ndarray:
        """N of each cable: shape (wires,), N, tension positive."""
        spans = self.incidence @ (self.reference + displacement)
        return self._tension_density(self._stress(spans)) * np.linalg.norm(spans, axis=1)

    def stiffness_times(self, displacement: np.ndarray, motion: np.ndarray) -> np.ndarray:
        """Minus the change of `forces` for a small `motion` (m) of the nodes: shape (nodes, 3), N.

        Per cable K = (A/L^3) E r r^T + (N/l) I, zero where the cable is slack. (With t = r/l the same as the usual
        (EA/L)(1 + 3 e + S_pre/E) t t^T + (N/l)(I - t t^T).) Plain text: stretching raises the stress, turning turns N.
        """
        cable = self.properties
        spans, relative = self.incidence @ (self.reference + displacement), self.incidence @ motion
        stress = self._stress(spans)
        stretching = cable.youngs_modulus * cable.area / self.rest_lengths**3 * np.einsum("ij,ij->i", spans, relative)
        per_cable = np.where(stress > 0, stretching, 0)[:, None] * spans
        return self._to_nodes @ (per_cable + self._tension_density(stress)[:, None] * relative)

    def largest_stable_step(self, free: np.ndarray) -> float:
        """2/w of the reference state (s), w the highest angular frequency with only the nodes `free` moving.

        Central differences of M a + K u = 0 are stable up to it; centred mass damping does not change it.
        """
        scale = 1 / np.sqrt(self.node_masses[free])[:, None]
        at_rest = np.zeros_like(self.reference)

        def scaled_stiffness(vector: np.ndarray) -> np.ndarray:
            motion = np.zeros_like(self.reference)
            motion[free] = scale * vector.reshape(-1, 3)
            return (scale * self.stiffness_times(at_rest, motion)[free]).ravel()

        size = 3 * len(free)
        operator = LinearOperator((size, size), matvec=scaled_stiffness, dtype=float)
        start = np.random.default_rng(1).standard_normal(size)
        return 2 / float(np.sqrt(eigsh(operator, k=1, which="LA", v0=start, return_eigenvectors=False)[0]))

    def _stress(self, spans: np.ndarray) -> np.ndarray:
        strain = (np.einsum("ij,ij->i", spans, spans) / self.rest_lengths**2 - 1) / 2
        return np.maximum(self.properties.youngs_modulus * strain + self.properties.prestress, 0)

    def _tension_density(self, stress: np.ndarray) -> np.ndarray:
        return self.properties.area * stress / self.rest_lengths
