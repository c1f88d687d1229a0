#!/usr/bin/python3
"""Response of a mesh over speed, rising and falling: what it was, where it jumps, how large each order is.

    data/examples/read_response.py out/parker2000/T150/up/response.h5 out/parker2000/T150/down/response.h5 --output response.png

Reads the artifacts with xarray: axes have names, values have units in their attributes. Needs python3-xarray, python3-h5netcdf and
python3-matplotlib (make deps-python).
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import xarray

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("response", nargs="+", help="response.h5 of a sweep")
parser.add_argument("--output", required=True, help="picture to write (.png, .svg)")
parser.add_argument("--mesh", help="of a train: name of the mesh, such as sun-planet1 (default: the first)")
options = parser.parse_args()

figure, (rms, orders) = plt.subplots(2, 1, sharex=True, figsize=(9, 8), layout="constrained")
for path in options.response:
    with xarray.open_dataset(path, engine="h5netcdf") as response:
        response.load()
    response = response.sel(mesh=options.mesh) if options.mesh else response.isel(mesh=0)
    micrometre = 1e6 * response.dte_rms
    title = response.attrs["title"]
    rms.plot(response.mesh_frequency, micrometre, ".-", markersize=3, label=title)
    for jump in response.jump_frequency.values:
        rms.axvline(jump, linestyle=":", color="grey")

    # The nearest stored speed, by value rather than by number of the row
    peak = float(micrometre.idxmax("mesh_frequency"))
    at_peak = response.sel(mesh_frequency=peak)
    print(title)
    print(f"  largest RMS {float(micrometre.max()):.3f} µm at {peak:g} Hz, mean {1e6 * float(at_peak.dte_mean):.3f} µm")
    print(f"  contact lost for {100 * float(at_peak.separation_fraction):.1f} % of the period there")
    print("  jumps:", ", ".join(f"{f:.1f} Hz" for f in response.jump_frequency.values) or "none")
    for order in (1, 2, 3):
        if order in response.harmonic:
            amplitude = 1e6 * response.dte_harmonic.sel(harmonic=order)
            orders.plot(response.mesh_frequency, amplitude, label=f"order {order}, {title.split(':')[0]}")

rms.set_ylabel("RMS of oscillating DTE (µm)")
orders.set_ylabel("Amplitude of mesh orders (µm)")
orders.set_xlabel("Mesh frequency (Hz)")
for axes in (rms, orders):
    axes.set_ylim(bottom=0)
    axes.grid(alpha=0.3)
    axes.legend(fontsize="small")
figure.savefig(options.output, dpi=120, metadata={"Software": None} if options.output.endswith(".png") else None)
