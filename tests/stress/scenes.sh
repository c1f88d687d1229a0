#!/usr/bin/env bash
# Random valid scenes through statics and a short sweep: each runs with an energy balance that closes, or is rejected with a reason.
#
#   tests/stress/scenes.sh COUNT [SEED [FOLDER]]     B=build; the reasons and what went wrong on standard output
#
# Teeth 12-120, module 0.5-8 mm, shifts, face width, bore, torque over four decades. A coarse mesh: what is at stake is whether
# an answer is one. Status 1 if a program crashes, hangs, says nothing, rejects for a reason that no valid scene can have, or
# hands out a motion whose energy balance does not close.
set -uo pipefail
count=${1:-200} seed=${2:-1}
bin=$PWD/${B:-build}/bin
work=${3:-$(mktemp -d)}
[ $# -ge 3 ] || trap 'rm -rf "$work"' EXIT
mkdir -p "$work" && cd "$work" || exit 1
rm -f tally reasons

# One scene a line: its file is made from it by `scene`.
awk -v count="$count" -v seed="$seed" '
  function any(low, high) { return low + (high - low) * rand() }
  function decades(low, high) { return 10 ^ any(log(low) / log(10), log(high) / log(10)) }
  function inv(a) { return sin(a) / cos(a) - a }
  function angle_of(value, low, high, i, a) { low = 0; high = 1.2
    for (i = 0; i < 80; ++i) { a = (low + high) / 2; if (inv(a) < value) low = a; else high = a }
    return a }
  BEGIN { srand(seed); pi = atan2(0, -1)
    for (i = 1; i <= count; ++i) {
      z1 = int(any(12, 121)); z2 = int(any(12, 121)); m = decades(0.5, 8); alpha = 20 * pi / 180
      if (rand() < 0.3) alpha = any(15, 25) * pi / 180
      # no less than what the rack leaves whole, and now and then a little less
      least1 = 1 - z1 * sin(alpha) ^ 2 / 2 - (rand() < 0.2 ? 0.1 : 0); least2 = 1 - z2 * sin(alpha) ^ 2 / 2 - (rand() < 0.2 ? 0.1 : 0)
      x1 = any(least1 > -0.3 ? least1 : -0.3, 0.6); x2 = any(least2 > -0.3 ? least2 : -0.3, 0.6)
      if (rand() < 0.3) { if (least1 <= 0) x1 = 0; if (least2 <= 0) x2 = 0 }
      work_angle = angle_of(inv(alpha) + 2 * (x1 + x2) * sin(alpha) / cos(alpha) / (z1 + z2))
      centre = m * (z1 + z2) / 2 * cos(alpha) / cos(work_angle) + m * any(0, 0.03)
      width = m * any(4, 15)
      root1 = m * (z1 / 2 + x1 - 1.25); root2 = m * (z2 / 2 + x2 - 1.25)
      bore1 = root1 * any(0.25, 0.85); bore2 = root2 * any(0.25, 0.85)
      # a tooth root of 50 MPa or so, times 1/100 to 100
      torque = 50e6 * width * 1e-3 * m * 1e-3 / 3 * (m * z1 / 2 * 1e-3) * decades(0.01, 100)
      i1 = 7800 * width * 1e-3 * pi / 2 * ((m * (z1 / 2 + x1 + 1)) * 1e-3) ^ 4 * any(1, 2)
      i2 = 7800 * width * 1e-3 * pi / 2 * ((m * (z2 / 2 + x2 + 1)) * 1e-3) ^ 4 * any(1, 2)
      from = decades(200, 6000)
      printf "%d %d %d %.4f %.3f %.4f %.4f %.5f %.3f %.3f %.3f %.6g %.6g %.6g %.5g %d %s\n", i, z1, z2, m, alpha * 180 / pi, x1, x2, centre, width,
        bore1, bore2, torque, i1, i2, from, rand() * 3, rand() < 0.3 ? "line" : "strips"
    } }' > scenes

scene() { # number z1 z2 module angle x1 x2 centre width bore1 bore2 torque inertia1 inertia2 from corner contact
  local corner=(true true false)
  cat << SCENE
title = "random scene $1"
[gear.first]
teeth = $2
module_mm = $4
pressure_angle_deg = $5
profile_shift = $6
face_width_mm = $9
bore_radius_mm = ${10}
total_inertia_kgm2 = ${13}
material = "steel"
[gear.second]
like = "first"
teeth = $3
profile_shift = $7
bore_radius_mm = ${11}
total_inertia_kgm2 = ${14}
[material.steel]
youngs_modulus_GPa = 206.0
poisson_ratio = 0.3
density_kgm3 = 7800.0
plane = "strain"
[[mesh]]
driver = "first"
driven = "second"
centre_distance_mm = $8
corner_contact = ${corner[${16}]}
[damping]
rayleigh_stiffness_s = 4e-6
undamped_depth_mm = $(awk -v m="$4" 'BEGIN { print m / 6 }')
[operation]
torque_Nm = [${12}]
mesh_frequency_Hz = { from = ${15}, to = $(awk -v f="${15}" 'BEGIN { print 1.1 * f }'), step = $(awk -v f="${15}" 'BEGIN { print 0.05 * f }') }
[fidelity]
body = "modal"
contact = "${17}"
modes = 3
[discretisation]
element_mm = $(awk -v m="$4" 'BEGIN { print m / 3 }')
element_order = 1
SCENE
}

# What may be said of gears that can be drawn but not made, do not fit each other, or are loaded beyond the model. Whatever
# else a program ends with is its fault, a message or not.
accepted='rack_tip_radius .* does not fit the rack tooth|the rack cuts the tooth off|no involute is left|tip thickness is .* below zero'
accepted+='|is not below the root radius|the gears do not reach each other|the gears jam|the contact ratio is .* below 1'
accepted+='|contact leaves the flanks|Hertz.s law relative to its depth holds up to'

# run <stage> <command...>: false if it ended otherwise than well; the tally then holds the scene
run() {
  local stage=$1 status
  # CPU time: on a busy machine a clock would call slow what is only waiting
  (ulimit -t 300 && exec timeout 7200 "${@:2}" > /dev/null 2> said)
  status=$?
  [ $status != 0 ] || return 0
  if { [ $status = 3 ] || [ $status = 1 ]; } && [ "$(grep -c ': error: ' said)" = 1 ] && grep -q -E ": error: .*($accepted)" said; then
    echo "rejected $stage" >> tally
    echo "scene $number: $(grep ': error: ' said)" >> reasons
  else
    echo "wrong $stage" >> tally
    echo "scene $number: $stage ends with status $status: $(tail -n 1 said)"
  fi
  return 1
}

while read -r -a values; do
  number=${values[0]}
  rm -rf out; scene "${values[@]}" > own.toml
  run gear-scene "$bin/gear-scene" --scene own.toml --output own.mk --out out || continue
  home=out/own/T
  for gear in first second; do
    run gear-mesh "$bin/gear-mesh" --params out/own/$gear/body.toml --output out/own/$gear/mesh.h5 || continue 2
    run gear-reduce "$bin/gear-reduce" --params out/own/$gear/body.toml --mesh out/own/$gear/mesh.h5 --output out/own/$gear/body.h5 || continue 2
  done
  pair=(--body first=out/own/first/body.h5 --body second=out/own/second/body.h5)
  run gear-static "$bin/gear-static" --params out/own/params/static.toml "${pair[@]}" --torque "${values[11]}" --output $home/static.h5 || continue
  run gear-sweep "$bin/gear-sweep" --params out/own/params/sweep.toml "${pair[@]}" --static $home/static.h5 --reference-static $home/static.h5 \
    --direction up --output $home/sweep.h5 || continue
  if ! "$bin/gear-inspect" --check --scene own.toml out 2> said; then
    echo "wrong check" >> tally; echo "scene $number: $(head -n 1 said)"; continue; fi
  imbalance=$("$bin/gear-inspect" $home/sweep.h5 | sed -n 's/.*energy imbalance //p')
  if awk -v x="$imbalance" 'BEGIN { exit !(x != "" && x + 0 < 1e-9) }'; then echo "ran closing" >> tally; else
    echo "wrong energy balance" >> tally; echo "scene $number: energy imbalance ${imbalance:-not said} (${values[*]})"; fi
done < scenes

touch reasons
sort -k2 -t: reasons | sed 's/^/  rejected: /'
echo "$count scenes, seed $seed: $(grep -c '^ran' tally) ran with an energy balance closed to 1e-9, $(grep -c '^rejected' tally) rejected, $(grep -c '^wrong' tally) wrong"
# A program that rejects everything is no sound one.
ran=$(grep -c '^ran' tally)
[ "$count" -gt 0 ] && [ $((2 * ${ran:-0})) -ge "$count" ] && ! grep -q '^wrong' tally
