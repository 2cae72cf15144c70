"""The mass on a spring of two_masses.hpp in Python, misbehaving as its scene says, like dummy_solver.cpp."""
import os
import signal
import sys
import time

import numpy as np
import talus_participant as talus

MASS, STIFFNESS = 2.0, 300.0  # kg, N/m


def misbehave(how: str) -> None:
    if how == "exit":
        os._exit(7)
    if how == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    if how == "asleep":
        time.sleep(3600)
    if how == "throws":
        raise RuntimeError("the matrix is singular")
    if how == "numerical":
        raise talus.NumericalError("displacement is not finite", entity="node 0", step=20, time=0.02, value=1e300)


behaviour = talus.read_scene(sys.argv[1]).section("structure")
how, at = behaviour.text("behaviour"), behaviour.number("at", "")
state = saved = (0.0, 0.0)
with talus.Participant(sys.argv[-1]) as participant:
    participant.publish_surface(talus.Surface(np.zeros((1, 3))), np.full(1, MASS))
    participant.declare(talus.Declaration("dummy_structure.py"))
    for command in participant.commands():
        fields = participant.structure_fields()
        if command.action == talus.Action.advance:
            if command.window == at:
                misbehave(how)
            position, velocity = state
            velocity += command.length * (fields.force[0, 2] - STIFFNESS * position) / MASS
            state = (position + command.length * velocity, velocity)
            time.sleep(1e-3)
        elif command.action == talus.Action.save_state:
            saved = state
        elif command.action == talus.Action.restore_state:
            state = saved
        fields.displacement[0, 2], fields.velocity[0, 2] = state
