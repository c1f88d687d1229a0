#!/usr/bin/env bash
# Tables of folds on standard output, from the artifacts of gear-orbit and gear-sweep:
#   folds.sh bifurcations|jumps <folder of the programs> <folder of the artifacts> <scene> <torque> ...
#
#   bifurcations   folds of the branches of a scene and of three finer ones; changes: the finer scene less the scene, Hz. Folds of one torque
#                  stand in the order of their branch, which is that of all four
#   jumps          jumps of sweeps that enclose them narrowly; difference: the jump, which is the middle of the interval in which the sweep leaves
#                  its branch, less the nearest fold, Hz
set -euo pipefail
table=$1 programs=$2 out=$3 scene=$4
shift 4

# frequency, kind, multipliers of each fold of a branch
folds() {
  "$programs/gear-inspect" "$1" | awk '$1 == "fold" { kind = /at a kink/ ? "kink" : "smooth"
    for (i = 1; i <= NF; ++i) { if ($i == "before") before = $(i - 1); if ($i ~ /^after,?$/) after = $(i - 1); if ($i == "map") frequency = $(i + 1) }
    print frequency, kind, before, after }'
}

bifurcations() {
  printf '# Folds of the branches of %s over the mesh frequency; renewed by `make bifurcations`.\n' "$scene"
  printf '# Changes in Hz with half the time step, twice the strips, twice the modes.\n'
  printf 'torque_Nm\tfold\tfrequency_Hz\tkind\tmultiplier_before\tmultiplier_after\thalf_step_Hz\ttwice_strips_Hz\ttwice_modes_Hz\n'
  for torque in "$@"; do
    branch=T$torque/branch.h5
    paste -d' ' <(folds "$out/$scene/$branch") <(folds "$out/$scene-halfstep/$branch") <(folds "$out/$scene-strips16/$branch") <(folds "$out/$scene-modes122/$branch") |
      awk -v torque="$torque" 'NF != 16 { print "the four branches at " torque " N m have different folds" > "/dev/stderr"; exit 1 }
        { printf "%s\t%d\t%.3f\t%s\t%.5f\t%.5f\t%.2f\t%.2f\t%.2f\n", torque, NR, $1, $2, $3, $4, $5 - $1, $9 - $1, $13 - $1 }'
  done
}

jumps() {
  printf '# Jumps of the sweeps of %s beside the folds of the branch; renewed by `make jump-folds`.\n' "$scene"
  printf 'torque_Nm\tdirection\tjump_Hz\thalf_width_Hz\tfold_Hz\tdifference_Hz\n'
  for torque in "$@"; do
    folds=$(folds "$out/$scene/T$torque/branch.h5" | cut -d" " -f1 | tr "\n" " ")
    for direction in up down; do
      "$programs/gear-inspect" "$out/$scene/T$torque/$direction/jumps.h5" |
        awk -v folds="$folds" -v torque="$torque" -v direction="$direction" '$1 == "jumps" {
          n = split(folds, fold, " "); sub(/^ *jumps */, ""); m = split($0, jump, ", ")
          for (i = 1; i <= m; ++i) {
            split(jump[i], part, " "); own = fold[1]
            for (k = 2; k <= n; ++k) if ((part[1] - fold[k]) ^ 2 < (part[1] - own) ^ 2) own = fold[k]
            printf "%s\t%s\t%.3f\t%s\t%s\t%s\n", torque, direction, part[1], part[3], n ? sprintf("%.3f", own) : "", n ? sprintf("%.3f", part[1] - own) : ""
          }
        }'
    done
  done
}

"$table" "$@"
