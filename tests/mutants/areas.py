"""Which test programs guard which sources: the folders whose code is mutated, and the ninja targets that are built and run for each of them."""
import dataclasses
import pathlib


@dataclasses.dataclass(frozen=True)
class Area:
    name: str
    sources: tuple[str, ...]  # patterns below the repository's root
    tests: tuple[str, ...]  # programs of Catch2, which are ninja targets and files of bin/ of the same name

    def files(self, root: pathlib.Path) -> list[str]:
        found = {path.relative_to(root).as_posix() for pattern in self.sources for path in root.glob(pattern)}
        return sorted(path for path in found if path.endswith((".cpp", ".hpp")))


_PARTICLES = ("unit_dem_solver", "verification_particles")
_KERNELS = ("test_fem_batches", "test_fem_elements", "test_fem_axial", "test_structure_kernels")
AREAS = (
    Area("particles: contact", ("dem_solver/contact/*",), _PARTICLES),
    Area("particles: boundary", ("dem_solver/boundary/*",), _PARTICLES),
    Area("particles: integration", ("dem_solver/integration/*", "dem_solver/rocks/rotation.cpp"), _PARTICLES),
    Area("structure: elements", ("fem_solver/elements/*",), _KERNELS + ("test_fem_integration",)),
    Area("structure: materials", ("fem_solver/materials/*",), _KERNELS),
    Area("structure: constraints", ("fem_solver/constraints/*",), _KERNELS + ("test_fem_slides", "test_fem_integration", "verify_structure_statics")),
    Area("structure: integration", ("fem_solver/integration/*",),
         ("test_fem_integration", "test_fem_slides", "test_fem_scene", "verify_structure_explicit", "verify_structure_statics")),
    Area("coupling: acceleration", ("coupler/acceleration/*",), ("test_coupler_acceleration", "test_coupler_schemes", "test_coupler_restart")),
    Area("coupling: schemes", ("coupler/schemes/*",), ("test_coupler_schemes", "test_coupler_restart")),
    Area("coupling: work", ("coupler/work_meter.*",), ("test_coupler_run", "test_coupler_schemes")),
    Area("mapping", ("interface_mesh/closest_point.*", "interface_mesh/mapping.*", "interface_mesh/tie.cpp"), ("interface_mesh_mapping",)),
)
