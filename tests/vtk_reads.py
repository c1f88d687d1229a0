"""Whether VTK itself, and so ParaView, sees in artifacts what is in them: cells, areas, displacements, pressures.

    vtk_reads.py MESH.hdf BODY.hdf LOADED.hdf TOOTH_LOAD FACE_WIDTH MODES.hdf    (N, of all pairs; m; modes of three gears in line)

One line per claim, as tests/run counts them. Reads with vtkHDFReader alone, nothing of ours.
"""
import math
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy as numbers
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOHDF import vtkHDFReader


def read(path):
    reader = vtkHDFReader()
    reader.SetFileName(path)
    if not reader.CanReadFile(path):
        sys.exit(f"FAILED: VTK cannot read {path}")
    reader.Update()
    return reader.GetOutput()


def sizes(grid, what):
    measure = vtkCellSizeFilter()
    measure.SetInputData(grid)
    measure.Update()
    return numbers(measure.GetOutput().GetCellData().GetArray(what))


def claim(text, holds, found):
    print(f"ok: VTK: {text}" if holds else f"FAILED: VTK: {text}: {found}")


mesh, body, loaded = (read(path) for path in sys.argv[1:4])
tooth_load, face_width = (float(word) for word in sys.argv[4:6])

area = sizes(mesh, "Area").sum()
teeth = int(mesh.GetCellData().GetArray("tooth").GetRange()[1]) + 1
tip = math.hypot(*max((mesh.GetPoint(i)[:2] for i in range(mesh.GetNumberOfPoints())), key=lambda p: math.hypot(*p)))
claim("mesh.hdf is a gear: its teeth, its tip circle", teeth == 50 and abs(tip - 78e-3) < 1e-6, (teeth, tip))

modes = [body.GetPointData().GetArrayName(i) for i in range(body.GetPointData().GetNumberOfArrays())]
largest = [body.GetPointData().GetArray(name).GetMaxNorm() for name in modes]
claim("body.hdf holds mode shapes on the same gear",
      sum(name.startswith("mode_") for name in modes) >= 5 and min(largest) > 0
      and body.GetNumberOfCells() == mesh.GetNumberOfCells(), modes)

cell = {name: numbers(loaded.GetCellData().GetArray(name)) for name in ("gear", "contact_strip", "contact_pressure")}
lines = cell["contact_strip"] == 1
of_gear = [(cell["gear"] == g) & ~lines for g in (1, 2)]
areas = sizes(loaded, "Area")
claim("loaded.hdf holds both gears whole",
      all(part.sum() == mesh.GetNumberOfCells() and abs(areas[part].sum() / area - 1) < 1e-6 for part in of_gear),
      [(int(part.sum()), areas[part].sum() / area) for part in of_gear])
bounds = loaded.GetBounds()
claim("loaded.hdf: the driven gear stands above the driver", abs(bounds[3] - 0.150 - tip) < 1e-3 and
      abs(bounds[2] + tip) < 1e-3, bounds)

length = sizes(loaded, "Length")
for g in (1, 2):
    strips = lines & (cell["gear"] == g)
    force = (length[strips] * cell["contact_pressure"][strips]).sum() * face_width
    claim(f"loaded.hdf: pressure times length on the flanks of gear {g} is the tooth load",
          abs(force / tooth_load - 1) < 0.01, (force, tooth_load))

points = {name: numbers(loaded.GetPointData().GetArray(name))
          for name in ("displacement", "elastic_displacement", "von_mises_stress", "principal_stress_largest")}
moved = (points["displacement"] ** 2).sum(1) ** 0.5
claim("loaded.hdf: displacements of micrometres, stresses of megapascals, no hole in them",
      1e-6 < moved.max() < 100e-6 and 10e6 < points["von_mises_stress"].max() < 2e9
      and 1e6 < points["principal_stress_largest"].max() < 2e9
      and all((values == values).all() for values in points.values()),
      (moved.max(), points["von_mises_stress"].max(), points["principal_stress_largest"].max()))

system = read(sys.argv[6])
arrays = system.GetPointData()
shapes = {arrays.GetArrayName(i): numbers(arrays.GetArray(i)) for i in range(arrays.GetNumberOfArrays())}
number = numbers(system.GetCellData().GetArray("body"))
claim("modes.hdf: every cell is of a body, no two of which lie on each other", set(number) == {0, 1, 2} and
      sizes(system, "Area").min() > 0, (set(number), sizes(system, "Area").min()))
# The largest displacement is a twentieth of half the width of the drawing.
least, most = system.GetBounds()[:2]
largest = [math.sqrt((values ** 2).sum(1).max()) / (0.05 * 0.5 * (most - least)) for values in shapes.values()]
claim("modes.hdf: mode shapes of one largest displacement", len(shapes) > 2 and all(name.startswith("mode_") for name in shapes)
      and all(abs(size - 1) < 1e-5 for size in largest), largest)
