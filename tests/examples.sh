# The Python examples of data/examples on artifacts as tests make them: they end well, draw a picture and print numbers.
#
# Needs Debian's python3-xarray, python3-h5netcdf and python3-matplotlib (make deps-python).
source tests/cases
with_artifacts_and_python "examples in Python" "python3-xarray, python3-h5netcdf and python3-matplotlib" "xarray, h5netcdf, matplotlib"
# runs <script> <artifact> <what it prints>
runs() {
  local picture=$work/$1.png
  if ! "$python" "data/examples/$1.py" "$work/$2" "$work/$2" --output "$picture" > "$work/said" 2>&1; then
    echo "FAILED: $1.py: $(tail -n 1 "$work/said")"
  elif ! grep -q -E "$3" "$work/said" || [ "$(head -c 8 "$picture" | tail -c 7 | head -c 3)" != PNG ]; then
    echo "FAILED: $1.py: $(head -n 3 "$work/said" | tr '\n' '|')"
  else echo "ok: $1.py draws $2"; fi
}
runs read_response response.h5 'largest RMS [0-9.]+ µm at'
runs compare_branches branch.h5 '[0-9]+ orbits, [0-9]+ unstable'
