# The Python examples of data/examples on artifacts as tests make them: they end well, draw a picture and print numbers.
#
# Needs Debian's python3-xarray, python3-h5netcdf and python3-matplotlib (make deps-python).
set -uo pipefail
B=${B:-build}
python=$(for candidate in python3 /usr/bin/python3; do "$candidate" -c 'import xarray, h5netcdf, matplotlib' 2> /dev/null && { echo "$candidate"; break; }; done)
if [ -z "$python" ]; then
  echo "skipped: examples in Python (python3-xarray, python3-h5netcdf and python3-matplotlib are not all installed; make deps-python)"
  exit 0
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if ! WHINE_KEEP=$work "$B/bin/whine-tests" --no-colors=true -tc='axes of each kind of artifact*' > "$work/said" 2>&1 || [ ! -e "$work/study.h5" ]; then
  echo "FAILED: one artifact of each kind: $(tail -n 3 "$work/said" | tr '\n' '|')"
  exit 1
fi
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
