/* A first structural solver: 25 free masses in a square, each on a spring to where it was at time 0.
 * The coupler starts it as `springs_c scene.yaml --join SEGMENT`; between the masses it spans triangles for
 * rocks to land on. */
#include <string.h>

#include "coupler/c_api/talus.h"

enum { side = 5, nodes = side * side, cells = (side - 1) * (side - 1) };
static const double mass = 10, stiffness = 2e4, spacing = 0.5; /* kg, N/m, m */

typedef struct {
  double displacement[3 * nodes], velocity[3 * nodes];
} state;

/* One step of the leapfrog: forces at its start, velocity from half a step before to half a step after. */
static void advance(state* s, const double* force, double step) {
  for (int i = 0; i < 3 * nodes; ++i) {
    s->velocity[i] += step * (force[i] - stiffness * s->displacement[i]) / mass;
    s->displacement[i] += step * s->velocity[i];
  }
}

int main(int argc, char** argv) {
  static double positions[3 * nodes], masses[nodes];
  static int32_t triangles[6 * cells];
  static state now, saved;
  for (int n = 0; n < nodes; ++n) {
    positions[3 * n] = spacing * (n % side);
    positions[3 * n + 1] = spacing * (n / side);
    masses[n] = mass;
  }
  for (int cell = 0; cell < cells; ++cell) {
    const int a = cell / (side - 1) * side + cell % (side - 1), b = a + 1, c = b + side, d = a + side;
    memcpy(triangles + 6 * cell, (int32_t[]){a, b, c, a, c, d}, 6 * sizeof *triangles);
  }
  const talus_surface surface = {.size = sizeof surface,
                                 .nodes = nodes,
                                 .positions = positions,
                                 .node_masses = masses,
                                 .triangles = 2 * cells,
                                 .triangle_nodes = triangles};
  const talus_limit limit = {
      .size = sizeof limit, .name = "springs", .seconds = 2 / 44.72, .reason = "2 sqrt(m/k)"};
  const talus_declaration declaration = {
      .size = sizeof declaration, .program = "springs.c", .checkpoints = 1};

  talus_participant* self;
  if (talus_join(argv[argc - 1], TALUS_STRUCTURE, 0, &self) || talus_publish_surface(self, &surface) ||
      talus_add_limit(self, &limit) || talus_add_probe(self, "middle.displacement_z_m", NULL) ||
      talus_declare(self, &declaration))
    return TALUS_TRANSPORT_ERROR; /* its text: talus_last_error() */
  talus_command command = {.size = sizeof command};
  talus_structure_fields fields = {.size = sizeof fields};
  for (; talus_next(self, &command) == TALUS_OK; talus_answer(self)) {
    double* probe;
    if (command.action == TALUS_FINISH) return talus_leave(self), TALUS_OK;
    if (talus_get_structure_fields(self, &fields) || talus_get_probes(self, &probe))
      return TALUS_TRANSPORT_ERROR;
    if (command.action == TALUS_ADVANCE) advance(&now, fields.force, command.length);
    if (command.action == TALUS_SAVE_STATE) saved = now;
    if (command.action == TALUS_RESTORE_STATE) now = saved;
    if (talus_checkpoint_state(&command, &now, sizeof now)) return TALUS_CONFIG_ERROR;
    if (command.action == TALUS_REPORT) *probe = now.displacement[3 * (nodes / 2) + 2];
    memcpy(fields.displacement, now.displacement, sizeof now.displacement);
    memcpy(fields.velocity, now.velocity, sizeof now.velocity);
  }
  return TALUS_TRANSPORT_ERROR;
}
