#!/usr/bin/python3
"""Branches of periodic motions, stable and unstable, of pairs or trains on common axes, with their folds.

    data/examples/compare_branches.py out/parker2000/T150/branch.h5 out/parker2000/T300/branch.h5 --output branches.png

Needs python3-xarray, python3-h5netcdf and python3-matplotlib (make deps-python).
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy
import xarray

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("branch", nargs="+", help="branch.h5")
parser.add_argument("--mesh", help="name of the mesh (default: the first)")
parser.add_argument("--output", required=True, help="picture to write (.png, .svg)")
options = parser.parse_args()

figure, axes = plt.subplots(figsize=(9, 6), layout="constrained")
for number, path in enumerate(options.branch):
    with xarray.open_dataset(path, engine="h5netcdf") as branch:
        branch.load()
    branch = branch.sel(mesh=options.mesh) if options.mesh else branch.isel(mesh=0)
    colour = f"C{number}"
    stable = branch.stable.values == 1
    rms = 1e6 * branch.dte_rms.values
    # A line goes on to the first point of the other kind, so that no gap is drawn at a fold
    for kind, style in ((stable, "-"), (~stable, "--")):
        shown = kind | numpy.roll(kind, 1) & (numpy.arange(kind.size) > 0)
        parts = numpy.flatnonzero(numpy.diff(branch["branch"].values)) + 1  # between which nothing is drawn
        axes.plot(numpy.insert(branch.mesh_frequency.values, parts, numpy.nan),
                  numpy.insert(numpy.where(shown, rms, numpy.nan), parts, numpy.nan), style, color=colour,
                  label=branch.attrs["title"] if style == "-" else None)
    axes.plot(branch.fold_frequency.values, 1e6 * branch.fold_rms.values, "o", color=colour, fillstyle="none")

    largest = numpy.hypot(*branch.floquet_multiplier.isel(multiplier=0).transpose("part", "point").values)
    print(branch.attrs["title"])
    print(f"  {branch.sizes['point']} orbits, {int((~stable).sum())} unstable, largest multiplier {largest.max():.4f}")
    for fold in range(branch.sizes.get("fold", 0)):
        sides = branch.fold_multiplier.values[fold]
        print(f"  fold at {float(branch.fold_frequency[fold]):.3f} Hz, real multiplier {sides[0]:.4f} before, {sides[1]:.4f} after")

axes.set_xlabel("Mesh frequency (Hz)")
axes.set_ylabel("RMS of oscillating DTE (µm)")
axes.set_title("Solid: stable; dashed: unstable; circles: folds", fontsize="medium")
axes.set_ylim(bottom=0)
axes.grid(alpha=0.3)
axes.legend(fontsize="small")
figure.savefig(options.output, dpi=120, metadata={"Software": None} if options.output.endswith(".png") else None)
