#!/usr/bin/env python3
"""A second structural solver for nets of cables, in NumPy and SciPy: a cross-check of fem_solver and an example of swapping one
solver for another. A scene names it with `structure: {solver: path/to/cable_net_solver.py}`; docs/participants.md."""
import argparse

import talus_participant as talus
from cable_net.scene import read_model
from cable_net.service import serve

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("scene", help="the YAML file of the run")
parser.add_argument("--join", required=True, metavar="SEGMENT", help="the run's shared memory, as the coupler names it")
arguments = parser.parse_args()

with talus.Participant(arguments.join, talus.Role.structure) as participant:
    serve(participant, read_model(arguments.scene))
