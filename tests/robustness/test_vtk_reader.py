#!/usr/bin/env python3
"""Runs a shipped case and opens its last snapshot with VTK's own reader.

The program is found in $BOLIDE, the repository in $BOLIDE_SOURCE_DIR. What VTK reads must be a grid
of vertices with the fields that the case has, and agree with the last row of history.csv.
"""
import csv
import glob
import json
import math
import os
import subprocess
import sys
import tempfile

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

VERTEX = 1
HIDDEN_CELL = 32  # of vtkDataSetAttributes
SINGLE = 1e-6  # relative rounding of the 32-bit fields

# Components of the fields that every solver shows.
FIELDS = {
    "id": 1,
    "material": 1,
    "body": 1,
    "mass": 1,
    "density": 1,
    "energy": 1,
    "pressure": 1,
    "velocity": 3,
    "stress": 6,
    "speed": 1,
}


def expect(condition, message):
    if not condition:
        sys.exit("test_vtk_reader: " + message)


def close(value, wanted):
    return math.isclose(value, wanted, rel_tol=SINGLE, abs_tol=1e-30)


def read_grid(path):
    reader = vtkHDFReader()
    expect(reader.CanReadFile(path), path + ": VTK does not take it for a VTKHDF file")
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def check_cells(grid):
    count = grid.GetNumberOfPoints()
    expect(count > 0, "there are no points")
    expect(grid.GetNumberOfCells() == count, "there is not one cell for each point")
    connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    expect((connectivity == numpy.arange(count)).all(), "a vertex is not its own point")
    expect((offsets == numpy.arange(count + 1)).all(), "a cell has not one point")
    expect((vtk_to_numpy(grid.GetCellTypesArray()) == VERTEX).all(), "a cell is no vertex")
    points = vtk_to_numpy(grid.GetPoints().GetData())
    expect(points.dtype == numpy.float64, "the points are not 64-bit floats")
    expect(numpy.isfinite(points).all(), "a point is not finite")
    return count


def check_fields(grid, count):
    fields = {}
    data = grid.GetPointData()
    for index in range(data.GetNumberOfArrays()):
        values = vtk_to_numpy(data.GetArray(index))
        name = data.GetArrayName(index)
        expect(len(values) == count, name + ": has another number of values than there are points")
        expect(numpy.isfinite(values).all(), name + ": is not finite")
        fields[name] = values
    for name, components in FIELDS.items():
        expect(name in fields, "there is no field " + name)
        found = 1 if fields[name].ndim == 1 else fields[name].shape[1]
        expect(found == components, f"{name}: has {found} components, not {components}")
    expect(len(numpy.unique(fields["id"])) == count, "two particles have one id")
    expect((fields["density"] > 0).all(), "a density is not positive")
    expect((fields["mass"] > 0).all(), "a mass is not positive")
    speed = numpy.linalg.norm(fields["velocity"].astype(float), axis=1)
    expect(numpy.allclose(speed, fields["speed"], rtol=1e-5, atol=1e-6),
           "the speed is not the velocity's magnitude")
    return fields


def check_snapshot(path):
    """The fields of the snapshot PATH by name, and its time in seconds."""
    grid = read_grid(path)
    fields = check_fields(grid, check_cells(grid))
    time = grid.GetFieldData().GetArray("time")
    expect(time is not None and time.GetNumberOfTuples() == 1, "the snapshot has no time")
    for names, numbers, wanted in (("bodies", "body", ["left", "right"]),
                                   ("materials", "material", ["heavy", "light"])):
        table = grid.GetFieldData().GetAbstractArray(names)
        expect(table is not None, "there is no table of " + names)
        found = [table.GetValue(k) for k in range(table.GetNumberOfTuples())]
        expect(found == wanted, f"{names}: {found}")
        expect(set(fields[numbers]) == {0, 1}, numbers + ": numbers of other names")
    return fields, time.GetValue(0)


def check_history(folder, fields, time):
    with open(os.path.join(folder, "history.csv"), encoding="utf-8") as file:
        last = list(csv.DictReader(file))[-1]
    expect(close(float(last["time [s]"]), time), "history and snapshots do not end at one time")
    expect(int(last["particles"]) == len(fields["id"]), "the history counts other particles")
    for field, unit in (("density", "kg/m^3"), ("pressure", "Pa"), ("speed", "m/s")):
        low, high = fields[field].min(), fields[field].max()
        wanted = [float(last[f"{field}.{end} [{unit}]"]) for end in ("min", "max")]
        expect(close(low, wanted[0]) and close(high, wanted[1]),
               f"{field}: from {low} to {high}, but the history says {wanted}")


def check_series(folder, snapshots, time):
    found = glob.glob(os.path.join(folder, "**", "*.vtkhdf.series"), recursive=True)
    expect(len(found) == 1, "there is not one .vtkhdf.series")
    with open(found[0], encoding="utf-8") as file:
        series = json.load(file)
    home = os.path.dirname(found[0])
    listed = [os.path.realpath(os.path.join(home, entry["name"])) for entry in series["files"]]
    expect(listed == [os.path.realpath(path) for path in snapshots],
           "the series does not list the snapshots")
    times = [entry["time"] for entry in series["files"]]
    expect(times == sorted(times), "the times of the series do not rise")
    expect(times[-1] == time, "the series tells another time than the snapshot")


GRID_CASE = """\
format: 1
dimension: %d
resolution: 10 mm
solver: gas
materials: {air: {eos: {ideal-gas: {density: 1.2 kg/m^3, gamma: 1.4}}}}
bodies:
  air: {material: air, pressure: 0.1 MPa, box: {from: [%s], to: [%s]}}
run: {until: 1 s, max_steps: 2}
output: {every: 1 us}
"""
GRID_TYPES = {1: 3, 2: 8, 3: 11}  # lines, pixels, voxels


def check_grids(program, folder):
    """Cells of the solver gas, in each dimension, fill the domain with the fields on them."""
    high = ["0.07 m", "0.2 m", "0.05 m"]
    for dimension in 1, 2, 3:
        case = os.path.join(folder, "grid.yaml")
        with open(case, "w", encoding="utf-8") as file:
            file.write(GRID_CASE % (dimension, ", ".join(["0 m"] * dimension),
                                    ", ".join(high[:dimension])))
        results = os.path.join(folder, "grid")
        subprocess.run([program, "run", case, "--output", results, "--overwrite"], check=True,
                       stdout=subprocess.DEVNULL)
        grid = read_grid(sorted(glob.glob(os.path.join(results, "snapshots", "*.vtkhdf")))[-1])
        cells = round(math.prod(float(text.split()[0]) / 0.01 for text in high[:dimension]))
        expect(grid.GetNumberOfCells() == cells, f"{dimension}-D: not {cells} cells")
        types = vtk_to_numpy(grid.GetCellTypesArray())
        expect((types == GRID_TYPES[dimension]).all(), f"{dimension}-D: cells of another type")
        bounds = grid.GetBounds()
        for axis in range(dimension):
            expect(close(bounds[2 * axis + 1], float(high[axis].split()[0])) and
                   abs(bounds[2 * axis]) < 1e-12, f"{dimension}-D: bounds {bounds}")
        density = vtk_to_numpy(grid.GetCellData().GetArray("density"))
        expect(len(density) == cells and numpy.allclose(density, 1.2), "density of the cells")
        expect(grid.GetPointData().GetNumberOfArrays() == 0, "fields on the corners of cells")


def check_blocked(program, folder):
    """Cells that an obstacle blocks are hidden, and have no numbers."""
    case = os.path.join(folder, "blocked.yaml")
    with open(case, "w", encoding="utf-8") as file:
        file.write(GRID_CASE % (2, "0 m, 0 m", "0.07 m, 0.2 m"))
        file.write("boundaries: {block: {kind: rigid-body, part: {box: {from: [0.02 m, 0.02 m], to: [0.05 m, 0.1 m]}}}}\n")
    results = os.path.join(folder, "blocked")
    subprocess.run([program, "run", case, "--output", results], check=True,
                   stdout=subprocess.DEVNULL)
    grid = read_grid(sorted(glob.glob(os.path.join(results, "snapshots", "*.vtkhdf")))[-1])
    ghosts = grid.GetCellGhostArray()
    expect(ghosts is not None, "VTK finds no array of ghost cells")
    hidden = vtk_to_numpy(ghosts) == HIDDEN_CELL
    expect(hidden.sum() == 3 * 8, f"{hidden.sum()} cells are hidden, not 24")
    for name in "density", "pressure", "speed", "velocity":
        values = vtk_to_numpy(grid.GetCellData().GetArray(name))
        expect(numpy.isnan(values[hidden]).all(), name + ": a number in a blocked cell")
        expect(numpy.isfinite(values[~hidden]).all(), name + ": none in an open cell")


def main():
    program = os.environ["BOLIDE"]
    case = os.path.join(os.environ["BOLIDE_SOURCE_DIR"], "examples/riemann/gas/case.yaml")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "run", case, "--output", folder, "--overwrite", "--short"],
                       check=True, stdout=subprocess.DEVNULL)
        snapshots = sorted(glob.glob(os.path.join(folder, "snapshots", "*.vtkhdf")))
        expect(len(snapshots) >= 2, "the run left fewer than two snapshots")
        fields, time = check_snapshot(snapshots[-1])
        check_history(folder, fields, time)
        check_series(folder, snapshots, time)
    with tempfile.TemporaryDirectory() as folder:
        check_grids(program, folder)
        check_blocked(program, folder)
    print(f"VTK reads {len(fields['id'])} particles with {len(fields)} fields")


if __name__ == "__main__":
    main()
