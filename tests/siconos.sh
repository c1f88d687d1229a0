# Complementarity beside Siconos.
set -uo pipefail
B=${B:-build}
if [ ! -e "$B/bin/whine-siconos" ]; then
  echo "skipped: comparison with Siconos: libsiconos-numerics-dev is not installed"
  exit 0
fi
OPENBLAS_NUM_THREADS=1 "$B/bin/whine-siconos"
