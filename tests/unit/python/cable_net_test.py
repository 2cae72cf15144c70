"""The NumPy cable net against its own derivatives, closed forms of the leapfrog, and its limit of stability."""
import unittest

import numpy as np

from cable_net.cables import CableNet, CableProperties
from cable_net.motion import Motion, at_rest
from cable_net.net import SquareNet, square_net

PROPERTIES = CableProperties(area=2e-5, density=7850.0, youngs_modulus=3e9, prestress=2e8)
DIFFERENCE = 1e-6  # m; balances truncation (its square) and round-off (its inverse) of a central difference


def small_net():
    return square_net(SquareNet(np.array([1.0, 2.0, 0.0]), (4, 3), 0.5, np.eye(3)[0], np.eye(3)[1]))


def random_motion(shape, seed, scale):
    return scale * np.random.default_rng(seed).standard_normal(shape)


class Cables(unittest.TestCase):
    def setUp(self):
        self.net = CableNet(small_net(), PROPERTIES)
        self.shape = self.net.reference.shape

    def difference(self, function, direction, at):
        return (function(at + DIFFERENCE * direction) - function(at - DIFFERENCE * direction)) / (2 * DIFFERENCE)

    def test_forces_are_minus_the_derivative_of_the_energy_in_states_with_taut_and_slack_cables(self):
        for seed in range(20):
            state, direction = random_motion(self.shape, seed, 0.1), random_motion(self.shape, seed + 100, 1)
            axial = self.net.axial_forces(state)
            self.assertTrue((axial > 0).any() and (axial == 0).any())
            expected = -self.difference(self.net.energy, direction, state)
            self.assertAlmostEqual(np.sum(self.net.forces(state) * direction) / expected, 1, delta=1e-5)

    def test_stiffness_is_minus_the_derivative_of_the_forces(self):
        state, direction = random_motion(self.shape, 1, 0.05), random_motion(self.shape, 2, 1)
        expected = -self.difference(self.net.forces, direction, state)
        error = np.abs(self.net.stiffness_times(state, direction) - expected).max()
        self.assertLess(error, 1e-6 * np.abs(expected).max())

    def test_cable_forces_move_no_net_as_a_whole_and_turn_with_it(self):
        state = random_motion(self.shape, 3, 0.1)
        forces = self.net.forces(state)
        scale = np.abs(forces).max()
        self.assertLess(np.abs(forces.sum(axis=0)).max(), 1e-12 * scale)
        turn, _ = np.linalg.qr(np.random.default_rng(4).standard_normal((3, 3)))
        turned = (self.net.reference + state) @ turn - self.net.reference
        self.assertLess(np.abs(self.net.forces(turned) - forces @ turn).max(), 1e-10 * scale)

    def test_one_stretched_cable_pulls_with_area_times_stress_times_stretch(self):
        wire = square_net(SquareNet(np.zeros(3), (1, 1), 2.0, np.eye(3)[0], np.eye(3)[1]))
        net = CableNet(wire, PROPERTIES)
        stretched = wire.positions * np.array([0.25, 0, 0])  # u_x = x/4: the two wires along x are 1.25 times as long
        strain = (1.25**2 - 1) / 2
        expected = 2e-5 * (3e9 * strain + 2e8) * 1.25
        np.testing.assert_allclose(np.sort(net.axial_forces(stretched))[2:], expected, rtol=1e-12)

    def test_node_masses_add_up_to_the_mass_of_all_wire(self):
        wire_length = (5 * 3 + 4 * 4) * 0.5
        self.assertAlmostEqual(self.net.node_masses.sum(), 7850 * 2e-5 * wire_length, places=12)


class Time(unittest.TestCase):
    def setUp(self):
        mesh = small_net()
        self.supported = np.zeros(mesh.positions.shape, dtype=bool)
        self.supported[mesh.rim] = True
        self.net = CableNet(mesh, PROPERTIES)
        self.free = np.flatnonzero(~self.supported.any(axis=1))

    def growth(self, fraction, steps):
        """How far a tiny kick has gone after many steps at a fraction of the stable step."""
        motion, state = Motion(self.net, self.supported, mass_damping=0), at_rest(len(self.net.reference))
        state.steps = 1
        state.velocity[self.free] = random_motion((len(self.free), 3), 5, 1e-9)
        length = fraction * self.net.largest_stable_step(self.free)
        for _ in range(steps):
            motion.step(state, np.zeros_like(state.velocity), length)
        return np.abs(state.displacement).max() / (1e-9 * length)

    def test_the_declared_limit_separates_bounded_from_growing_motion(self):
        self.assertLess(self.growth(0.99, steps=400), 100)
        # theory: grows by exp(2 arcosh(1.01)) = 1.33 a step
        self.assertGreater(self.growth(1.01, steps=60), 1e4)

    def test_a_damped_free_fall_follows_the_closed_form_of_the_leapfrog(self):
        damping, length, gravity = 3.0, 1e-4, np.array([0, 0, -9.81])
        free = Motion(self.net, np.zeros_like(self.supported), damping, gravity)
        slack = CableNet(small_net(), CableProperties(2e-5, 7850.0, 3e9, prestress=0))
        free.net = slack  # at equal displacements its cables are unstressed
        state = at_rest(len(slack.reference))
        for _ in range(1000):
            free.step(state, np.zeros_like(state.velocity), length)
        # v_1 = h g/2, then v_(n+1) - v_end = r (v_n - v_end) with r = (1 - a h/2)/(1 + a h/2), v_end = g/a
        ratio, end = (1 - damping * length / 2) / (1 + damping * length / 2), gravity / damping
        expected = end + ratio**999 * (length / 2 * gravity - end)
        np.testing.assert_allclose(state.velocity, np.broadcast_to(expected, state.velocity.shape), rtol=1e-11, atol=1e-15)

    def test_energies_stay_in_balance_with_what_damping_takes_and_forces_supply(self):
        push = np.zeros(self.net.reference.shape)
        push[self.free] = [0, 0, -500]
        for damping, force in ((0.0, 0 * push), (20.0, 0 * push), (20.0, push)):
            motion, state = Motion(self.net, self.supported, damping), at_rest(len(self.net.reference))
            state.steps = 1
            state.velocity[self.free] = random_motion((len(self.free), 3), 6, 1.0)
            initial = float(self.net.node_masses @ (state.velocity**2).sum(axis=1)) / 2
            balances = []
            for _ in range(500):
                motion.step(state, force, 0.1 * self.net.largest_stable_step(self.free))
                balances.append(motion.kinetic_energy(state) + self.net.energy(state.old_displacement)
                                + state.damped - state.supplied)
            # The leapfrog keeps this sum up to terms of the square of step x frequency, here 0.2^2/12 at the most.
            self.assertLess(np.ptp(balances), 0.004 * initial)


class Nets(unittest.TestCase):
    def test_a_net_of_columns_and_rows_has_that_many_nodes_wires_and_rim_nodes(self):
        net = small_net()
        self.assertEqual((len(net.positions), len(net.wires), len(net.rim)), (5 * 4, 4 * 4 + 5 * 3, 2 * (4 + 3)))
        lengths = np.linalg.norm(net.positions[net.wires[:, 1]] - net.positions[net.wires[:, 0]], axis=1)
        np.testing.assert_allclose(lengths, 0.5, rtol=1e-15)
        self.assertTrue(np.isin(net.positions[net.rim][:, 0], (1, 3)).any())
        inner = np.setdiff1d(np.arange(20), net.rim)
        self.assertTrue(((net.positions[inner] > (1, 2, -1)) & (net.positions[inner] < (3, 3.5, 1))).all())


if __name__ == "__main__":
    unittest.main()
