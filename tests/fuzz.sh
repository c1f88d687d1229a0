# Readers of scenes, studies, REXS models, transfer functions and artifacts against damaged files, the same ones every time; `make fuzz` looks further.
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
    "WHINE_KEEP=kept $B/bin/whine-tests -tc='axes of each kind*' leaves new ones (jump_map.h5 is gear-lumped --map of a coarse scene)"
done
# A quarter of a minute in all, a minute for `make test-all`; behind the hash an input takes HDF5 some 14 ms.
declare -A inputs=([scene]=5000 [study]=5000 [rexs]=5000 [transfer]=5000 [artifact]=2000 [sealed]=500)
for target in scene study rexs transfer artifact sealed; do
  [ -x "$bin/whine-replay-$target" ] || { echo "skipped: damaged files for the readers of $target (make replay compiles the programs)"; continue; }
  count=${inputs[$target]}
  [ -z "${long:-}" ] || count=$((4 * count))
  if said=$("$bin/whine-replay-$target" "$count" 1 "$corpus/$target" 2>&1); then echo "ok: $target: $said, read or rejected"; else
    echo "FAILED: $target: status $?, $(tail -n 1 <<< "$said")"; fi
done
