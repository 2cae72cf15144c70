"""Take part in a coupled Talus run with a solver written in Python.

A structural solver joins, says what it is, and answers commands until there are no more:

    import talus_participant as talus
    with talus.Participant(segment, talus.Role.structure) as participant:
        participant.publish_surface(surface, node_masses)
        participant.declare(talus.Declaration(program="my solver"))
        for command in participant.commands():
            ...

docs/participants.md tells the whole story; examples/participants/springs.py is a complete program of some 40 lines.
"""
from talus_participant._native import Action, Command, FieldLocation, LedgerKind, Role, TableKind
from talus_participant.description import Declaration, Effect, Field, Group, LedgerLine, Part, Probe, StepLimit, Surface, Table
from talus_participant.errors import Complaint, ConfigError, MachineError, NumericalError, TalusError, TransportError, UsageError
from talus_participant.participant import Participant, ParticleFields, StructureFields, checkpoint_state, write_checkpoint
from talus_participant.scene import Section, read_scene

__all__ = [
    "Action", "Command", "Complaint", "ConfigError", "Declaration", "Effect", "Field", "FieldLocation", "Group",
    "LedgerKind", "LedgerLine", "MachineError", "NumericalError", "Part", "Participant", "ParticleFields", "Probe",
    "Role", "Section", "StepLimit", "StructureFields", "Surface", "Table", "TableKind", "TalusError",
    "TransportError", "UsageError", "checkpoint_state", "read_scene", "write_checkpoint",
]
