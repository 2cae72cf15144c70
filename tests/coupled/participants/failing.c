/* A structure of one node that fails in window 2, or before time 0, in the way its first argument names; failing.py
 * does the same. */
#include <string.h>

#include "coupler/c_api/talus.h"

static void complain(talus_participant* self) {
  const talus_complaint area = {.size = sizeof area,
                                .message = "is missing",
                                .file = "scene.yaml",
                                .line = 7,
                                .column = 3,
                                .key_path = "structure.area"};
  const talus_complaint net = {.size = sizeof net, .message = "scene.yaml: structure.solver: has no net"};
  talus_add_complaint(self, &net);
  talus_add_complaint(self, &area);
  talus_fail_config(self);
}

static void go_wrong(talus_participant* self, const char* how) {
  const talus_numerical_details error = {.size = sizeof error,
                                         .what = "velocity is not finite",
                                         .entity = "node 0",
                                         .step = 2,
                                         .time = 0.002,
                                         .value = 1e308 * 10};
  if (strcmp(how, "numerical") == 0) talus_fail_numerical(self, &error);
  if (strcmp(how, "machine") == 0) talus_fail_machine(self, "no room for the matrix");
  if (strcmp(how, "exception") == 0) talus_fail(self, "a bug of the solver");
}

int main(int argc, char** argv) {
  const double origin[3] = {0, 0, 0}, mass = 1;
  const talus_surface surface = {
      .size = sizeof surface, .nodes = 1, .positions = origin, .node_masses = &mass};
  const talus_declaration declaration = {.size = sizeof declaration, .program = "failing.c"};
  talus_command command = {.size = sizeof command};
  talus_participant* self;
  if (talus_join(argv[argc - 1], TALUS_STRUCTURE, 0, &self)) return TALUS_TRANSPORT_ERROR;
  if (strcmp(argv[1], "config") == 0) {
    complain(self);
    return talus_leave(self), TALUS_CONFIG_ERROR;
  }
  if (talus_publish_surface(self, &surface) || talus_declare(self, &declaration)) return TALUS_USAGE_ERROR;
  while (talus_next(self, &command) == TALUS_OK && command.action != TALUS_FINISH) {
    if (command.window == 2) {
      go_wrong(self, argv[1]);
      return talus_leave(self), TALUS_NUMERICAL_ERROR;
    }
    if (talus_answer(self)) return TALUS_USAGE_ERROR;
  }
  return talus_leave(self), TALUS_OK;
}
