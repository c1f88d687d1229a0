# Readers of scenes and artifacts against damaged files, the same ones every time; `make fuzz` looks further.
set -uo pipefail
B=${B:-build}
corpus=$PWD/tests/fuzz/corpus
bin=$PWD/$B/bin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
# Behind the hash a reader sees what its writer has made or it sees nothing.
for file in "$corpus"/sealed/*.h5; do
  said=$("$bin/gear-inspect" "$file" 2>&1)
  grep -q ': error: ' <<< "$said" && echo "FAILED: corpus: $(grep -m1 ': error: ' <<< "$said"); if its schema has changed: mkdir kept;" \
    "WHINE_KEEP=kept $B/bin/whine-tests -tc='*bit by bit*' leaves new ones (jump_map.h5 is gear-lumped --map of a coarse scene)"
done
# A minute in all; behind the hash an input takes HDF5 some 14 ms.
declare -A inputs=([scene]=20000 [study]=20000 [artifact]=8000 [sealed]=2000)
for target in scene study artifact sealed; do
  [ -x "$bin/whine-replay-$target" ] || { echo "skipped: damaged files for the readers of $target (make replay compiles the programs)"; continue; }
  if said=$("$bin/whine-replay-$target" "${inputs[$target]}" 1 "$corpus/$target" 2>&1); then echo "ok: $target: $said, read or refused"; else
    echo "FAILED: $target: status $?, $(tail -n 1 <<< "$said")"; fi
done
