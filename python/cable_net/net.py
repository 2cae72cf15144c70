"""Square nets: nodes, wires between them, and the named sets of nodes that supports refer to."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Net:
    """Nodes and the wires between neighbours."""

    positions: np.ndarray  #: (nodes, 3), m
    wires: np.ndarray  #: (wires, 2) node indices
    rim: np.ndarray  #: indices of the nodes on the four edges


@dataclass(frozen=True)
class SquareNet:
    """A panel of `openings` square openings of edge `pitch` (m), spanned from `corner` (m) along two unit vectors."""

    corner: np.ndarray
    openings: tuple[int, int]
    pitch: float
    along: np.ndarray
    across: np.ndarray


def square_net(panel: SquareNet) -> Net:
    """Node numbers run along the first direction, row by row."""
    columns, rows = (n + 1 for n in panel.openings)
    number = np.arange(rows * columns).reshape(rows, columns)
    row, column = np.divmod(number.ravel(), columns)
    positions = panel.corner + panel.pitch * (np.outer(column, panel.along) + np.outer(row, panel.across))
    wires = np.concatenate([np.column_stack([number[:, :-1].ravel(), number[:, 1:].ravel()]),
                            np.column_stack([number[:-1].ravel(), number[1:].ravel()])])
    rim = number[(row.reshape(rows, columns) % (rows - 1) == 0) | (column.reshape(rows, columns) % (columns - 1) == 0)]
    return Net(positions, wires, rim)
