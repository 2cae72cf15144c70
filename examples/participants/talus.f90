!> Take part in a coupled Talus run with a program in Fortran: the calls of coupler/c_api/talus.h, under the same names.
!>
!> What each call and member means stands in talus.h; springs.f90 is a complete structural solver. A function's result is
!> TALUS_OK or says what is wrong, and talus_string(talus_last_error()) has the text. Nodes are counted from 0.
!> Two things are Fortran's own: a struct's size is set by `limit%size = c_sizeof(limit)`, and a text in a struct by `limit%name = talus_text("springs")`.
!> Arrays of the interface arrive as pointers: `call c_f_pointer(fields%force, force, [3, nodes])`.
module talus
  use, intrinsic :: iso_c_binding
  implicit none

  enum, bind(C)  ! talus_role
    enumerator :: TALUS_STRUCTURE = 0, TALUS_PARTICLES = 1
  end enum

  enum, bind(C)  ! talus_result
    enumerator :: TALUS_OK = 0, TALUS_USAGE_ERROR = 1, TALUS_CONFIG_ERROR = 2, &
      TALUS_TRANSPORT_ERROR = 3, TALUS_NUMERICAL_ERROR = 4, TALUS_MACHINE_ERROR = 7
  end enum

  enum, bind(C)  ! talus_ledger_kind
    enumerator :: TALUS_STORED, TALUS_DISSIPATED, TALUS_SUPPLIED, TALUS_MEMO
  end enum

  enum, bind(C)  ! talus_location
    enumerator :: TALUS_AT_NODES, TALUS_AT_CELLS
  end enum

  enum, bind(C)  ! talus_table_kind
    enumerator :: TALUS_EVENTS, TALUS_DISTRIBUTION
  end enum

  enum, bind(C)  ! talus_action
    enumerator :: TALUS_ADVANCE, TALUS_SAVE_STATE, TALUS_RESTORE_STATE, TALUS_REPORT, &
      TALUS_WRITE_CHECKPOINT, TALUS_READ_CHECKPOINT, TALUS_FINISH
  end enum

  type, bind(C) :: talus_part
    integer(c_size_t) :: size = 0
    type(c_ptr) :: name = c_null_ptr
    type(c_ptr) :: material = c_null_ptr
    real(c_double) :: wire_radius = 0.0_c_double
    integer(c_int64_t) :: segment_begin = 0, segment_end = 0
    integer(c_int64_t) :: triangle_begin = 0, triangle_end = 0
  end type

  type, bind(C) :: talus_surface
    integer(c_size_t) :: size = 0
    integer(c_int64_t) :: nodes = 0
    type(c_ptr) :: positions = c_null_ptr
    type(c_ptr) :: node_masses = c_null_ptr
    integer(c_int64_t) :: segments = 0
    type(c_ptr) :: segment_nodes = c_null_ptr
    integer(c_int64_t) :: triangles = 0
    type(c_ptr) :: triangle_nodes = c_null_ptr
    type(c_ptr) :: start = c_null_ptr
    integer(c_int64_t) :: parts = 0
  end type

  type, bind(C) :: talus_limit
    integer(c_size_t) :: size = 0
    type(c_ptr) :: name = c_null_ptr
    real(c_double) :: seconds = 0.0_c_double
    integer(c_int) :: only_accuracy = 0
    type(c_ptr) :: reason = c_null_ptr
  end type

  type, bind(C) :: talus_effect
    integer(c_size_t) :: size = 0
    type(c_ptr) :: name = c_null_ptr
    integer(c_int) :: present = 0
    type(c_ptr) :: reason = c_null_ptr
    type(c_ptr) :: key = c_null_ptr
    type(c_ptr) :: ledger_line = c_null_ptr
    integer(c_int) :: may_hold = 0
    type(c_ptr) :: limit = c_null_ptr
  end type

  type, bind(C) :: talus_group
    integer(c_size_t) :: size = 0
    type(c_ptr) :: name = c_null_ptr
    integer(c_int64_t) :: nodes = 0
    integer(c_int) :: corners = 0
    integer(c_int64_t) :: cells = 0
    type(c_ptr) :: cell_nodes = c_null_ptr
  end type

  type, bind(C) :: talus_field
    integer(c_size_t) :: size = 0
    integer(c_int64_t) :: group = 0
    type(c_ptr) :: name = c_null_ptr
    type(c_ptr) :: unit = c_null_ptr
    integer(c_int) :: components = 0
    integer(c_int) :: location = 0
  end type

  type, bind(C) :: talus_table
    integer(c_size_t) :: size = 0
    type(c_ptr) :: name = c_null_ptr
    integer(c_int) :: kind = 0
    integer(c_int64_t) :: columns = 0
    type(c_ptr) :: column_names = c_null_ptr
    integer(c_int64_t) :: capacity = 0
    type(c_ptr) :: row_names = c_null_ptr
  end type

  type, bind(C) :: talus_declaration
    integer(c_size_t) :: size = 0
    type(c_ptr) :: program = c_null_ptr
    real(c_double) :: step = 0.0_c_double
    integer(c_int) :: insists_on_step = 0
    integer(c_int) :: force_is_load = 0
    integer(c_int) :: checkpoints = 0
    integer(c_int) :: loses_cells = 0
    integer(c_int) :: free_velocity = 0
    integer(c_int) :: light_boundary = 0
  end type

  type, bind(C) :: talus_command
    integer(c_size_t) :: size = 0
    integer(c_int) :: action = 0
    integer(c_int) :: fields = 0
    integer(c_int64_t) :: window = 0
    integer(c_int32_t) :: iteration = 0
    integer(c_int) :: tentative = 0
    real(c_double) :: time = 0.0_c_double
    real(c_double) :: length = 0.0_c_double
    real(c_double) :: regular_length = 0.0_c_double
    real(c_double) :: force_shift = 0.0_c_double
    type(c_ptr) :: path = c_null_ptr
  end type

  type, bind(C) :: talus_structure_fields
    integer(c_size_t) :: size = 0
    type(c_ptr) :: force = c_null_ptr
    type(c_ptr) :: displacement = c_null_ptr
    type(c_ptr) :: velocity = c_null_ptr
    type(c_ptr) :: free_velocity = c_null_ptr
    type(c_ptr) :: lost = c_null_ptr
  end type

  type, bind(C) :: talus_particle_fields
    integer(c_size_t) :: size = 0
    type(c_ptr) :: start_displacement = c_null_ptr
    type(c_ptr) :: start_velocity = c_null_ptr
    type(c_ptr) :: end_displacement = c_null_ptr
    type(c_ptr) :: end_velocity = c_null_ptr
    type(c_ptr) :: force = c_null_ptr
    type(c_ptr) :: free_velocity = c_null_ptr
    type(c_ptr) :: moved_displacement = c_null_ptr
    type(c_ptr) :: moved_velocity = c_null_ptr
    type(c_ptr) :: lost = c_null_ptr
  end type

  type, bind(C) :: talus_complaint
    integer(c_size_t) :: size = 0
    type(c_ptr) :: message = c_null_ptr
    type(c_ptr) :: file = c_null_ptr
    integer(c_int) :: line = 0, column = 0
    type(c_ptr) :: key_path = c_null_ptr
  end type

  type, bind(C) :: talus_numerical_details
    integer(c_size_t) :: size = 0
    type(c_ptr) :: what = c_null_ptr
    type(c_ptr) :: entity = c_null_ptr
    integer(c_int64_t) :: step = 0
    real(c_double) :: time = 0.0_c_double
    real(c_double) :: value = 0.0_c_double
  end type

  interface
    function talus_join(segment, role, timeout, participant) bind(C) result(outcome)
      import
      character(kind=c_char), intent(in) :: segment(*)
      integer(c_int), value :: role
      real(c_double), value :: timeout
      type(c_ptr), intent(out) :: participant
      integer(c_int) :: outcome
    end function
    function talus_add_part(structure, part) bind(C) result(outcome)
      import
      type(c_ptr), value :: structure
      type(talus_part), intent(in) :: part
      integer(c_int) :: outcome
    end function
    function talus_publish_surface(structure, surface) bind(C) result(outcome)
      import
      type(c_ptr), value :: structure
      type(talus_surface), intent(in) :: surface
      integer(c_int) :: outcome
    end function
    function talus_receive_surface(particles, boundary) bind(C) result(outcome)
      import
      type(c_ptr), value :: particles
      type(talus_surface), intent(inout) :: boundary
      integer(c_int) :: outcome
    end function
    function talus_get_part(particles, index, part) bind(C) result(outcome)
      import
      type(c_ptr), value :: particles
      integer(c_int64_t), value :: index
      type(talus_part), intent(inout) :: part
      integer(c_int) :: outcome
    end function
    function talus_add_limit(participant, limit) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      type(talus_limit), intent(in) :: limit
      integer(c_int) :: outcome
    end function
    function talus_add_effect(participant, effect) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      type(talus_effect), intent(in) :: effect
      integer(c_int) :: outcome
    end function
    function talus_add_probe(participant, name, watches) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      character(kind=c_char), intent(in) :: name(*)
      character(kind=c_char), intent(in) :: watches(*)
      integer(c_int) :: outcome
    end function
    function talus_add_ledger_line(participant, name, kind) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int), value :: kind
      integer(c_int) :: outcome
    end function
    function talus_add_group(participant, group) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      type(talus_group), intent(in) :: group
      integer(c_int) :: outcome
    end function
    function talus_add_field(participant, field) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      type(talus_field), intent(in) :: field
      integer(c_int) :: outcome
    end function
    function talus_add_table(participant, table) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      type(talus_table), intent(in) :: table
      integer(c_int) :: outcome
    end function
    function talus_add_fact(participant, name, value) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), value :: value
      integer(c_int) :: outcome
    end function
    function talus_add_warning(participant, text) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      character(kind=c_char), intent(in) :: text(*)
      integer(c_int) :: outcome
    end function
    function talus_declare(participant, declaration) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      type(talus_declaration), intent(in) :: declaration
      integer(c_int) :: outcome
    end function
    function talus_next(participant, command) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      type(talus_command), intent(inout) :: command
      integer(c_int) :: outcome
    end function
    function talus_answer(participant) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      integer(c_int) :: outcome
    end function
    function talus_get_structure_fields(structure, fields) bind(C) result(outcome)
      import
      type(c_ptr), value :: structure
      type(talus_structure_fields), intent(inout) :: fields
      integer(c_int) :: outcome
    end function
    function talus_get_particle_fields(particles, fields) bind(C) result(outcome)
      import
      type(c_ptr), value :: particles
      type(talus_particle_fields), intent(inout) :: fields
      integer(c_int) :: outcome
    end function
    function talus_get_probes(participant, values) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      type(c_ptr), intent(out) :: values
      integer(c_int) :: outcome
    end function
    function talus_get_ledger(participant, joules) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      type(c_ptr), intent(out) :: joules
      integer(c_int) :: outcome
    end function
    function talus_get_positions(participant, group, positions) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      integer(c_int64_t), value :: group
      type(c_ptr), intent(out) :: positions
      integer(c_int) :: outcome
    end function
    function talus_get_field(participant, group, field, values) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      integer(c_int64_t), value :: group
      integer(c_int64_t), value :: field
      type(c_ptr), intent(out) :: values
      integer(c_int) :: outcome
    end function
    function talus_get_table(participant, table, values, rows) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      integer(c_int64_t), value :: table
      type(c_ptr), intent(out) :: values
      type(c_ptr), intent(out) :: rows
      integer(c_int) :: outcome
    end function
    function talus_tell_force_evaluations(participant, since_start) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      integer(c_int64_t), value :: since_start
      integer(c_int) :: outcome
    end function
    function talus_book_work(participant, of_this_window) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      real(c_double), value :: of_this_window
      integer(c_int) :: outcome
    end function
    function talus_checkpoint_state(command, state, bytes) bind(C) result(outcome)
      import
      type(talus_command), intent(in) :: command
      type(c_ptr), value :: state
      integer(c_size_t), value :: bytes
      integer(c_int) :: outcome
    end function
    subroutine talus_fail(participant, reason) bind(C)
      import
      type(c_ptr), value :: participant
      character(kind=c_char), intent(in) :: reason(*)
    end subroutine
    function talus_add_complaint(participant, complaint) bind(C) result(outcome)
      import
      type(c_ptr), value :: participant
      type(talus_complaint), intent(in) :: complaint
      integer(c_int) :: outcome
    end function
    subroutine talus_fail_config(participant) bind(C)
      import
      type(c_ptr), value :: participant
    end subroutine
    subroutine talus_fail_numerical(participant, error) bind(C)
      import
      type(c_ptr), value :: participant
      type(talus_numerical_details), intent(in) :: error
    end subroutine
    subroutine talus_fail_machine(participant, reason) bind(C)
      import
      type(c_ptr), value :: participant
      character(kind=c_char), intent(in) :: reason(*)
    end subroutine
    subroutine talus_leave(participant) bind(C)
      import
      type(c_ptr), value :: participant
    end subroutine
    function talus_last_error() bind(C) result(text)
      import
      type(c_ptr) :: text
    end function
  end interface

contains

  !> A text as a member of a struct holds it. It is kept as long as the program runs: for the few texts said before time 0.
  function talus_text(text) result(pointer)
    character(len=*), intent(in) :: text
    type(c_ptr) :: pointer
    character(kind=c_char), pointer :: kept(:)
    integer :: i
    allocate (kept(len(text) + 1))
    do i = 1, len(text)
      kept(i) = text(i:i)
    end do
    kept(len(text) + 1) = c_null_char
    pointer = c_loc(kept)
  end function

  !> A text of the library as Fortran holds it, such as that of talus_last_error() or of command%path.
  function talus_string(pointer) result(text)
    type(c_ptr), intent(in) :: pointer
    character(len=:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer, parameter :: longest = 65536
    integer :: i
    text = ""
    if (.not. c_associated(pointer)) return
    call c_f_pointer(pointer, letters, [longest])
    do i = 1, longest
      if (letters(i) == c_null_char) return
      text = text // letters(i)
    end do
  end function

end module
