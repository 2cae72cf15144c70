#!/usr/bin/env python3
"""Draws one frame of a result: net, rocks and the path of a probe. The picture of the README is made by

    ./talus run configs/examples/cable_net_implicit.yaml
    python3 docs/pictures/draw.py results/cable_net_implicit 0.075 docs/pictures/cable_net.png

and that of docs/nets.md by

    ./talus run configs/examples/ring_net.yaml
    python3 docs/pictures/draw.py results/ring_net 0.075 docs/pictures/ring_net.png boulder.contact_force_z_N
"""
import csv
import pathlib
import sys
import xml.etree.ElementTree as xml

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Line3DCollection


def frame_at(result: pathlib.Path, time: float) -> int:
    """Number of the frame nearest to a time (s)."""
    times = [float(t.get("Value")) for t in xml.parse(result / "fields.xdmf").iter("Time")]
    return int(np.argmin(np.abs(np.array(times) - time)))


def draw_net(axes, fields, frame):
    at = fields[f"net/position/{frame:06d}"][:]
    lines = at[fields["net/cells"][:]]
    axes.add_collection3d(Line3DCollection(lines, colors="#33475b", linewidths=0.7))


def draw_rocks(axes, fields, frame):
    centres, radii = fields[f"particles/position/{frame:06d}"][:], fields[f"particles/radius/{frame:06d}"][:].ravel()
    u, v = np.mgrid[0:2 * np.pi:40j, 0:np.pi:20j]
    ball = np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)])
    for centre, radius in zip(centres, radii):
        axes.plot_surface(*(centre[:, None, None] + radius * ball), color="#b5793a", linewidth=0, shade=True)


def draw_probe(axes, result, name, time):
    with open(result / "probes.csv", newline="") as file:
        rows = [(float(row["time_s"]), float(row[name])) for row in csv.DictReader(file)]
    axes.plot(*zip(*rows), color="#33475b")
    axes.axvline(time, color="#b5793a", linewidth=0.8)
    axes.set(xlabel="time (s)", ylabel=name.replace("_", " "))
    axes.grid(alpha=0.3)


def main(result: pathlib.Path, time: float, picture: pathlib.Path, probe: str = "net_centre.displacement_z_m"):
    figure = plt.figure(figsize=(11, 4.6))
    space, plot = figure.add_subplot(1, 2, 1, projection="3d"), figure.add_subplot(1, 2, 2)
    with h5py.File(result / "fields.h5") as fields:
        frame = frame_at(result, time)
        draw_net(space, fields, frame)
        draw_rocks(space, fields, frame)
    space.set(xlim=(0, 3), ylim=(0, 3), zlim=(-0.75, 0.75))
    space.set_box_aspect((3, 3, 1.5), zoom=1.7)
    space.set_axis_off()
    space.view_init(elev=22, azim=-60)
    draw_probe(plot, result, probe, time)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), float(sys.argv[2]), pathlib.Path(sys.argv[3]), *sys.argv[4:])
