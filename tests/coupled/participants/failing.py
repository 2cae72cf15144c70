"""A structure of one node that goes wrong in window 2, in the way its first argument names."""
import os
import signal
import sys
import time

import numpy as np
import talus_participant as talus


def go_wrong(how):
    if how == "numerical":
        raise talus.NumericalError("velocity is not finite", entity="node 0", step=2, time=0.002, value=float("inf"))
    if how == "machine":
        raise talus.MachineError("no room for the matrix")
    if how == "exception":
        raise ZeroDivisionError("a bug of the solver")
    if how == "leave":
        sys.exit(3)
    if how == "exit":
        os._exit(7)
    if how == "hang":
        time.sleep(600)
    os.kill(os.getpid(), signal.SIGKILL)


how = sys.argv[1]
with talus.Participant(sys.argv[-1]) as participant:
    if how == "config":
        raise talus.ConfigError(talus.Complaint("scene.yaml: structure.solver: has no net"),
                                talus.Complaint("is missing", "scene.yaml", 7, 3, "structure.area"))
    if how == "config text":
        raise talus.ConfigError("scene.yaml: structure.solver: has no net")
    participant.publish_surface(talus.Surface(np.zeros((1, 3))), np.ones(1))
    participant.declare(talus.Declaration("failing.py"))
    for command in participant.commands():
        if command.window == 2:
            go_wrong(how)
