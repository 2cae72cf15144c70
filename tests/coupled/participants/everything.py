"""Says everything a participant can say: what everything.c says, in Python. foreign_declarations_test.cpp knows what is to arrive."""
import sys

import numpy as np
import talus_participant as talus

SURFACE = talus.Surface(
    positions=np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]),
    segments=np.array([[3, 0]]),
    triangles=np.array([[0, 1, 2], [0, 2, 3]]),
    parts=[talus.Part("rope", segments=(0, 1), material="steel", wire_radius=0.01),
           talus.Part("sheet", segments=(1, 1), triangles=(0, 2))],
    start=np.array([[0, 0, 0], [0, 0, -0.5], [0, 0, 0], [0, 0, 0]]))

STRUCTURE = talus.Declaration(
    "everything 1.0", step=1e-3, insists_on_step=True, force_is_load=True, checkpoints=True, loses_cells=True, free_velocity=True,
    limits=[talus.StepLimit("springs", 2e-3, "2 sqrt(m/k)"), talus.StepLimit("waves", 1e-4, "l/c", stability=False)],
    effects=[talus.Effect("damping", True, "damping is given", key="structure.damping", ledger_line="structure.damping_J",
                          may_hold=True, limit="springs"),
             talus.Effect("plasticity", False, "no yield stress")],
    warnings=["the rim is soft"],
    probes=[talus.Probe("middle.displacement_z_m", watches="node 2"), "rim.force_N"],
    ledger=[talus.LedgerLine("structure.elastic_J", talus.LedgerKind.stored),
            talus.LedgerLine("structure.damping_J", talus.LedgerKind.dissipated),
            talus.LedgerLine("structure.gravity_J", talus.LedgerKind.supplied),
            talus.LedgerLine("structure.rim_J", talus.LedgerKind.memo)],
    groups=[talus.Group("sheet", 4, SURFACE.triangles,
                        fields=[talus.Field("displacement", "m", 3),
                                talus.Field("strain", "1", location=talus.FieldLocation.cell)])],
    tables=[talus.Table("below", ["time_s", "diameter_m"], capacity=3),
            talus.Table("sizes", ["diameter_m"], capacity=2, kind=talus.TableKind.distribution, rows=["small", "large"])],
    facts={"structure.mass_kg": 6.5})


def report(participant, with_fields):
    participant.probes()[:] = 1, 2
    participant.ledger()[:] = 3, 4, 5, 6
    participant.table(0)[:2] = [7, 8], [9, 10]
    participant.set_table_rows(0, 2)
    participant.table(1)[:, 0] = 11, 12
    participant.set_table_rows(1, 2)
    if with_fields:
        participant.positions(0)[3, 2] = 13
        participant.field(0, 0)[3, 2] = 14
        participant.field(0, 1)[1] = 15


def compute_structure(participant, command):
    fields = participant.structure_fields()
    fields.displacement[0] = command.time, command.length, command.regular_length
    fields.velocity[0, :2] = command.tentative, command.iteration
    if fields.free_velocity.size:
        fields.free_velocity[0, 0] = 0.75
    fields.lost[1] = 1
    participant.tell_force_evaluations(3)
    participant.book_work(0.125)


def particles(boundary, masses, free):
    facts = {f"{part.name} of {part.material or 'any'}": part.wire_radius + part.segments[1] + 10 * part.triangles[1]
             for part in boundary.parts}
    facts |= {"start of node 1": boundary.start[1, 2], "mass of node 2": masses[2],
              "corner of triangle 1": boundary.triangles[1, 1]}
    return talus.Declaration("everything 1.0", facts=facts, free_velocity=free, light_boundary=True)


def compute_particles(participant, command):
    fields = participant.particle_fields()
    fields.force[0] = fields.start_displacement[0, 0] + fields.start_velocity[0, 1], command.force_shift, fields.lost[1]
    fields.force[1, 0] = fields.free_velocity[0, 0] if fields.free_velocity.size else -1
    fields.force[1, 1] = fields.end_displacement[0, 0] + fields.end_velocity[0, 0] if fields.end_velocity.size else -1
    if fields.moved_displacement.size:
        fields.moved_displacement[0, 0] = 16
        fields.moved_velocity[0, 0] = 17


is_structure = sys.argv[1] == "structure"
role = talus.Role.structure if is_structure else talus.Role.particles
with talus.Participant(sys.argv[-1], role, timeout=20) as participant:
    if is_structure:
        participant.publish_surface(SURFACE, np.array([1, 2, 3, 1e30]))
        participant.declare(STRUCTURE)
    else:
        participant.declare(particles(*participant.receive_surface(), free=sys.argv[2] == "free"))
    for command in participant.commands():
        if command.action == talus.Action.advance:
            (compute_structure if is_structure else compute_particles)(participant, command)
        elif command.action == talus.Action.report and is_structure:
            report(participant, command.fields)
