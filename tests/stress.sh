# What tests/stress/scenes.sh takes for outside the model's range, and what for a fault: with programs that only say what they are told to.
set -uo pipefail
top=$PWD
base=$(mktemp -d)
trap 'rm -rf "$base"' EXIT
cd "$base" || exit 1
mkdir -p fake/bin
for stage in scene mesh reduce static sweep inspect; do
  printf '#!/bin/sh\n[ ! -f %s/%s ] || . %s/%s\n' "$base" $stage "$base" $stage > fake/bin/gear-$stage
  chmod +x fake/bin/gear-$stage
done
# tally <claim> <expected> <stage> <what it does>: how scenes.sh counts one scene
tally() {
  local said
  rm -f scene mesh reduce static sweep inspect
  echo 'echo energy imbalance 1e-12' > inspect
  echo "$4" > "$3"
  said=$(B=fake "$top/tests/stress/scenes.sh" 1 1 "$base/work" 2> /dev/null | tail -n 1 | sed 's/^1 scenes, seed 1: //')
  if [ "$said" = "$2" ]; then echo "ok: $1"; else echo "FAILED: $1: $said"; fi
}
ran='1 ran with an energy balance closed to 1e-9, 0 rejected, 0 wrong' rejected='0 ran with an energy balance closed to 1e-9, 1 rejected, 0 wrong'
wrong='0 ran with an energy balance closed to 1e-9, 0 rejected, 1 wrong'
tally "a scene that runs" "$ran" scene ''
tally "an energy balance that does not close" "$wrong" inspect 'echo energy imbalance 2e-9'
tally "contact beyond the flanks lies outside the model's range" "$rejected" static 'echo "gear-static: error: at 1e+04 N m contact leaves the flanks: a candidate zone" >&2; exit 1'
tally "a rack that cannot be lies outside the model's range" "$rejected" scene 'echo "gear-scene: error: own.toml: rack_tip_radius 0.38 modules does not fit the rack tooth (1 mm too wide)" >&2; exit 3'
tally "a fault of the program is none" "$wrong" sweep 'echo "gear-sweep: error: HDF5 refused to make a group; this is a fault of the program" >&2; exit 1'
tally "a solver that gives up is none" "$wrong" sweep 'echo "gear-sweep: error: 12 contact steps did not end" >&2; exit 1'
tally "a scene that its reader does not take is none" "$wrong" scene 'echo "gear-scene: error: own.toml:3: unknown key" >&2; exit 3'
tally "a crash is none, whatever was said before" "$wrong" mesh 'echo "gear-mesh: error: the gears jam: " >&2; kill -SEGV $$'
