#!/usr/bin/env python3
"""The scene configs/examples/cable_net.yaml once more, in one process and without any code of Talus.

A monolithic leapfrog of two spheres and a cable net in NumPy, written from the formulas: Hertz contact with the damping ratio of the
asked restitution, incremental tangential springs with Coulomb's limit, contact of a sphere with the axes of wires, total Lagrangian
cables with prestress. What the tests of the coupled program compare with comes from here:

    python3 python/reference/rock_on_net.py 10e-6        one JSON line: peak of the net's middle node, its time, where the rocks end

| step     | peak of net_centre z | at        | boulder z at 0.2 s | stone z at 0.2 s |
|----------|----------------------|-----------|--------------------|------------------|
| 50 us    | -0.155565 m          | 78.85 ms  |  0.66404 m         | -0.85642 m       |
| 20 us    | -0.124332 m          | 76.92 ms  |  0.50447 m         | -0.85722 m       |
| 10 us    | -0.121684 m          | 77.42 ms  |  0.45852 m         | -0.84823 m       |
| 5 us     | -0.121687 m          | 77.415 ms |  0.45795 m         | -0.84824 m       |
| 2.5 us   | -0.121689 m          | 77.415 ms |  0.45795 m         | -0.84823 m       |

Above 16 us the dashpot, sized by the rock, overshoots on nodes of 0.03 kg (dt > 2 m/c): the motion there is an artefact of the step."""
import json
import sys

import numpy as np

SIDE, PITCH = 21, 0.15  # nodes a side, m
AREA, DENSITY, MODULUS, PRESTRESS, MASS_DAMPING = 1.256637061e-5, 7850.0, 7e5, 1e9, 20.0
RADII = np.array([0.21036, 0.05])
MASSES = 2500 * 4 / 3 * np.pi * RADII**3
INERTIAS = 0.4 * MASSES * RADII**2
GRAVITY = np.array([0, -6.378103, -6.378103])
DAMPING_RATIO = 0.6675  # of restitution 0.2 with the force cut off at zero
SHEAR = 1e5 / (2 * 1.2)
WIRE = dict(modulus=1e5 / (1 - 0.2**2), shear=SHEAR / (2 - 0.2), friction=0.78868)  # the partner is rigid
ROCK = dict(modulus=1e5 / (1 - 0.2**2) / 2, shear=SHEAR / (2 * (2 - 0.2)), friction=1.0)


def net():
    """Reference positions (n, 3) m, segments (s, 2), masses (n) kg, fixed nodes."""
    grid = np.arange(SIDE)
    number = grid[:, None] * SIDE + grid[None, :]
    positions = np.array([[i * PITCH, j * PITCH, 0.0] for j in grid for i in grid])
    segments = np.concatenate([np.stack([number[:, :-1].ravel(), number[:, 1:].ravel()], 1),
                               np.stack([number[:-1].ravel(), number[1:].ravel()], 1)])
    masses = np.zeros(SIDE * SIDE)
    np.add.at(masses, segments.ravel(), DENSITY * AREA * PITCH / 2)
    rim = np.ones((SIDE, SIDE), bool)
    rim[1:-1, 1:-1] = False
    return positions, segments, masses, rim.ravel()


def cable_forces(positions, segments):
    """Nodal forces (n, 3) N: N = A (E e + S) l/L, e = (l^2 - L^2)/(2 L^2), no compression."""
    along = positions[segments[:, 1]] - positions[segments[:, 0]]
    length = np.linalg.norm(along, axis=1)
    strain = (length**2 - PITCH**2) / (2 * PITCH**2)
    axial = np.maximum(AREA * (MODULUS * strain + PRESTRESS) * length / PITCH, 0)
    pull = (axial / length)[:, None] * along
    forces = np.zeros_like(positions)
    np.add.at(forces, segments[:, 0], pull)
    np.add.at(forces, segments[:, 1], -pull)
    return forces


def contact_force(pair, radius, mass, overlap, normal, approach, memory, step):
    """Force (3) N on the first body and the new memory (spring force, overlap); `normal` points from the first body to the contact,
    `approach` is its velocity over the partner's at the contact."""
    stiffness = 2 * pair["modulus"] * np.sqrt(radius * overlap)
    tangential = 8 * pair["shear"] * np.sqrt(radius * overlap)
    speed = approach @ normal
    slip = approach - speed * normal
    pressure = max(0.0, 2 / 3 * stiffness * overlap + 2 * DAMPING_RATIO * np.sqrt(mass * stiffness) * speed)
    spring, last_overlap = memory
    size = np.linalg.norm(spring)
    spring = spring - (spring @ normal) * normal
    turned = np.linalg.norm(spring)
    if turned > 0:
        spring = spring * (size / turned)
    if overlap < last_overlap:
        spring = spring * np.sqrt(overlap / last_overlap)
    spring = spring - tangential * slip * step
    drag = spring - 2 * DAMPING_RATIO * np.sqrt(mass * tangential) * slip
    limit = pair["friction"] * pressure
    for_limit = lambda force: force * min(1.0, limit / max(np.linalg.norm(force), 1e-300))
    return for_limit(drag) - pressure * normal, (for_limit(spring), overlap)


def touched_wires(centre, radius, positions, segments):
    """(segment, weight of its second node, vector to the contact point, distance) of each contact, nearest first, one feature once."""
    start, along = positions[segments[:, 0]], positions[segments[:, 1]] - positions[segments[:, 0]]
    weight = np.clip(np.einsum("ij,ij->i", centre - start, along) / np.einsum("ij,ij->i", along, along), 0, 1)
    to_point = start + weight[:, None] * along - centre
    distance = np.linalg.norm(to_point, axis=1)
    accepted = []
    for s in np.argsort(distance, kind="stable"):
        if distance[s] >= radius:
            break
        if all(to_point[s] @ point < near**2 * (1 - 1e-9) for _, _, point, near in accepted):
            accepted.append((s, weight[s], to_point[s], distance[s]))
    return accepted


def run(step, end=0.2):
    """History (steps, 4): time, z of the middle node's displacement, z of boulder and stone (m)."""
    reference, segments, masses, rim = net()
    u, v = np.zeros_like(reference), np.zeros_like(reference)
    centre = np.array([[1.5, 1.9257095, 0.4168695], [1.575, 1.4214195, 0.4168695]])
    velocity = np.array([[0, -5.74029, -5.74029]] * 2)
    spin, memories, history = np.zeros((2, 3)), {}, []
    middle = (SIDE * SIDE) // 2
    for n in range(round(end / step)):
        positions = reference + u
        on_net, on_rock, torque = cable_forces(positions, segments), MASSES[:, None] * GRAVITY, np.zeros((2, 3))
        fresh = {}

        def contact(key, pair, radius, mass, overlap, normal, approach):
            force, fresh[key] = contact_force(pair, radius, mass, overlap, normal, approach,
                                              memories.get(key, (np.zeros(3), overlap)), step)
            return force

        for k in range(2):
            for s, weight, to_point, distance in touched_wires(centre[k], RADII[k], positions, segments):
                a, b = segments[s]
                approach = velocity[k] + np.cross(spin[k], to_point) - (1 - weight) * v[a] - weight * v[b]
                force = contact((k, s), WIRE, RADII[k], MASSES[k], RADII[k] - distance, to_point / distance, approach)
                on_rock[k] += force
                torque[k] += np.cross(to_point, force)
                on_net[a] -= (1 - weight) * force
                on_net[b] -= weight * force
        between = centre[1] - centre[0]
        overlap = RADII.sum() - np.linalg.norm(between)
        if overlap > 0:
            normal = between / np.linalg.norm(between)
            arms = np.outer(RADII - overlap / 2, normal) * np.array([[1], [-1]])
            approach = velocity[0] + np.cross(spin[0], arms[0]) - velocity[1] - np.cross(spin[1], arms[1])
            force = contact("rocks", ROCK, RADII.prod() / RADII.sum(), MASSES.prod() / MASSES.sum(), overlap, normal, approach)
            for k, sign in enumerate((1, -1)):
                on_rock[k] += sign * force
                torque[k] += np.cross(arms[k], sign * force)
        memories = fresh
        v = ((1 - MASS_DAMPING * step / 2) * v + step * on_net / masses[:, None]) / (1 + MASS_DAMPING * step / 2)
        v[rim] = 0
        u = u + step * v
        velocity = velocity + step * on_rock / MASSES[:, None]
        spin = spin + step * torque / INERTIAS[:, None]
        centre = centre + step * velocity
        history.append(((n + 1) * step, u[middle, 2], *centre[:, 2]))
    return np.array(history)


if __name__ == "__main__":
    result = run(float(sys.argv[1]) if len(sys.argv) > 1 else 10e-6)
    lowest = result[np.argmin(result[:, 1])]
    print(json.dumps(dict(peak_m=lowest[1], peak_at_s=lowest[0], boulder_z_m=result[-1, 2], stone_z_m=result[-1, 3])))
