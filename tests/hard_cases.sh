# The table of `make hard-cases`, a line per row of it.
set -uo pipefail
B=${B:-build}
OPENBLAS_NUM_THREADS=1 "$B/bin/whine-hard-cases" |
  sed -E -e 's/^pass +/ok: /' -e 's/^FAIL +/FAILED: /' -e 's/   +/   /g'
