"""Draws what each coupling scheme sends when: docs/pictures/coupling_schemes.svg, shown in docs/coupling.md.

    python3 docs/pictures/coupling_schemes.py docs/pictures/coupling_schemes.svg
"""
import sys
from dataclasses import dataclass

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

PARTICLES, STRUCTURE = 1.0, 0.0  # heights of the two lanes
COLOURS = {PARTICLES: "#a04000", STRUCTURE: "#1f4e79"}
FORCE, MOTION = "#a04000", "#1f4e79"  # of what is sent: forces come from the particles, motion from the structure


@dataclass
class Step:
    """One side computes from one time to another; `order` counts within the window, `parts` are its own steps."""

    lane: float
    start: float
    end: float
    order: str
    parts: int = 1


@dataclass
class Message:
    """What one side hands to the other: from a time of its own to the time where the other uses it."""

    lane: float
    sent: float
    used: float
    text: str
    along: float = 0.5  # where the text stands, as a share of the arrow
    left: bool = False  # of the arrow


@dataclass
class Scheme:
    title: str
    steps: list[Step]
    messages: list[Message]
    loop: str = ""


WINDOW = 2.0  # length of an iterated window on paper, where there is only one
REPEAT = "until both agree: restore both to $t_n$ and repeat"
SCHEMES = [
    Scheme("serial_explicit, one step a window",
           [Step(PARTICLES, 0, 1, "1"), Step(STRUCTURE, 0, 1, "2"), Step(PARTICLES, 1, 2, "3"), Step(STRUCTURE, 1, 2, "4")],
           [Message(PARTICLES, 0, 0, "$f_n$"), Message(STRUCTURE, 0.98, 0.98, r"$u_{n+1}, v_{n+1/2}$", left=True),
            Message(PARTICLES, 1.02, 1.02, "$f_{n+1}$"), Message(STRUCTURE, 2, 2, r"$u_{n+2}, v_{n+3/2}$", left=True)]),
    Scheme("serial_explicit, several steps a window",
           [Step(PARTICLES, 0, 1, "1", 6), Step(STRUCTURE, 0, 1, "2", 3), Step(PARTICLES, 1, 2, "3", 6),
            Step(STRUCTURE, 1, 2, "4", 3)],
           [Message(STRUCTURE, 0, 0, "$u_n$ and $v_n$", 0.25), Message(PARTICLES, 0.97, 0.5, "mean of $f$", 0.3, left=True),
            Message(STRUCTURE, 1, 1, "$u_{n+1}, v_{n+1}$", 0.25), Message(PARTICLES, 1.97, 1.5, "mean of $f$", 0.3, left=True)]),
    Scheme("parallel_explicit",
           [Step(PARTICLES, 0, 1, "1"), Step(STRUCTURE, 0, 1, "1"), Step(PARTICLES, 1, 2, "2"), Step(STRUCTURE, 1, 2, "2")],
           [Message(PARTICLES, 0, 1, "$f_n$", 0.4, left=True), Message(STRUCTURE, 1, 1, "$u_{n+1}, v_{n+1}$", 0.2),
            Message(PARTICLES, 1, 2, "$f_{n+1}$", 0.4)]),
    Scheme("serial_implicit, relax: motion",
           [Step(PARTICLES, 0, WINDOW, "1", 6), Step(STRUCTURE, 0, WINDOW, "2")],
           [Message(PARTICLES, 1.9, 1, "mean of $f$", 0.8),
            Message(STRUCTURE, 2, 2, "$u, v$ = $H(x)$ at the end", 0.3),
            Message(STRUCTURE, 2, 2, "next $x$ from $x$ and $H(x)$", 0.7)], REPEAT),
    Scheme("serial_implicit, relax: force",
           [Step(STRUCTURE, 0, WINDOW, "1"), Step(PARTICLES, 0, WINDOW, "2", 6)],
           [Message(STRUCTURE, 2, 2, "$u, v$ at the end"), Message(PARTICLES, 1.9, 1, "mean of $f$ = $H(x)$", 0.45, left=True),
            Message(PARTICLES, 1.9, 1, "next $x$ from $x$ and $H(x)$", 0.75, left=True)], REPEAT),
    Scheme("parallel_implicit",
           [Step(PARTICLES, 0, WINDOW, "1", 6), Step(STRUCTURE, 0, WINDOW, "1")],
           [Message(PARTICLES, 1.9, 1, "mean of $f$", 0.8), Message(STRUCTURE, 2, 2, "$u, v$ at the end", 0.3),
            Message(STRUCTURE, 2, 2, "next $(u, v, f)$ from all", 0.7)], REPEAT),
]


def draw_lanes(axes, scheme):
    last = max(step.end for step in scheme.steps)
    for lane, name in ((PARTICLES, "particles"), (STRUCTURE, "structure")):
        axes.plot([-0.05, last + 0.1], [lane, lane], color="0.75", linewidth=1, zorder=0)
        axes.text(-0.12, lane, name, ha="right", va="center", color=COLOURS[lane], fontsize=9)
    for index in range(3):
        if scheme.loop and index == 1:
            continue  # the middle of the only window
        axes.plot([index, index], [-0.32, 1.3], color="0.85", linewidth=1, zorder=0)
        number = 1 if scheme.loop and index else index
        axes.text(index, -0.42, f"$t_{{n+{number}}}$" if number else "$t_n$", ha="center", va="top", fontsize=10)


def draw_step(axes, step):
    outside = 0.16 if step.lane == PARTICLES else -0.16
    ends = [step.start + (step.end - step.start) * k / step.parts for k in range(step.parts + 1)]
    for start, end in zip(ends, ends[1:]):
        axes.annotate("", xy=(end, step.lane + outside), xytext=(start, step.lane + outside),
                      arrowprops={"arrowstyle": "-|>", "color": COLOURS[step.lane], "linewidth": 1.6,
                                  "connectionstyle": f"arc3,rad={-0.35 if outside > 0 else 0.35}", "shrinkA": 1, "shrinkB": 1})
    axes.text((step.start + step.end) / 2, step.lane + 2.1 * outside, step.order, ha="center", va="center", fontsize=9,
              color="white", bbox={"boxstyle": "circle,pad=0.2", "color": COLOURS[step.lane]})


def draw_message(axes, message):
    other = STRUCTURE if message.lane == PARTICLES else PARTICLES
    colour = FORCE if message.lane == PARTICLES else MOTION
    axes.annotate("", xy=(message.used, other), xytext=(message.sent, message.lane),
                  arrowprops={"arrowstyle": "->", "color": colour, "linewidth": 1.2, "linestyle": "--", "shrinkA": 2, "shrinkB": 2})
    x = message.sent + message.along * (message.used - message.sent) + (-0.05 if message.left else 0.05)
    y = message.lane + message.along * (other - message.lane)
    axes.text(x, y, message.text, ha="right" if message.left else "left", va="center", fontsize=9, color=colour)


def draw(scheme, axes):
    draw_lanes(axes, scheme)
    for step in scheme.steps:
        draw_step(axes, step)
    for message in scheme.messages:
        draw_message(axes, message)
    if scheme.loop:
        axes.annotate("", xy=(0, 1.62), xytext=(WINDOW, 1.62), arrowprops={"arrowstyle": "->", "color": "0.35"})
        axes.text(WINDOW / 2, 1.7, scheme.loop, ha="center", va="bottom", fontsize=9, color="0.25")
    axes.set_title(scheme.title, fontsize=10, loc="left")
    axes.set_xlim(-0.5, 3.0)
    axes.set_ylim(-0.75, 2.05 if scheme.loop else 1.6)
    axes.axis("off")


def main(file):
    matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "talus", "mathtext.fontset": "dejavusans"})
    figure, axes = plt.subplots(3, 2, figsize=(11, 8.2), constrained_layout=True)
    for scheme, place in zip(SCHEMES, axes.T.ravel()):
        draw(scheme, place)
    figure.savefig(file, metadata={"Date": None})


main(sys.argv[1])
