#!/usr/bin/env python3
"""Draws the stones on the panel from the side, and which of them passed. The picture of docs/openings.md is made by

    ./talus run configs/examples/openings.yaml
    python3 docs/pictures/openings.py results/openings docs/pictures/openings.png
"""
import pathlib
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PatchCollection
from matplotlib.patches import Circle

from draw import frame_at

STONES = 2000
OPENING, WIDEST = 0.080, 0.093  # m; of a mesh as it hangs, and sheared to a square
GATE_HEIGHT = -2.5  # m
MOMENTS = (0.0, 0.4, 1.6)  # s


def draw_moment(axes, fields, frame, time):
    wires = fields[f"boundary_wires/position/{frame:06d}"][:][fields["boundary_wires/cells"][:]]
    axes.add_collection(LineCollection(wires[:, :, [0, 2]], colors="#33475b", linewidths=0.25, alpha=0.6))
    centres = fields[f"particles/position/{frame:06d}"][:]
    radii = fields[f"particles/radius/{frame:06d}"][:].ravel()
    colours = np.where(np.arange(len(radii)) < len(radii) - STONES, "#8c7b6b", np.where(2 * radii < OPENING, "#2e86ab", "#d1603d"))
    order = np.argsort(-centres[:, 1])
    axes.add_collection(PatchCollection([Circle(centres[i, [0, 2]], radii[i]) for i in order], facecolors=colours[order],
                                        edgecolors="white", linewidths=0.1))
    axes.set(xlim=(-0.3, 5), ylim=(-4.2, 1.8), aspect="equal", title=f"{time:g} s")
    axes.set_axis_off()


def draw_passed(axes, fields, frame):
    diameters = 2 * fields[f"particles/radius/{frame:06d}"][-STONES:].ravel()
    passed = fields[f"particles/position/{frame:06d}"][-STONES:, 2] < GATE_HEIGHT
    limits = np.linspace(0.01, 0.15, 15)
    parts = [passed[(diameters >= low) & (diameters < high)].mean() for low, high in zip(limits, limits[1:])]
    axes.stairs(parts, 1000 * limits, fill=True, color="#2e86ab", alpha=0.7)
    axes.axvline(1000 * OPENING, color="#33475b", linewidth=1)
    axes.axvline(1000 * WIDEST, color="#33475b", linewidth=1, linestyle=":")
    axes.set(xlabel="diameter (mm)", ylabel="part that passed", ylim=(0, 1))


def main(result: pathlib.Path, picture: pathlib.Path):
    figure, axes = plt.subplots(1, 4, figsize=(13, 3.9), width_ratios=(1, 1, 1, 0.8))
    with h5py.File(result / "fields.h5") as fields:
        for moment, place in zip(MOMENTS, axes):
            draw_moment(place, fields, frame_at(result, moment), moment)
        draw_passed(axes[-1], fields, frame_at(result, MOMENTS[-1]))
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
