#ifndef TALUS_C_API_TALUS_H
#define TALUS_C_API_TALUS_H

#include <stddef.h>
#include <stdint.h>

/* Take part in a coupled Talus run with a program in C, or in any language that can call C. Link with
 * libtalus_c, whose only symbols are these calls.
 *
 * The calls are those of coupler/participant.hpp, where the contract of each stands; docs/participants.md
 * tells the whole story and examples/participants/springs.c is a complete structural solver. Each call
 * returns TALUS_OK or says what is wrong; talus_last_error() then has the text. Nothing is thrown. A
 * participant belongs to one thread at a time. Units are SI; arrays hold three values a node, x y z of each
 * in turn, and nodes are counted from 0. Texts are UTF-8, end with a zero and are copied; one that may be
 * absent may be NULL.
 *
 * Every struct begins with its size, which the caller sets before the call, also of one that is filled:
 *
 *     talus_command command = {.size = sizeof command};
 *
 * So a program goes on working with later versions of the library, which may add members at the end: a
 * member that the program's header lacks counts as zero, which always means "as before". One that the library
 * does not know is refused unless it is zero. */

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
  TALUS_TRANSPORT_ERROR = 3, /* the coupler is gone, silent, or of another version */
  TALUS_NUMERICAL_ERROR = 4, /* talus_answer(): a value that was handed over is not finite */
  TALUS_MACHINE_ERROR = 7    /* memory or shared memory is missing */
} talus_result;

/* ---- Joining and the surface, before time 0 ---- */

/* `segment` is the text after --join; `timeout` in s without a sign of the coupler before a wait gives up,
 * 0: 60 s. */
talus_result talus_join(const char* segment, talus_role role, double timeout,
                        talus_participant** participant);

/* A run of segments and triangles that share contact properties. */
typedef struct {
  size_t size;
  const char* name;
  const char* material;               /* contact material of the particles; NULL: the scene's only one */
  double wire_radius;                 /* m; of its segments */
  int64_t segment_begin, segment_end; /* the first, and the one after the last */
  int64_t triangle_begin, triangle_end;
} talus_part;

typedef struct {
  size_t size;
  int64_t nodes;
  const double* positions;       /* m; 3 a node, at the reference state */
  const double* node_masses;     /* kg; 1 a node; infinite: held */
  int64_t segments;              /* wires and ropes */
  const int32_t* segment_nodes;  /* 2 a segment */
  int64_t triangles;             /* sheets */
  const int32_t* triangle_nodes; /* 3 a triangle, counter-clockwise seen from outside */
  const double* start;           /* m; displacement at time 0, 3 a node; NULL: none */
  int64_t parts;                 /* filled in a received one: how many talus_get_part() has */
} talus_surface;

/* Structure: parts first, in the order of their cells; without any the surface is one part. */
talus_result talus_add_part(talus_participant* structure, const talus_part* part);
talus_result talus_publish_surface(talus_participant* structure, const talus_surface* surface);
/* Particles: blocks until the structure has published. Valid until talus_leave(). */
talus_result talus_receive_surface(talus_participant* particles, talus_surface* boundary);
talus_result talus_get_part(talus_participant* particles, int64_t index, talus_part* part);

/* ---- What it says of itself, before time 0: first what is added, in any number, then talus_declare() ---- */

/* A limit of the solver's step, as `talus check` lists it. */
typedef struct {
  size_t size;
  const char* name;   /* "contact dashpot on node masses" */
  double seconds;     /* the largest step that keeps it */
  int only_accuracy;  /* 1: exceeding it costs accuracy, a warning; 0: it is a limit of stability */
  const char* reason; /* the formula and what sets it */
} talus_limit;

/* An effect of the program, as `talus explain` lists it. The last four are for advice and may be absent. */
typedef struct {
  size_t size;
  const char* name;        /* "friction" */
  int present;             /* 1: it acts in this run */
  const char* reason;      /* what in the scene names it, or what would have to */
  const char* key;         /* of the scene, which names it */
  const char* ledger_line; /* whose energy appears where it acts */
  int may_hold;            /* 1: it may act without doing work, as friction that holds a block */
  const char*
      limit; /* what is exceeded where it is missing: a step limit's name, or "compression of GROUP" */
} talus_effect;

/* How a ledger line enters  stored + dissipated - supplied = constant.  A memo is only shown. */
typedef enum { TALUS_STORED, TALUS_DISSIPATED, TALUS_SUPPLIED, TALUS_MEMO } talus_ledger_kind;

/* Cells of one kind that are drawn together. */
typedef struct {
  size_t size;
  const char* name; /* "net" */
  int64_t nodes;
  int corners; /* nodes of a cell: 1 point, 2 segment, 3 triangle */
  int64_t cells;
  const int64_t* cell_nodes; /* `corners` a cell */
} talus_group;

typedef enum { TALUS_AT_NODES, TALUS_AT_CELLS } talus_location;

/* Values of a group, written with every frame. */
typedef struct {
  size_t size;
  int64_t group;    /* which was added as this number, from 0 */
  const char* name; /* "displacement" */
  const char* unit; /* "m" */
  int components;   /* 1 to 9 */
  talus_location location;
} talus_field;

/* Events only become more and are written to NAME.csv; a distribution has rows whose values change, and stands
 * in the summary. */
typedef enum { TALUS_EVENTS, TALUS_DISTRIBUTION } talus_table_kind;
typedef struct {
  size_t size;
  const char* name; /* "below" */
  talus_table_kind kind;
  int64_t columns;
  const char* const* column_names; /* "time_s" */
  int64_t capacity;                /* most rows it will ever have */
  const char* const* row_names;    /* of a distribution, `capacity` of them; NULL: they are numbered */
} talus_table;

talus_result talus_add_limit(talus_participant* participant, const talus_limit* limit);
talus_result talus_add_effect(talus_participant* participant, const talus_effect* effect);
/* A column of probes.csv, "middle.displacement_z_m"; `watches` says what stands for the point: "node 12". */
talus_result talus_add_probe(talus_participant* participant, const char* name, const char* watches);
/* A column of energy.csv in J, "structure.kinetic_J". */
talus_result talus_add_ledger_line(talus_participant* participant, const char* name, talus_ledger_kind kind);
talus_result talus_add_group(talus_participant* participant, const talus_group* group);
talus_result talus_add_field(talus_participant* participant, const talus_field* field);
talus_result talus_add_table(talus_participant* participant, const talus_table* table);
/* A number that is known before time 0, for the summary. */
talus_result talus_add_fact(talus_participant* participant, const char* name, double value);
/* For log.txt and the summary. */
talus_result talus_add_warning(talus_participant* participant, const char* text);

typedef struct {
  size_t size;
  const char* program; /* "mine 1.0" */
  double step;         /* s; its own step inside a window; 0: one step a window, whatever its length */
  int insists_on_step; /* 1: the scene allows a step above a stability limit; 0: it is refused before time 0 */
  int force_is_load;   /* structure; 1: the force is a load over the window (implicit methods); 0: it kicks at
                          the start of each step (leapfrog) */
  int checkpoints;     /* 1: it answers TALUS_WRITE_CHECKPOINT and TALUS_READ_CHECKPOINT */
  int loses_cells;     /* structure; 1: cells may break, it fills `lost` */
  int free_velocity;   /* structure: 1: it can fill `free_velocity`; particles: 1: they need it */
  int light_boundary;  /* particles; 1: they can fill `moved_displacement` and `moved_velocity` */
} talus_declaration;

talus_result talus_declare(talus_participant* participant, const talus_declaration* declaration);

/* ---- The run ---- */

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
  size_t size;
  talus_action action;
  int fields;            /* report: field frames are wanted too */
  int64_t window;        /* from 0 */
  int32_t iteration;     /* of a strong scheme, from 0 */
  int tentative;         /* advance: the window may be taken back; its work is booked by the coupler */
  double time;           /* s; the start of the window */
  double length;         /* s; of the window */
  double regular_length; /* s; of a window in which nothing makes the coupler choose another */
  double force_shift; /* s; advance of particles: how much earlier than the window the mean of the forces is
                            wanted */
  const char* path;   /* of a checkpoint; valid until the next talus_next() */
} talus_command;

/* Blocks, sleeping. */
talus_result talus_next(talus_participant* participant, talus_command* command);
/* Ends the command: the coupler reads the arrays from here on. */
talus_result talus_answer(talus_participant* participant);

typedef struct {
  size_t size;
  const double* force; /* N; mean over the window; of a leapfrog, over the window moved back by half a step */
  double* displacement;  /* m; the present state at every answer */
  double* velocity;      /* m/s; likewise (explicit leapfrog: half a step before) */
  double* free_velocity; /* m/s; a step after `velocity` if no interface force acted; NULL: not needed */
  double* lost;          /* 1 for each broken cell, segments before triangles, else 0; NULL: not declared */
} talus_structure_fields;

/* The end arrays are NULL where both sides take one step a window and none needs the other's end. */
typedef struct {
  size_t size;
  const double* start_displacement; /* m; of the boundary at the window's start */
  const double* start_velocity;     /* m/s */
  const double* end_displacement;   /* m */
  const double* end_velocity;       /* m/s */
  double* force; /* N; that the boundary receives, mean over the window moved back by the command's
                    force_shift */
  const double* free_velocity; /* m/s; a step after the start if nothing touched it; NULL: not asked for */
  double* moved_displacement;  /* m; at the end, if each node besides answers to its contact forces; NULL: not
                                 needed */
  double* moved_velocity;      /* m/s; likewise */
  const double* lost; /* 1 for each cell that is gone, segments before triangles; NULL: none can be */
} talus_particle_fields;

/* Valid from the first talus_next() on, until talus_leave(). */
talus_result talus_get_structure_fields(talus_participant* structure, talus_structure_fields* fields);
talus_result talus_get_particle_fields(talus_participant* particles, talus_particle_fields* fields);

/* Where a report puts its values, each in the order in which its kind was added. Likewise valid. */
talus_result talus_get_probes(talus_participant* participant, double** values);
talus_result talus_get_ledger(talus_participant* participant, double** joules);
/* Current positions of a group, 3 a node (m), and a field of it; where command.fields is set. */
talus_result talus_get_positions(talus_participant* participant, int64_t group, double** positions);
talus_result talus_get_field(talus_participant* participant, int64_t group, int64_t field, double** values);
/* Room for all rows a table may have, the columns of each in turn, and how many it has. */
talus_result talus_get_table(talus_participant* participant, int64_t table, double** values, double** rows);

/* Optional. How often all forces were evaluated since the start, for the summary; between talus_next() and
 * talus_answer(). */
talus_result talus_tell_force_evaluations(talus_participant* participant, int64_t since_start);
/* Optional. The work (J) of the window's forces on this side's surface, between an advance and its answer; of
 * a side that does not tell it is summed from forces and displacements. */
talus_result talus_book_work(talus_participant* participant, double of_this_window);

/* Answers TALUS_WRITE_CHECKPOINT and TALUS_READ_CHECKPOINT for a state that is one block of memory without
 * pointers; does nothing for other commands. Others write what they like to command.path; where the system
 * refuses the file they answer without one, and the run goes on without this checkpoint. */
talus_result talus_checkpoint_state(const talus_command* command, void* state, size_t bytes);

/* ---- The end ---- */

/* Each of these says why the participant cannot go on; the coupler stops the run and shows it. Then leave. */

/* An error of the program itself. */
void talus_fail(talus_participant* participant, const char* reason);

/* The scene is wrong: all complaints that were added, shown beside those of the coupler. Before time 0. */
typedef struct {
  size_t size;
  const char* message;  /* one sentence: what is wrong, the value, what was expected */
  const char* file;     /* the scene's; NULL: the message stands alone */
  int line, column;     /* from 1; 0: the file, the line as a whole */
  const char* key_path; /* "structure.parts.net.area" */
} talus_complaint;
talus_result talus_add_complaint(talus_participant* participant, const talus_complaint* complaint);
void talus_fail_config(talus_participant* participant);

/* The computation broke down. */
typedef struct {
  size_t size;
  const char* what;   /* "displacement is not finite" */
  const char* entity; /* "node 17 of net" */
  int64_t step;
  double time;  /* s */
  double value; /* of `what`, in its SI unit */
} talus_numerical_details;
void talus_fail_numerical(talus_participant* participant, const talus_numerical_details* error);

/* The machine does not give what the program needs: memory, a file. */
void talus_fail_machine(talus_participant* participant, const char* reason);

void talus_leave(talus_participant* participant);

/* What the last call of this thread that did not return TALUS_OK had to say. */
const char* talus_last_error(void);

#ifdef __cplusplus
}
#endif

#endif
