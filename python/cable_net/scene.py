"""What a scene says about the structure, as far as this solver can compute it; anything else is an error that says so."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import talus_participant as talus

from cable_net.cables import CableNet, CableProperties
from cable_net.motion import Motion
from cable_net.net import Net, SquareNet, square_net

AXES = "xyz"


@dataclass(frozen=True)
class Probe:
    """A node whose displacement goes to probes.csv."""

    name: str
    node: int


@dataclass(frozen=True)
class Model:
    """One net, ready to move."""

    part: str
    net: Net
    motion: Motion
    step: float  #: s
    probes: list[Probe]
    coupled: bool  #: particles may push the net


def read_model(path: str) -> Model:
    """The structure of the scene in `path`. Raises talus.ConfigError where this solver cannot compute it."""
    scene = talus.read_scene(path)
    structure = scene.section("structure")
    structure.ignore("solver")
    part, net, properties = _read_part(structure.section("parts"))
    cables = CableNet(net, properties)
    motion = Motion(cables, _read_supports(structure, part, net), _read_damping(structure), _read_gravity(structure))
    step = (structure if "step" in structure else scene.section("time")).number("step", "s")
    structure.finish()
    return Model(part, net, motion, step, _read_probes(scene, net),
                 coupled="interface" in scene)


def _read_part(parts: talus.Section) -> tuple[str, Net, CableProperties]:
    (name, part), *more = parts.sections()
    if more:
        raise parts.error(more[0][0], "is a second part; this solver computes one net of cables")
    net, properties = _read_square_net(part.section("square_net")), _read_cable(part.section("cable"))
    part.finish()
    return name, net, properties


def _read_square_net(section: talus.Section) -> Net:
    pitch = section.number("pitch", "m", at_least=1e-9)
    size = section.numbers("size", "m", 2)
    openings = tuple(int(n) for n in np.rint(size / pitch))
    if not np.allclose(openings * np.array(pitch), size, rtol=1e-6, atol=0):
        raise section.error("pitch", f"must divide the size {size[0]:g} m x {size[1]:g} m, but is {pitch:g} m")
    section.ignore("wire_diameter")  # the particles' business
    along, across = (_direction(section, key, axis) for key, axis in (("along", 0), ("across", 1)))
    panel = SquareNet(section.numbers("corner", "m", 3), openings, pitch, along, across)
    section.finish()
    return square_net(panel)


def _direction(section: talus.Section, key: str, axis: int) -> np.ndarray:
    direction = section.numbers(key, "", 3) if key in section else np.eye(3)[axis]
    return direction / np.linalg.norm(direction)


def _read_cable(section: talus.Section) -> CableProperties:
    tiny = np.finfo(float).tiny  # the least number above 0
    properties = CableProperties(area=section.number("area", "m^2", at_least=tiny),
                                 density=section.number("density", "kg/m^3", at_least=tiny),
                                 youngs_modulus=section.number("youngs_modulus", "Pa", at_least=tiny),
                                 prestress=section.number("prestress", "Pa") if "prestress" in section else 0.0)
    section.finish()
    return properties


def _read_supports(structure: talus.Section, part: str, net: Net) -> np.ndarray:
    supported = np.zeros(net.positions.shape, dtype=bool)
    for support in structure.list("supports") if "supports" in structure else []:
        nodes, axes = support.text("nodes"), support.text("fix")
        if nodes != f"{part}.rim":
            raise support.error("nodes", f"is '{nodes}'; this solver knows only '{part}.rim'")
        if not set(axes) <= set(AXES):
            raise support.error("fix", f"expects letters of '{AXES}', got '{axes}'")
        supported[np.ix_(net.rim, [AXES.index(axis) for axis in axes])] = True
        support.finish()
    return supported


def _read_damping(structure: talus.Section) -> float:
    if "damping" not in structure:
        return 0.0
    damping = structure.section("damping")
    mass = damping.number("mass", "1/s", at_least=0)
    damping.finish()
    return mass


def _read_gravity(structure: talus.Section) -> np.ndarray:
    return structure.numbers("gravity", "m/s^2", 3) if "gravity" in structure else np.zeros(3)


def _read_probes(scene: talus.Section, net: Net) -> list[Probe]:
    output = scene.section("output") if "output" in scene else None
    if output is None or "probes" not in output:
        return []
    return [_probe(name, probe, net) for name, probe in output.section("probes").sections() if "at" in probe]


def _probe(name: str, section: talus.Section, net: Net) -> Probe:
    """The node nearest to a point, which must not be further away than the wires there are long."""
    point = section.numbers("at", "m", 3)
    distances = np.linalg.norm(net.positions - point, axis=1)
    node = int(np.argmin(distances))
    ends = net.positions[net.wires[(net.wires == node).any(axis=1)]]
    longest = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).max()
    if distances[node] > longest:
        raise section.error("at", f"no node is near: the nearest, {node}, is {distances[node]:.6g} m away, more than its wires "
                                  f"of {longest:.6g} m are long")
    return Probe(name, node)
