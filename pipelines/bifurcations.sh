#!/usr/bin/env bash
# The table of bifurcations on standard output, from branch.h5 of a scene and of three finer ones:
#   bifurcations.sh <folder of the programs> <folder of the artifacts> <scene> <torque> ...
# Folds of one torque stand in the order of their branch, which is that of all four. Changes: the finer scene less the scene, Hz.
set -euo pipefail
programs=$1 out=$2 scene=$3
shift 3

# frequency, kind, multipliers of each fold of a branch
folds() {
  "$programs/gear-inspect" "$1" | awk '$1 == "fold" { kind = /at a kink/ ? "kink" : "smooth"
    for (i = 1; i <= NF; ++i) { if ($i == "before") before = $(i - 1); if ($i ~ /^after,?$/) after = $(i - 1); if ($i == "map") frequency = $(i + 1) }
    print frequency, kind, before, after }'
}

printf '# Folds of the branches of %s over the mesh frequency; renewed by `make bifurcations`.\n' "$scene"
printf '# Changes in Hz with half the time step, twice the strips, twice the modes.\n'
printf 'torque_Nm\tfold\tfrequency_Hz\tkind\tmultiplier_before\tmultiplier_after\thalf_step_Hz\ttwice_strips_Hz\ttwice_modes_Hz\n'
for torque in "$@"; do
  paste -d' ' <(folds "$out/$scene/T$torque/branch.h5") \
    <(folds "$out/$scene-halfstep/T$torque/branch.h5") \
    <(folds "$out/$scene-strips16/T$torque/branch.h5") \
    <(folds "$out/$scene-modes122/T$torque/branch.h5") |
    awk -v torque="$torque" 'NF != 16 { print "the four branches at " torque " N m have different folds" > "/dev/stderr"; exit 1 }
      { printf "%s\t%d\t%.3f\t%s\t%.5f\t%.5f\t%.2f\t%.2f\t%.2f\n", torque, NR, $1, $2, $3, $4, $5 - $1, $9 - $1, $13 - $1 }'
done
