"""What a participant says of itself before time 0. Plain data; SI units."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Mapping, Sequence

import numpy as np

from talus_participant._native import FieldLocation, LedgerKind, TableKind


def _no_cells(nodes_per_cell: int) -> np.ndarray:
    return np.empty((0, nodes_per_cell), dtype=np.int32)


@dataclass
class Part:
    """A run of segments and triangles of a surface that share contact properties: the first, and the one after the last."""

    name: str
    segments: tuple[int, int] = (0, 0)
    triangles: tuple[int, int] = (0, 0)
    material: str = ""  #: contact material of the particles; "": the scene's only one
    wire_radius: float = 0.0  #: m; of its segments


@dataclass
class Surface:
    """Nodes at the reference state and what spans between them: segments for wires and ropes, triangles for sheets."""

    positions: np.ndarray  #: (nodes, 3), m
    segments: np.ndarray = field(default_factory=lambda: _no_cells(2))  #: (n, 2) node indices
    triangles: np.ndarray = field(default_factory=lambda: _no_cells(3))  #: (n, 3), counter-clockwise from outside
    name: str = "surface"  #: of its only part, where `parts` are not given
    parts: Sequence[Part] = ()  #: in the order of their cells
    start: np.ndarray | None = None  #: (nodes, 3), m; displacement at time 0; None: none


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
class Probe:
    """A column of probes.csv."""

    name: str  #: "middle.displacement_z_m"
    watches: str = ""  #: what stands for the probe's point: "node 12", for the summary


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
class Table:
    """Events only become more and are written to <name>.csv; a distribution has rows whose values change, and stands in the summary."""

    name: str
    columns: Sequence[str]  #: "time_s", "diameter_m"
    capacity: int  #: most rows it will ever have
    kind: TableKind = TableKind.events
    rows: Sequence[str] = ()  #: names of the rows of a distribution; empty: they are numbered


@dataclass
class Declaration:
    """Program, step, limits, effects and outputs of a participant."""

    program: str
    step: float = 0.0  #: s; its own step inside a window; 0: one step a window, whatever its length
    limits: Sequence[StepLimit] = ()
    effects: Sequence[Effect] = ()
    probes: Sequence[str | Probe] = ()  #: columns of probes.csv, such as "net_centre.displacement_z_m"
    ledger: Sequence[LedgerLine] = ()
    groups: Sequence[Group] = ()
    tables: Sequence[Table] = ()
    facts: Mapping[str, float] = field(default_factory=dict)  #: numbers known before time 0, for the summary
    warnings: Sequence[str] = ()  #: for log.txt and the summary
    checkpoints: bool = False  #: it answers write_checkpoint and read_checkpoint
    #: structure; True: the force is a load over the window (implicit methods); False: it kicks at the start of each step (leapfrog)
    force_is_load: bool = False
    insists_on_step: bool = False  #: the scene allows a step above a stability limit; else it is refused before time 0
    loses_cells: bool = False  #: structure; cells may break, and it fills `lost`
    free_velocity: bool = False  #: structure: it can fill `free_velocity`; particles: they need it
    light_boundary: bool = False  #: particles; they can fill `moved_displacement` and `moved_velocity`
