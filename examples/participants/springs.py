#!/usr/bin/env python3
"""A first structural solver: 25 free masses in a square, each on a spring to where it was at time 0.

The coupler starts it as `springs.py scene.yaml --join SEGMENT`; between the masses it spans triangles for rocks to land on."""
import sys

import numpy as np
import talus_participant as talus

MASS, STIFFNESS = 10.0, 2e4  # kg, N/m
SIDE = 5  # masses along an edge, 0.5 m apart

nodes = np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
row, column = np.divmod(nodes.ravel(), SIDE)
positions = 0.5 * np.column_stack([column, row, np.zeros_like(row)])
a, b, c, d = (corner.ravel() for corner in (nodes[:-1, :-1], nodes[:-1, 1:], nodes[1:, 1:], nodes[1:, :-1]))
triangles = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])

displacement, velocity = np.zeros_like(positions), np.zeros_like(positions)
saved = (displacement, velocity)


def step(force: np.ndarray, length: float) -> None:
    """One step of the leapfrog: forces at its start, velocity from half a step before to half a step after."""
    global displacement, velocity
    velocity = velocity + length * (force - STIFFNESS * displacement) / MASS
    displacement = displacement + length * velocity


with talus.Participant(segment=sys.argv[-1]) as participant:
    participant.publish_surface(talus.Surface(positions, triangles=triangles), np.full(len(positions), MASS))
    limit = talus.StepLimit("springs", 2 * np.sqrt(MASS / STIFFNESS), "2 sqrt(m/k)")
    participant.declare(talus.Declaration("springs.py", limits=[limit], probes=["middle.displacement_z_m"],
                                          checkpoints=True))
    for command in participant.commands():
        fields = participant.structure_fields()
        if command.action == talus.Action.advance:
            step(fields.force, command.length)
        elif command.action == talus.Action.save_state:
            saved = (displacement, velocity)
        elif command.action == talus.Action.restore_state:
            displacement, velocity = saved
        elif command.action == talus.Action.report:
            participant.probes()[0] = displacement[len(positions) // 2, 2]
        talus.checkpoint_state(command, displacement, velocity)
        fields.displacement[:], fields.velocity[:] = displacement, velocity
