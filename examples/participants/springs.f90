! A first structural solver: 25 free masses in a square, each on a spring to where it was at time 0.
! The coupler starts it as `springs_f90 scene.yaml --join SEGMENT`; between the masses it spans triangles for rocks to land on.
program springs
  use, intrinsic :: iso_c_binding
  use talus
  implicit none
  integer, parameter :: side = 5, nodes = side * side, middle = 13, cells = (side - 1)**2
  real(c_double), parameter :: mass = 10, stiffness = 2e4_c_double, spacing = 0.5_c_double  ! kg, N/m, m
  real(c_double), target :: positions(3, nodes) = 0, masses(nodes) = mass, now(3, nodes, 2) = 0  ! displacement, velocity
  real(c_double) :: saved(3, nodes, 2) = 0
  integer(c_int32_t), target :: triangles(3, 2 * cells)
  integer :: n, cell, a
  type(c_ptr) :: self
  character(len=256) :: segment
  type(talus_surface) :: surface
  type(talus_limit) :: limit
  type(talus_declaration) :: declaration

  do n = 0, nodes - 1
    positions(1:2, n + 1) = spacing * [mod(n, side), n / side]
  end do
  do cell = 0, cells - 1
    a = cell / (side - 1) * side + mod(cell, side - 1)
    triangles(:, 2 * cell + 1) = [a, a + 1, a + 1 + side]
    triangles(:, 2 * cell + 2) = [a, a + 1 + side, a + side]
  end do
  surface = talus_surface(size=c_sizeof(surface), nodes=nodes, positions=c_loc(positions), node_masses=c_loc(masses), &
                          triangles=2 * cells, triangle_nodes=c_loc(triangles))
  limit = talus_limit(size=c_sizeof(limit), name=talus_text("springs"), seconds=2 * sqrt(mass / stiffness), &
                      reason=talus_text("2 sqrt(m/k)"))
  declaration = talus_declaration(size=c_sizeof(declaration), program=talus_text("springs.f90"), checkpoints=1)

  call get_command_argument(command_argument_count(), segment)
  call must(talus_join(trim(segment) // c_null_char, TALUS_STRUCTURE, 0.0_c_double, self))
  call must(talus_publish_surface(self, surface))
  call must(talus_add_limit(self, limit))
  call must(talus_add_probe(self, "middle.displacement_z_m" // c_null_char, c_null_char))
  call must(talus_declare(self, declaration))
  call serve()
  call talus_leave(self)

contains

  subroutine serve()
    type(talus_command) :: command
    type(talus_structure_fields) :: fields
    type(c_ptr) :: probes
    real(c_double), pointer :: force(:, :), displacement(:, :), velocity(:, :), probe
    command%size = c_sizeof(command)
    fields%size = c_sizeof(fields)
    call must(talus_next(self, command))
    call must(talus_get_structure_fields(self, fields))
    call must(talus_get_probes(self, probes))
    call c_f_pointer(fields%force, force, [3, nodes])
    call c_f_pointer(fields%displacement, displacement, [3, nodes])
    call c_f_pointer(fields%velocity, velocity, [3, nodes])
    call c_f_pointer(probes, probe)
    do while (command%action /= TALUS_FINISH)
      select case (command%action)
      case (TALUS_ADVANCE)  ! one step of the leapfrog: velocity from half a step before the window to half a step after
        now(:, :, 2) = now(:, :, 2) + command%length * (force - stiffness * now(:, :, 1)) / mass
        now(:, :, 1) = now(:, :, 1) + command%length * now(:, :, 2)
      case (TALUS_SAVE_STATE)
        saved = now
      case (TALUS_RESTORE_STATE)
        now = saved
      case (TALUS_REPORT)
        probe = now(3, middle, 1)
      end select
      call must(talus_checkpoint_state(command, c_loc(now), c_sizeof(now)))
      displacement = now(:, :, 1)
      velocity = now(:, :, 2)
      call must(talus_answer(self))
      call must(talus_next(self, command))
    end do
  end subroutine

  subroutine must(outcome)
    integer(c_int), intent(in) :: outcome
    if (outcome == TALUS_OK) return
    write (*, "(a)") talus_string(talus_last_error())
    stop 3
  end subroutine
end program
