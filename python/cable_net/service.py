"""The net as a participant: what it declares, and an answer to each command."""
from __future__ import annotations

import numpy as np
import talus_participant as talus

from cable_net.motion import State, at_rest
from cable_net.scene import AXES, Model

PROGRAM = "cable_net_solver (NumPy)"


def serve(participant: talus.Participant, model: Model) -> None:
    """Answers commands until the run is over."""
    participant.publish_surface(*interface_surface(model))
    participant.declare(declaration(model))
    service = Service(participant, model)
    for command in participant.commands():
        service.answer(command)


def interface_surface(model: Model) -> tuple[talus.Surface, np.ndarray]:
    """The whole net and its node masses (kg); nothing where the scene has no particles to push it."""
    if not model.coupled:
        return talus.Surface(np.empty((0, 3))), np.empty(0)
    surface = talus.Surface(model.net.positions, segments=model.net.wires, name=model.part)
    return surface, model.motion.net.node_masses


def declaration(model: Model) -> talus.Declaration:
    """Step and limit, probes, ledger, and the net as a group of segments."""
    free = np.flatnonzero(~model.motion.supported.all(axis=1))
    limit = talus.StepLimit("cables", model.motion.net.largest_stable_step(free), "2/w, w the highest frequency at rest")
    group = talus.Group(model.part, len(model.net.positions), model.net.wires, fields=[
        talus.Field("displacement", "m", 3), talus.Field("axial_force", "N", 1, talus.FieldLocation.cell)])
    return talus.Declaration(
        program=PROGRAM, step=model.step, limits=[limit], checkpoints=True,
        probes=[f"{probe.name}.displacement_{axis}_m" for probe in model.probes for axis in AXES],
        ledger=[talus.LedgerLine("structure.kinetic_J"), talus.LedgerLine(f"structure.elastic_{model.part}_J"),
                talus.LedgerLine("structure.bulk_damping_J", talus.LedgerKind.dissipated),
                talus.LedgerLine("structure.outer_forces_J", talus.LedgerKind.supplied)],
        groups=[group])


class Service:
    """The state of the net, the state saved last, and how each command changes them."""

    def __init__(self, participant: talus.Participant, model: Model):
        self._participant, self._model = participant, model
        self._state = at_rest(len(model.net.positions))
        self._saved = self._state
        self._answers = {
            talus.Action.advance: self._advance, talus.Action.report: self._report,
            talus.Action.save_state: self._save, talus.Action.restore_state: self._restore,
            talus.Action.write_checkpoint: self._write, talus.Action.read_checkpoint: self._read}

    def answer(self, command: talus.Command) -> None:
        """Does what the coupler wants and shows the state it leads to."""
        self._answers[command.action](command)
        if self._model.coupled:
            fields = self._participant.structure_fields()
            fields.displacement[:], fields.velocity[:] = self._state.displacement, self._state.velocity

    def _advance(self, command: talus.Command) -> None:
        steps = max(1, round(command.length / self._model.step))
        force = self._participant.structure_fields().force if self._model.coupled else np.zeros(3)
        for _ in range(steps):
            self._model.motion.step(self._state, force, command.length / steps)
        self._check(command)

    def _check(self, command: talus.Command) -> None:
        if not np.isfinite(self._state.velocity).all():
            node = int(np.argmin(np.isfinite(self._state.velocity).all(axis=1)))
            raise talus.NumericalError("velocity is not finite", entity=f"node {node} of {self._model.part}",
                                       step=self._state.steps, time=command.time, value=float("nan"))

    def _report(self, command: talus.Command) -> None:
        state, net = self._state, self._model.motion.net
        nodes = [probe.node for probe in self._model.probes]
        self._participant.probes()[:] = state.displacement[nodes].ravel()
        self._participant.ledger()[:] = [self._model.motion.kinetic_energy(state), net.energy(state.old_displacement),
                                         state.damped, state.supplied]
        if command.fields:
            self._participant.positions(0)[:] = net.reference + state.displacement
            self._participant.field(0, 0)[:] = state.displacement
            self._participant.field(0, 1)[:, 0] = net.axial_forces(state.displacement)

    def _save(self, command: talus.Command) -> None:
        self._saved = self._state.copy()

    def _restore(self, command: talus.Command) -> None:
        self._state = self._saved.copy()

    def _write(self, command: talus.Command) -> None:
        talus.write_checkpoint(command, lambda file: np.savez(file, **vars(self._state)))

    def _read(self, command: talus.Command) -> None:
        with np.load(command.path) as stored:
            self._state = State(**{name: stored[name] if stored[name].ndim else stored[name].item() for name in stored})
