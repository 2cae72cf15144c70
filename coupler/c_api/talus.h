#ifndef TALUS_C_API_TALUS_H
#define TALUS_C_API_TALUS_H

#include <stddef.h>
#include <stdint.h>

/* Take part in a coupled Talus run with a program in C, or in any language that can call C. Link with
 * libtalus_c.
 *
 * The calls are those of coupler/participant.hpp, where the contract of each stands; docs/participants.md
 * tells the whole story and examples/participants/springs.c is a complete structural solver. Each call
 * returns TALUS_OK or says what is wrong; talus_last_error() then has the text. Nothing is thrown. A
 * participant belongs to one thread at a time. Units are SI; arrays hold three values a node, x y z of each
 * in turn. */

#ifdef __cplusplus
extern "C" {
#endif

typedef struct talus_participant talus_participant;

typedef enum { TALUS_STRUCTURE = 0, TALUS_PARTICLES = 1 } talus_role;

/* Also the exit codes a program should end with. */
typedef enum {
  TALUS_OK = 0,
  TALUS_USAGE_ERROR = 1, /* a call out of order or with wrong arguments */
  TALUS_CONFIG_ERROR = 2,
  TALUS_TRANSPORT_ERROR = 3 /* the coupler is gone, silent, or of another version */
} talus_result;

typedef enum {
  TALUS_ADVANCE,
  TALUS_SAVE_STATE,
  TALUS_RESTORE_STATE,
  TALUS_REPORT,
  TALUS_WRITE_CHECKPOINT,
  TALUS_READ_CHECKPOINT,
  TALUS_FINISH
} talus_action;

typedef struct {
  talus_action action;
  int fields;        /* report: field frames are wanted too */
  int64_t window;    /* from 0 */
  int32_t iteration; /* of a strong scheme, from 0 */
  double time;       /* s; the start of the window */
  double length;     /* s; of the window */
  double
      force_shift; /* s; advance of particles: how much earlier than the window the mean of the forces is wanted */
  const char* path; /* of a checkpoint; valid until the next talus_next() */
} talus_command;

typedef struct {
  int64_t nodes;
  const double* positions;       /* m; 3 a node, at the reference state */
  const double* node_masses;     /* kg; 1 a node */
  int64_t segments;              /* wires and ropes */
  const int32_t* segment_nodes;  /* 2 a segment */
  int64_t triangles;             /* sheets */
  const int32_t* triangle_nodes; /* 3 a triangle, counter-clockwise seen from outside */
} talus_surface;

typedef struct {
  const char* program;      /* "mine 1.0" */
  double step;              /* s; its own step inside a window; 0: one step a window */
  double stable_step;       /* s; the largest stable step; 0: no limit */
  int64_t probes;           /* columns of probes.csv */
  const char** probe_names; /* "middle.displacement_z_m" */
  int checkpoints;          /* 1: it answers TALUS_WRITE_CHECKPOINT and TALUS_READ_CHECKPOINT */
  int force_is_load; /* structure; 1: the force is a load over the window (implicit methods); 0: it kicks at
                               the start of each step (leapfrog) */
} talus_declaration;

typedef struct {
  const double* force; /* N; mean over the window; of a leapfrog, over the window moved back by half a step */
  double* displacement; /* m; the present state at every answer */
  double* velocity;     /* m/s; likewise (explicit leapfrog: half a step before) */
} talus_structure_fields;

/* The end arrays are NULL where both sides take one step a window and none needs the other's end. */
typedef struct {
  const double* start_displacement; /* m; of the boundary at the window's start */
  const double* start_velocity;     /* m/s */
  const double* end_displacement;   /* m */
  const double* end_velocity;       /* m/s */
  double*
      force; /* N; that the boundary receives, mean over the window moved back by the command's force_shift */
} talus_particle_fields;

/* Before time 0, in this order. `segment` is the text after --join. */
talus_result talus_join(const char* segment, talus_role role, talus_participant** participant);
talus_result talus_publish_surface(talus_participant* structure, const talus_surface* surface);
talus_result talus_receive_surface(talus_participant* particles,
                                   talus_surface* boundary); /* valid until talus_leave() */
talus_result talus_declare(talus_participant* participant, const talus_declaration* declaration);

talus_result talus_next(talus_participant* participant, talus_command* command);
talus_result talus_answer(talus_participant* participant);

/* Valid from the first talus_next() on, until talus_leave(). */
talus_result talus_get_structure_fields(talus_participant* structure, talus_structure_fields* fields);
talus_result talus_get_particle_fields(talus_participant* particles, talus_particle_fields* fields);
talus_result talus_get_probes(talus_participant* participant, double** values); /* where a report puts them */

/* Answers TALUS_WRITE_CHECKPOINT and TALUS_READ_CHECKPOINT for a state that is one block of memory without
 * pointers; does nothing for other commands. Others write what they like to command.path. */
talus_result talus_checkpoint_state(const talus_command* command, void* state, size_t bytes);

/* Says why the participant cannot go on; the coupler stops the run and shows the text. */
void talus_fail(talus_participant* participant, const char* reason);
void talus_leave(talus_participant* participant);

/* What the last call of this thread that did not return TALUS_OK had to say. */
const char* talus_last_error(void);

#ifdef __cplusplus
}
#endif

#endif
