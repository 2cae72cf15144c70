"""What a participant says of itself before time 0. Plain data; SI units."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Sequence

import numpy as np

from talus._native import FieldLocation, LedgerKind


def _no_cells(nodes_per_cell: int) -> np.ndarray:
    return np.empty((0, nodes_per_cell), dtype=np.int32)


@dataclass
class Surface:
    """Nodes at the reference state and what spans between them: segments for wires and ropes, triangles for sheets."""

    positions: np.ndarray  #: (nodes, 3), m
    segments: np.ndarray = field(default_factory=lambda: _no_cells(2))  #: (n, 2) node indices
    triangles: np.ndarray = field(default_factory=lambda: _no_cells(3))  #: (n, 3), counter-clockwise from outside
    name: str = "surface"


@dataclass
class StepLimit:
    """A limit of the solver's step, as `talus check` lists it."""

    name: str  #: "cables"
    seconds: float  #: the largest step that keeps it
    reason: str  #: the formula and what sets it
    stability: bool = True  #: False: exceeding it costs accuracy only, a warning


@dataclass
class Effect:
    """An effect of the program, as `talus explain` lists it."""

    name: str
    present: bool
    reason: str
    key: str = ""  #: of the scene, which names it
    ledger_line: str = ""  #: whose energy appears where it acts
    may_hold: bool = False  #: it may act without doing work, as friction that holds a block
    limit: str = ""  #: what is exceeded where it is missing: the name of a step limit, or "compression of <group>"


@dataclass
class LedgerLine:
    """A column of energy.csv (J), named "side.line_J"."""

    name: str
    kind: LedgerKind = LedgerKind.stored


@dataclass
class Field:
    """Values on the nodes or cells of a group, written with every frame."""

    name: str
    unit: str
    components: int = 1
    location: FieldLocation = FieldLocation.node


@dataclass
class Group:
    """Cells of one kind that are drawn together; the number of columns of `cells` says which kind."""

    name: str
    nodes: int
    cells: np.ndarray  #: (n, 1) points, (n, 2) segments or (n, 3) triangles; node indices
    fields: Sequence[Field] = ()


@dataclass
class Declaration:
    """Program, step, limits, effects and outputs of a participant."""

    program: str
    step: float = 0.0  #: s; its own step inside a window; 0: one step a window, whatever its length
    limits: Sequence[StepLimit] = ()
    effects: Sequence[Effect] = ()
    probes: Sequence[str] = ()  #: columns of probes.csv, such as "net_centre.displacement_z_m"
    ledger: Sequence[LedgerLine] = ()
    groups: Sequence[Group] = ()
    checkpoints: bool = False  #: it answers write_checkpoint and read_checkpoint
    #: structure; True: the force is a load over the window (implicit methods); False: it kicks at the start of each step (leapfrog)
    force_is_load: bool = False
