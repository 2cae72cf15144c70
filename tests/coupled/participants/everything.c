/* Says everything a participant can say: `everything structure --join SEGMENT`, or `everything particles free ...` or
 * `particles light ...`, which differ in what they ask of the interface. foreign_declarations_test.cpp knows what is
 * to arrive; everything.py says the same. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "coupler/c_api/talus.h"

/* Every call is to succeed. */
static void must(talus_result result) {
  if (result == TALUS_OK) return;
  fprintf(stderr, "everything: %s\n", talus_last_error());
  exit(result);
}

static void publish(talus_participant* self) {
  const double positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, masses[] = {1, 2, 3, 1e30};
  const double start[] = {0, 0, 0, 0, 0, -0.5, 0, 0, 0, 0, 0, 0};
  const int32_t segments[] = {3, 0}, triangles[] = {0, 1, 2, 0, 2, 3};
  const talus_part rope = {
      .size = sizeof rope, .name = "rope", .material = "steel", .wire_radius = 0.01, .segment_end = 1};
  const talus_part sheet = {
      .size = sizeof sheet, .name = "sheet", .segment_begin = 1, .segment_end = 1, .triangle_end = 2};
  must(talus_add_part(self, &rope));
  must(talus_add_part(self, &sheet));
  must(talus_publish_surface(self, &(talus_surface){.size = sizeof(talus_surface),
                                                    .nodes = 4,
                                                    .positions = positions,
                                                    .node_masses = masses,
                                                    .segments = 1,
                                                    .segment_nodes = segments,
                                                    .triangles = 2,
                                                    .triangle_nodes = triangles,
                                                    .start = start}));
}

static void add_outputs(talus_participant* self) {
  const int64_t cells[] = {0, 1, 2, 0, 2, 3};
  const char *columns[] = {"time_s", "diameter_m"}, *rows[] = {"small", "large"};
  const talus_group group = {
      .size = sizeof group, .name = "sheet", .nodes = 4, .corners = 3, .cells = 2, .cell_nodes = cells};
  const talus_field u = {.size = sizeof u, .name = "displacement", .unit = "m", .components = 3};
  const talus_field strain = {
      .size = sizeof strain, .name = "strain", .unit = "1", .components = 1, .location = TALUS_AT_CELLS};
  const talus_table below = {
      .size = sizeof below, .name = "below", .columns = 2, .column_names = columns, .capacity = 3};
  const talus_table sizes = {.size = sizeof sizes,
                             .name = "sizes",
                             .kind = TALUS_DISTRIBUTION,
                             .columns = 1,
                             .column_names = columns + 1,
                             .capacity = 2,
                             .row_names = rows};
  must(talus_add_probe(self, "middle.displacement_z_m", "node 2"));
  must(talus_add_probe(self, "rim.force_N", NULL));
  must(talus_add_ledger_line(self, "structure.elastic_J", TALUS_STORED));
  must(talus_add_ledger_line(self, "structure.damping_J", TALUS_DISSIPATED));
  must(talus_add_ledger_line(self, "structure.gravity_J", TALUS_SUPPLIED));
  must(talus_add_ledger_line(self, "structure.rim_J", TALUS_MEMO));
  must(talus_add_group(self, &group));
  must(talus_add_field(self, &u));
  must(talus_add_field(self, &strain));
  must(talus_add_table(self, &below));
  must(talus_add_table(self, &sizes));
  must(talus_add_fact(self, "structure.mass_kg", 6.5));
}

static void declare_structure(talus_participant* self) {
  const talus_limit stable = {
      .size = sizeof stable, .name = "springs", .seconds = 2e-3, .reason = "2 sqrt(m/k)"};
  const talus_limit accurate = {
      .size = sizeof accurate, .name = "waves", .seconds = 1e-4, .only_accuracy = 1, .reason = "l/c"};
  const talus_effect damping = {.size = sizeof damping,
                                .name = "damping",
                                .present = 1,
                                .reason = "damping is given",
                                .key = "structure.damping",
                                .ledger_line = "structure.damping_J",
                                .may_hold = 1,
                                .limit = "springs"};
  const talus_effect plasticity = {
      .size = sizeof plasticity, .name = "plasticity", .reason = "no yield stress"};
  must(talus_add_limit(self, &stable));
  must(talus_add_limit(self, &accurate));
  must(talus_add_effect(self, &damping));
  must(talus_add_effect(self, &plasticity));
  must(talus_add_warning(self, "the rim is soft"));
  add_outputs(self);
  must(talus_declare(self, &(talus_declaration){.size = sizeof(talus_declaration),
                                                .program = "everything 1.0",
                                                .step = 1e-3,
                                                .insists_on_step = 1,
                                                .force_is_load = 1,
                                                .checkpoints = 1,
                                                .loses_cells = 1,
                                                .free_velocity = 1}));
}

static void report(talus_participant* self, int fields) {
  double *probes, *ledger, *positions, *u, *strain, *below, *sizes, *rows;
  must(talus_get_probes(self, &probes));
  must(talus_get_ledger(self, &ledger));
  must(talus_get_table(self, 0, &below, &rows));
  memcpy(probes, (double[]){1, 2}, 2 * sizeof(double));
  memcpy(ledger, (double[]){3, 4, 5, 6}, 4 * sizeof(double));
  memcpy(below, (double[]){7, 8, 9, 10}, 4 * sizeof(double));
  *rows = 2;
  must(talus_get_table(self, 1, &sizes, &rows));
  memcpy(sizes, (double[]){11, 12}, 2 * sizeof(double));
  *rows = 2;
  if (!fields) return;
  must(talus_get_positions(self, 0, &positions));
  must(talus_get_field(self, 0, 0, &u));
  must(talus_get_field(self, 0, 1, &strain));
  positions[11] = 13;
  u[11] = 14;
  strain[1] = 15;
}

static void compute_structure(talus_participant* self, const talus_command* command) {
  talus_structure_fields fields = {.size = sizeof fields};
  must(talus_get_structure_fields(self, &fields));
  memcpy(fields.displacement, (double[]){command->time, command->length, command->regular_length},
         3 * sizeof(double));
  fields.velocity[0] = command->tentative;
  fields.velocity[1] = command->iteration;
  if (fields.free_velocity != NULL) fields.free_velocity[0] = 0.75;
  fields.lost[1] = 1;
  must(talus_tell_force_evaluations(self, 3));
  must(talus_book_work(self, 0.125));
}

static void declare_particles(talus_participant* self, int free) {
  talus_surface boundary = {.size = sizeof boundary};
  must(talus_receive_surface(self, &boundary));
  for (int64_t i = 0; i < boundary.parts; ++i) {
    talus_part part = {.size = sizeof part};
    char name[200];
    must(talus_get_part(self, i, &part));
    snprintf(name, sizeof name, "%s of %s", part.name, part.material == NULL ? "any" : part.material);
    must(talus_add_fact(self, name, part.wire_radius + (double)(part.segment_end + 10 * part.triangle_end)));
  }
  must(talus_add_fact(self, "start of node 1", boundary.start[5]));
  must(talus_add_fact(self, "mass of node 2", boundary.node_masses[2]));
  must(talus_add_fact(self, "corner of triangle 1", boundary.triangle_nodes[4]));
  must(talus_declare(self, &(talus_declaration){.size = sizeof(talus_declaration),
                                                .program = "everything 1.0",
                                                .free_velocity = free,
                                                .light_boundary = 1}));
}

static void compute_particles(talus_participant* self, const talus_command* command) {
  talus_particle_fields fields = {.size = sizeof fields};
  must(talus_get_particle_fields(self, &fields));
  fields.force[0] = fields.start_displacement[0] + fields.start_velocity[1];
  fields.force[1] = command->force_shift;
  fields.force[2] = fields.lost[1];
  fields.force[3] = fields.free_velocity == NULL ? -1 : fields.free_velocity[0];
  fields.force[4] = fields.end_velocity == NULL ? -1 : fields.end_displacement[0] + fields.end_velocity[0];
  if (fields.moved_displacement == NULL) return;
  fields.moved_displacement[0] = 16;
  fields.moved_velocity[0] = 17;
}

int main(int argc, char** argv) {
  const int is_structure = strcmp(argv[1], "structure") == 0;
  talus_participant* self;
  must(talus_join(argv[argc - 1], is_structure ? TALUS_STRUCTURE : TALUS_PARTICLES, 20, &self));
  if (is_structure) {
    publish(self);
    declare_structure(self);
  } else {
    declare_particles(self, strcmp(argv[2], "free") == 0);
  }
  for (talus_command command = {.size = sizeof command};; must(talus_answer(self))) {
    must(talus_next(self, &command));
    if (command.action == TALUS_FINISH) return talus_leave(self), TALUS_OK;
    if (command.action == TALUS_ADVANCE)
      (is_structure ? compute_structure : compute_particles)(self, &command);
    if (command.action == TALUS_REPORT && is_structure) report(self, command.fields);
  }
}
