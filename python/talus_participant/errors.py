"""The ways a run can fail, told apart because a different person has to act. The texts are those of the C++ programs."""


class TalusError(Exception):
    """What all errors of this package have in common."""


class ConfigError(TalusError):
    """The user's scene is wrong. Raised by a solver before time 0, it ends the run with exactly its text."""


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
