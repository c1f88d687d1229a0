# Complementarity beside Siconos: compiled here, because Siconos is needed for nothing else.
set -uo pipefail
B=${B:-build}
if [ ! -e /usr/include/siconos/numerics/lcp_cst.h ]; then
  echo "skipped: comparison with Siconos: libsiconos-numerics-dev is not installed"
  exit 0
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# The flags of the steps: objects of different flags do not fit each other. The linker takes what it needs.
read -r -a compile < "$B/flags"
ar rcs "$scratch/library.a" "$B"/obj/common/{base,model,gear,contact,solid}/*.o
if ! "${compile[@]}" -Itests -isystem /usr/include/siconos -isystem /usr/include/siconos/numerics -o "$scratch/siconos" \
    tests/peer/siconos.cpp "$scratch/library.a" -lsiconos_numerics 2> "$scratch/errors"; then
  echo "FAILED: tests/peer/siconos.cpp does not compile: $(head -3 "$scratch/errors" | tr '\n' ' ')"
  exit 1
fi
OPENBLAS_NUM_THREADS=1 "$scratch/siconos"
