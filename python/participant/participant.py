"""The coupling contract as a solver sees it: the coupler commands, the solver answers."""
from __future__ import annotations

import pathlib
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import BinaryIO, Iterator

import numpy as np

from talus_participant import _native
from talus_participant._native import Action, Command, Role
from talus_participant.description import Declaration, Part, Surface


@dataclass(frozen=True)
class StructureFields:
    """Interface values at the nodes of the published surface, each of shape (nodes, 3): views of the shared memory.

    Displacement and velocity hold the present state at every answer: after `advance`, but also after `restore_state`,
    `read_checkpoint` and a `report` before the first window.
    """

    force: np.ndarray  #: N, read only; mean over the window
    displacement: np.ndarray  #: m, at the window's end
    velocity: np.ndarray  #: m/s, at the window's end (explicit leapfrog: half a step before)
    free_velocity: np.ndarray  #: m/s, a step after `velocity` if no interface force acted; empty: not needed
    lost: np.ndarray  #: (cells,), 1 for each broken cell, segments before triangles; empty: not declared


@dataclass(frozen=True)
class ParticleFields:
    """Interface values at the nodes of the received boundary, each of shape (nodes, 3): views of the shared memory.

    Arrays that nobody needs are empty: the two `end` arrays where both sides take one step a window.
    """

    start_displacement: np.ndarray  #: m, read only
    start_velocity: np.ndarray  #: m/s, read only
    end_displacement: np.ndarray  #: m, read only
    end_velocity: np.ndarray  #: m/s, read only
    force: np.ndarray  #: N, that the boundary receives, mean over the window
    free_velocity: np.ndarray  #: m/s, read only; the boundary's a step after the start if nothing touched it
    moved_displacement: np.ndarray  #: m; at the end, if each node besides answers to its contact forces with its mass
    moved_velocity: np.ndarray  #: m/s; likewise
    lost: np.ndarray  #: (cells,), read only; 1 for each cell that is gone, segments before triangles


def write_checkpoint(command: Command, write: Callable[[BinaryIO], None]) -> None:
    """Answers `write_checkpoint` by `write`, which gets the open file. Where the system refuses, this says so on the standard error
    stream and leaves no file: the coupler then goes on without this checkpoint."""
    try:
        with open(command.path, "wb") as file:
            write(file)
    except OSError as error:
        print(f"warning: '{command.path}' cannot be written: {error.strerror or error}", file=sys.stderr)
        pathlib.Path(command.path).unlink(missing_ok=True)


def checkpoint_state(command: Command, *arrays: np.ndarray) -> None:
    """Answers `write_checkpoint` and `read_checkpoint` for a state that is these arrays: reading fills them in place.

    Does nothing for other commands.
    """
    if command.action == Action.write_checkpoint:
        write_checkpoint(command, lambda file: np.savez(file, *arrays))
    elif command.action == Action.read_checkpoint:
        with np.load(command.path) as stored:
            for array, name in zip(arrays, stored.files, strict=True):
                array[...] = stored[name]


class Participant:
    """One side of a coupled run. As a context manager it tells the coupler of any exception that ends the block.

    Before time 0, in this order: `publish_surface` (structure) or `receive_surface` (particles), `declare`. Calls out of
    order raise UsageError; a coupler that is gone or silent raises TransportError.
    """

    def __init__(self, segment: str, role: Role = Role.structure, timeout: float = 60.0):
        """Joins the run behind `segment` (the text after --join); `timeout`: s without a sign of the coupler."""
        self._native = _native.Participant(segment, role, timeout)
        self._declaration = Declaration(program="")

    def __enter__(self) -> Participant:
        return self

    def __exit__(self, kind, error, trace) -> bool:
        if error is not None:
            self.fail(error)
        return False

    def publish_surface(self, surface: Surface, node_masses: np.ndarray) -> None:
        """Structure: what it moves, and the mass behind each node (shape (nodes,), kg)."""
        self._native.publish_surface(surface, node_masses)

    def receive_surface(self) -> tuple[Surface, np.ndarray]:
        """Particles: the boundary at the reference state and the mass that moves behind each node (kg).

        Blocks until the structure has published.
        """
        arrays, parts, node_masses = self._native.receive_surface()
        return Surface(**arrays, parts=[Part(**part) for part in parts]), node_masses

    def declare(self, declaration: Declaration) -> None:
        """Step, limits, effects and outputs; what is declared here is what `report` fills."""
        self._native.declare(declaration)
        self._declaration = declaration

    def next(self) -> Command:
        """The next command; blocks, sleeping."""
        return self._native.next()

    def answer(self) -> None:
        """Ends the command that next() returned; the coupler reads the fields from here on."""
        self._native.answer()

    def commands(self) -> Iterator[Command]:
        """Every command until the run is over; each is answered when the loop comes back for the next."""
        while (command := self.next()).action != Action.finish:
            yield command
            self.answer()

    def fail(self, error: BaseException) -> None:
        """Says why this participant cannot go on; the coupler stops the run and shows the message."""
        self._native.fail(error)

    def structure_fields(self) -> StructureFields:
        """Valid from the first command on, for the participant's life; never copied."""
        return StructureFields(**self._native.structure_fields())

    def particle_fields(self) -> ParticleFields:
        """Valid from the first command on, for the participant's life; never copied."""
        return ParticleFields(**self._native.particle_fields())

    def probes(self) -> np.ndarray:
        """Where `report` puts one value a declared probe."""
        return self._native.probes()

    def ledger(self) -> np.ndarray:
        """Where `report` puts one value a declared ledger line (J)."""
        return self._native.ledger()

    def positions(self, group: int) -> np.ndarray:
        """Where `report` puts the current positions of a group, shape (nodes, 3), m, where command.fields is set."""
        return self._native.positions(group)

    def field(self, group: int, field: int) -> np.ndarray:
        """Where `report` puts a field of a group, shape (nodes or cells, components), where command.fields is set."""
        components = self._declaration.groups[group].fields[field].components
        return self._native.field(group, field, components)

    def table(self, table: int) -> np.ndarray:
        """Where `report` puts the rows of a table, shape (capacity, columns)."""
        return self._native.table(table, len(self._declaration.tables[table].columns))

    def set_table_rows(self, table: int, rows: int) -> None:
        """How many rows a table has."""
        self._native.set_table_rows(table, rows)

    def tell_force_evaluations(self, since_start: int) -> None:
        """Optional, between a command and its answer: how often all forces were evaluated, for the summary."""
        self._native.tell_force_evaluations(since_start)

    def book_work(self, of_this_window: float) -> None:
        """Optional, between `advance` and its answer: the work (J) of the window's forces on this side's surface. Of a side that does
        not tell it is summed from forces and displacements."""
        self._native.book_work(of_this_window)
