# Each kind of artifact in xarray: every group opens with h5netcdf, without a warning, with named axes and their coordinates.
#
# Needs Debian's python3-xarray and python3-h5netcdf (make deps-python). The artifacts are those of one case of test_datasets.cpp.
source tests/cases
with_artifacts_and_python "artifacts in xarray" "python3-xarray and python3-h5netcdf" "xarray, h5netcdf"
cd "$work" && "$python" - << 'PYTHON'
import warnings

import h5netcdf
import xarray

warnings.simplefilter("error")


def groups(group, path="/"):
    yield path
    for name in group.groups:
        yield from groups(group[name], path.rstrip("/") + "/" + name)


def check(claim, right, said=""):
    print(f"ok: {claim}" if right else f"FAILED: {claim}: {said}")


# kind: group, dataset, its axes in order, those of them that have coordinates in that group
expected = {
    "mesh": ("/sector", "flank_roll_angle", ("flank_node",), {"flank_node"}),
    "body": ("/", "flank_mode", ("flank_position", "mode"), {"flank_position"}),
    "static": ("/", "tooth_load", ("mesh_phase", "mesh", "tooth_pair"), {"mesh_phase", "mesh", "tooth_pair"}),
    "error_budget": ("/choice", "harmonic_change", ("change", "harmonic"), set()),
    "loaded": ("/strip", "roll_angle", ("strip", "gear"), set()),
    "impact": ("/ring_down", "transmission_error", ("mesh_phase", "time"), {"mesh_phase", "time"}),
    "sweep": ("/", "tooth_load", ("mesh_frequency", "sample", "mesh", "tooth_pair"), {"mesh_frequency", "mesh", "tooth_pair"}),
    "response": ("/", "dte_harmonic", ("mesh_frequency", "harmonic", "mesh"), {"mesh_frequency", "harmonic", "mesh"}),
    "branch": ("/", "floquet_multiplier", ("point", "multiplier", "part"), set()),
    "jump_map": ("/up", "dte_rms", ("case", "mesh_frequency"), set()),
    "harris_map": ("/", "peak_to_peak", ("relief_length", "torque", "relief"), {"relief_length", "torque", "relief"}),
    "variant": ("/quantity", "mean_stiffness", (), set()),
    "study": ("/", "unsteady", ("variant",), {"variant"}),
    "readings": ("/", "value", ("draw", "claim"), {"claim"}),
}
for kind, (group, name, axes, coordinates) in expected.items():
    path = kind + ".h5"
    try:
        with h5netcdf.File(path, "r") as file:
            # Below an axis called body h5netcdf takes the word /parameters/fidelity/body for its coordinate.
            named = "body" in file.dimensions
            found = [g for g in groups(file) if not g.startswith("/VTKHDF") and not (named and g == "/parameters/fidelity")]
        for each in found:
            with xarray.open_dataset(path, engine="h5netcdf", group=each) as data:
                data.load()
                unnamed = [n for n, v in data.variables.items() if any(d.startswith("phony") for d in v.dims)]
                if unnamed:
                    raise ValueError(f"{each}: {unnamed} have axes without a name")
        with xarray.open_dataset(path, engine="h5netcdf", group=group) as data:
            array = data[name]
            check(f"{path}: {len(found)} groups; {group} {name} {axes}", array.dims == axes and set(array.coords) == coordinates
                  and array.attrs["units"] and array.attrs["long_name"], f"{array.dims}, {set(array.coords)}")
    except Exception as error:
        check(path, False, f"{type(error).__name__}: {error}")
with xarray.open_dataset("response.h5", engine="h5netcdf") as data:
    first = data.dte_harmonic.sel(harmonic=1)
    check("a harmonic is chosen by its number", (first.values == data.dte_harmonic.values[:, 0]).all())
    name = str(data.mesh.values[-1])
    check("a mesh is chosen by its name", (data.dte_rms.sel(mesh=name).values == data.dte_rms.values[:, -1]).all())
    check("bodies have names", data.bearing_force_max.dims == ("mesh_frequency", "body") and "body" in data.coords, str(data.coords))
PYTHON
