#ifndef TALUS_C_API_H
#define TALUS_C_API_H

#include <stddef.h>
#include <stdint.h>

/* Taking part in a coupled run from C. The calls are those of coupler/participant.hpp and come in the same
 * order; docs/participants.md describes the contract. Units are SI, arrays hold x y z of each node in turn.
 *
 * Every call that can fail returns a talus_status; talus_message() then says what went wrong. No call throws,
 * exits or prints. */

#ifdef __cplusplus
extern "C" {
#endif

typedef struct talus_participant talus_participant;

typedef enum { TALUS_OK = 0, TALUS_USAGE_ERROR = 1, TALUS_TRANSPORT_ERROR = 3 } talus_status;
typedef enum { TALUS_STRUCTURE = 0, TALUS_PARTICLES = 1 } talus_role;
typedef enum {
  TALUS_ADVANCE = 0,
  TALUS_SAVE_STATE,
  TALUS_RESTORE_STATE,
  TALUS_REPORT,
  TALUS_WRITE_CHECKPOINT,
  TALUS_READ_CHECKPOINT,
  TALUS_FINISH
} talus_action;

typedef struct {
  talus_action action;
  int64_t window;
  double time;   /* s, of the window's start */
  double length; /* s */
} talus_command;

/* A surface of nodes and the segments between them, as one part. */
typedef struct {
  const char* part;
  size_t nodes;
  const double* positions; /* m, 3 a node */
  size_t segments;
  const int32_t* segment_nodes; /* 2 a segment */
} talus_surface;

/* Arrays in shared memory, 3 values a node; valid from the first talus_next() on. */
typedef struct {
  size_t nodes;
  const double* force;  /* N */
  double* displacement; /* m */
  double* velocity;     /* m/s */
} talus_structure_fields;
typedef struct {
  size_t nodes;
  const double* start_displacement;
  const double* start_velocity;
  const double* end_displacement; /* NULL where it is not needed */
  const double* end_velocity;     /* likewise */
  double* force;                  /* N, mean over the window */
} talus_particle_fields;

/* NULL where the segment cannot be joined; talus_message(NULL) says why. */
talus_participant* talus_join(const char* segment, talus_role role);
/* Ends the participation. */
void talus_leave(talus_participant* participant);
/* About the last call that failed; NULL: about the last talus_join() of this thread. */
const char* talus_message(const talus_participant* participant);

/* Structure: what it moves, and the mass of each node (kg). */
talus_status talus_publish_surface(talus_participant* participant, const talus_surface* surface,
                                   const double* node_masses);
/* Particles: the number of nodes of the boundary; positions and masses are then copied by talus_boundary().
 */
talus_status talus_receive_surface(talus_participant* participant, size_t* nodes);
talus_status talus_boundary(const talus_participant* participant, double* positions, double* node_masses);
/* The program's name, and its own step in s; 0: one step a window. */
talus_status talus_declare(talus_participant* participant, const char* program, double step);

/* Blocks, sleeping. */
talus_status talus_next(talus_participant* participant, talus_command* command);
talus_status talus_answer(talus_participant* participant);
/* Tells the coupler why this program cannot go on. */
void talus_fail(talus_participant* participant, const char* reason);

talus_status talus_get_structure_fields(talus_participant* participant, talus_structure_fields* fields);
talus_status talus_get_particle_fields(talus_participant* participant, talus_particle_fields* fields);

#ifdef __cplusplus
}
#endif

#endif
