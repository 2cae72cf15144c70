"""Reads a result with ParaView's two XDMF readers and checks each number against what tests/support/moving_net.hpp writes.

Called with the program that writes the result and a folder, from ParaView's own Python (pvpython) or one with VTK. Debian's VTK is built without these
readers, its ParaView with them. Ends with 77 (skipped) where there are none.
"""
import subprocess
import sys

try:
    import vtkmodules.all as vtk
    from vtkmodules.util.numpy_support import vtk_to_numpy
except ImportError:
    sys.exit(77)


def leaves(data):
    """The grids of a tree of blocks, in order."""
    if data is None:
        return []
    if data.IsA("vtkMultiBlockDataSet"):
        return [leaf for i in range(data.GetNumberOfBlocks()) for leaf in leaves(data.GetBlock(i))]
    return [data]


def check(reader, path):
    reader.SetFileName(path)
    reader.UpdateInformation()
    key = vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    times = list(reader.GetOutputInformation(0).Get(key))
    assert times == [0.0, 0.1, 0.2], times
    for time in times:
        reader.UpdateTimeStep(time)
        grids = leaves(reader.GetOutputDataObject(0))
        assert [g.GetNumberOfPoints() for g in grids] == [4, 3], grids
        for grid in grids:
            check_grid(grid, frame=10 * time)


def check_grid(grid, frame):
    nodes = grid.GetNumberOfPoints()
    assert grid.GetNumberOfCells() == nodes - 1
    positions = vtk_to_numpy(grid.GetPoints().GetData()).ravel()
    assert abs(positions - [frame + i for i in range(3 * nodes)]).max() < 1e-6, positions
    displacement = vtk_to_numpy(grid.GetPointData().GetArray("displacement (m)"))
    assert displacement.shape == (nodes, 3) and abs(displacement - (1000 + frame)).max() < 1e-3, displacement
    force = vtk_to_numpy(grid.GetCellData().GetArray("axial_force (N)"))
    assert force.shape == (nodes - 1,) and abs(force - (2000 + frame)).max() < 1e-3, force
    for i in range(nodes - 1):
        points = grid.GetCell(i).GetPointIds()
        assert [points.GetId(k) for k in range(2)] == [i, i + 1]


readers = [getattr(vtk, name) for name in ("vtkXdmfReader", "vtkXdmf3Reader") if hasattr(vtk, name)]
if not readers:
    sys.exit(77)
program, folder = sys.argv[1:]
subprocess.run([program, folder], check=True)
for kind in readers:
    check(kind(), folder + "/fields.xdmf")
