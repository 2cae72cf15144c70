/* A structural solver in C: one mass on a spring to the ground, in a leapfrog.    spring_structure SCENE
 * --join SEGMENT */

#include <stdio.h>

#include "coupler/c_api/talus.h"

static int give_up(talus_participant* participant) {
  fprintf(stderr, "%s\n", talus_message(participant));
  talus_leave(participant);
  return TALUS_TRANSPORT_ERROR;
}

int main(int argc, char** argv) {
  const double mass = 2, stiffness = 300, origin[3] = {0, 0, 0};
  const talus_surface surface = {"node", 1, origin, 0, NULL};
  double u[3] = {0, 0, 0}, v[3] = {0, 0, 0}, saved_u[3] = {0, 0, 0}, saved_v[3] = {0, 0, 0};
  talus_participant* participant = talus_join(argv[argc - 1], TALUS_STRUCTURE);
  if (participant == NULL) return give_up(NULL);
  if (talus_publish_surface(participant, &surface, &mass) != TALUS_OK) return give_up(participant);
  if (talus_declare(participant, "spring in C", 0) != TALUS_OK) return give_up(participant);
  for (;;) {
    talus_command command;
    talus_structure_fields fields;
    if (talus_next(participant, &command) != TALUS_OK) return give_up(participant);
    if (command.action == TALUS_FINISH) break;
    talus_get_structure_fields(participant, &fields);
    for (int i = 0; i < 3; ++i) {
      if (command.action == TALUS_SAVE_STATE) saved_u[i] = u[i], saved_v[i] = v[i];
      if (command.action == TALUS_RESTORE_STATE) u[i] = saved_u[i], v[i] = saved_v[i];
      if (command.action == TALUS_ADVANCE) {
        v[i] += command.length * ((fields.force[i] - stiffness * u[i]) / mass);
        u[i] += command.length * v[i];
      }
      fields.displacement[i] = u[i];
      fields.velocity[i] = v[i];
    }
    talus_answer(participant);
  }
  talus_leave(participant);
  return 0;
}
