"""The ways a run can fail, told apart because a different person has to act. The texts are those of the C++ programs."""
from __future__ import annotations

from dataclasses import dataclass


class TalusError(Exception):
    """What all errors of this package have in common."""


@dataclass(frozen=True)
class Complaint:
    """One complaint about a scene, tied to the place in the file it speaks of."""

    message: str  #: one sentence: what is wrong, the value, what was expected
    file: str = ""
    line: int = 0  #: from 1; 0: the file as a whole
    column: int = 0  #: from 1; 0: the line as a whole
    key_path: str = ""  #: "structure.parts.net.area"

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line, self.column) if part)
        return ": ".join(part for part in (place, self.key_path, self.message) if part)


class ConfigError(TalusError):
    """The user's scene is wrong. Raised by a solver before time 0, it ends the run with exactly its text, or with its complaints beside
    those of the coupler."""

    def __init__(self, *said: str | Complaint):
        """A text, or complaints."""
        super().__init__("\n".join(str(one) for one in said))
        self.complaints = tuple(one for one in said if isinstance(one, Complaint))


class MachineError(TalusError):
    """The machine does not give what the program needs: memory, a file."""


class UsageError(TalusError):
    """A call out of order, or an array of the wrong shape."""


class TransportError(TalusError):
    """The coupler died, ended the run, or is no coupler of this version."""


class NumericalError(TalusError):
    """The computation broke down: the text names what, where and when.

    what: "displacement is not finite"; entity: "node 17 of net"; time in s; value: that of `what`, in its SI unit.
    """

    def __init__(self, what: str, *, entity: str, step: int, time: float, value: float):
        super().__init__(f"{what} at step {step}, time {time:.9g} s: {entity} = {value:.6g}")
        self.what, self.entity, self.step, self.time, self.value = what, entity, step, time, value
