#!/usr/bin/env bash
# The table of jumps on standard output, from sweeps whose jumps are enclosed narrowly and from the branches at the same torques:
#   jumps.sh <folder of the programs> <folder of the artifacts> <scene> <torque> ...
# Difference: the jump, which is the middle of the interval in which the sweep leaves its branch, less the nearest fold, Hz.
set -euo pipefail
programs=$1 out=$2 scene=$3
shift 3

printf '# Jumps of the sweeps of %s beside the folds of the branch; renewed by `make jump-folds`.\n' "$scene"
printf 'torque_Nm\tdirection\tjump_Hz\thalf_width_Hz\tfold_Hz\tdifference_Hz\n'
for torque in "$@"; do
  folds=$("$programs/gear-inspect" "$out/$scene/T$torque/branch.h5" | awk '$1 == "fold" { for (i = 1; i <= NF; ++i) if ($i == "map") printf "%s ", $(i + 1) }')
  for direction in up down; do
    "$programs/gear-inspect" "$out/$scene/T$torque/$direction/jumps.h5" |
      awk -v folds="$folds" -v torque="$torque" -v direction="$direction" '$1 == "jumps" {
        n = split(folds, fold, " ")
        sub(/^ *jumps */, "")
        m = split($0, jump, ", ")
        for (i = 1; i <= m; ++i) {
          split(jump[i], part, " ")
          least = -1
          for (k = 1; k <= n; ++k) {
            apart = part[1] - fold[k]
            if (least < 0 || apart * apart < least * least) { least = apart < 0 ? -apart : apart; own = fold[k] }
          }
          if (!n) { printf "%s\t%s\t%.3f\t%s\t\t\n", torque, direction, part[1], part[3]; continue }
          printf "%s\t%s\t%.3f\t%s\t%.3f\t%.3f\n", torque, direction, part[1], part[3], own, part[1] - own
        }
      }'
  done
done
