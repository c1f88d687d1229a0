# The programs from outside: a coarse scene through the whole chain, bad input, broken artifacts, kills and full disks.
#
# Every refusal has to be one line on standard error, the status of base/error.h, and no change to what was there.
source tests/cases
bin=$PWD/$B/bin
scene_of_paper=$PWD/data/scenes/parker2000-standard-tooth.toml
plots=$PWD/pipelines/plots
claims=$PWD/data/published/claims.toml
tests=$PWD/tests
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

contents() { find . -type f ! -name said ! -name 'scene*.toml' -print0 | sort -z | xargs -0 sha256sum; }
# As telling of what was never to be written again, at a hundredth of the time: any write changes the time of an inode.
untouched() { find . -type f ! -name said ! -name 'scene*.toml' -printf '%p %i %s %C@\n' | sort; }

# rejected <claim> <status> <fields of the message> <command...>
rejected() {
  local claim=$1 status=$2 fields=$3 before found told
  shift 3
  before=$(untouched)
  timeout 60 "$@" > /dev/null 2> said
  found=$?
  mapfile -t told < said # of bash alone: this runs hundreds of times
  if [ "$found" != "$status" ]; then wrong "$claim" "status $found instead of $status: ${told[0]:-}"
  elif [ ${#told[@]} != 1 ]; then wrong "$claim" "${#told[@]} lines instead of one: ${told[*]:0:2}"
  elif [[ ${told[0]} != "${1##*/}: error: "* ]]; then wrong "$claim" "no error of ${1##*/}: ${told[0]}"
  elif ! named "${told[0]#*: error: }" "$fields"; then wrong "$claim" "no '$missing' in: ${told[0]}"
  elif [ "$(untouched)" != "$before" ]; then wrong "$claim" "files have changed"
  else ok "$claim"; fi
}

# --- coarse scenes through the flow of make, in a copy of the tree; what a stage is called with its artifact says
coarse='s/^element_mm = [^ ]*/element_mm = 1.5/; s/^modes = [^ ]*/modes = 21/; s/^element_order = [^ ]*/element_order = 1/; s/^torque_Nm = .*/torque_Nm = [100]/
  s/^mesh_frequency_Hz = .*/mesh_frequency_Hz = { from = 2000, to = 2100, step = 50 }/'
scenes=$(dirname "$scene_of_paper")
sed "$coarse" "$scene_of_paper" > scene.toml
sed 's/^title = .*/title = "A planetary train"/' "$scenes/lin-parker-planetary.toml" > scene-train.toml
sed 's/from = 1000, to = 5000, step = 50/from = 2000, to = 2100, step = 100/; $a [discretisation]\nelement_mm = 1.5\nelement_order = 1\npositions = 8\nsteps_per_period = 64' "$scenes/three-in-line.toml" > scene-inline.toml
printf '[gear.idler.modification]\ncrowning_um = 5\n[fidelity]\nmodes = 15\ncontact = "line"\n' >> scene-inline.toml
artifacts=(out/scene/pinion/{mesh,body}.h5 out/scene/T100/{static,impact,branch,fold_curves_torque,loaded_0.25}.h5 out/scene/T100/up/{runup_5000,sweep,response}.h5 out/scene/T100/pairs/up/sweep.h5
  out/scene-train/modes.h5 out/scene-inline/{modes,T60/static,T60/impact,T60/branch,T60/up/sweep,T60/up/response}.h5)
# $1 scene, others: what make is given beside the artifacts of that scene
made() { (cd tree && make_ SCENE="$1.toml" "${@:2}" $(printf '%s\n' "${artifacts[@]}" | grep "^out/$1/")); }
flow() {
  rm -rf tree/out out
  made scene FOLD_TORQUES='90 110' out/scene/T100/down/sweep.h5 && made scene-train report && made scene-inline report branches impact &&
    cp -a tree/out .
}
log=$work/log
(cd "$top" && copy_of_tree "$work/tree") && cp scene*.toml tree
if flow; then ok "coarse scenes run from end to end"; else
  wrong "coarse scenes run from end to end" "$(tail -n 1 log)"
  exit 1
fi
first=$(cd out && contents)
if flow && [ "$(cd out && contents)" = "$first" ]; then ok "two runs give identical bytes"; else
  wrong "two runs give identical bytes" "$(diff <(echo "$first") <(cd tree && contents) | sed -n 's/^> [0-9a-f]* *//p' | tr '\n' ' ')"; fi
rm -r tree log
command_of() { "$bin/gear-inspect" "$1" | sed -n "s|^ *made by [^:]*: |$bin/|p"; }
scene_command="$bin/gear-scene --scene scene.toml --output scene.mk --out out"
up_sweep=$(command_of out/scene/T100/up/sweep.h5)
sweep() { echo "${up_sweep//up/$2}"; }
of_pairs=$(command_of out/scene/T100/pairs/up/sweep.h5)
lumped() { sed "s|--model pairs|--model $1|; s|T100/pairs/|T100/${1%% *}/|; s|--mass [^ ]* ||" <<< "$of_pairs"; }
read -ra stage_reduce <<< "$(command_of out/scene/pinion/body.h5)"
read -ra stage_impact <<< "$(command_of out/scene/T100/impact.h5)"
read -ra stage_system <<< "$(command_of out/scene-inline/T60/static.h5)"
read -ra stage_system_sweep <<< "$(command_of out/scene-inline/T60/up/sweep.h5)"
read -ra stage_orbit <<< "$(command_of out/scene/T100/branch.h5)"
pair=(--body pinion=out/scene/pinion/body.h5 --body wheel=out/scene/wheel/body.h5)
measured_pair="${pair[*]} --static out/scene/T100/static.h5 --reference-static out/scene/T100/static.h5"
stage_spectra="$(command_of out/scene/T100/up/response.h5)"
stage_map=("$bin/gear-jump-map" --params out/scene/params/map.toml --static-params out/scene/params/static.toml "${pair[@]}" --torque 100
  --contact line --corner-contact false --damping-ratio 0.05,0.1 --from 2700 --to 2900 --step 100 --loads-at 2800 --output out/scene/T100/jump_map_false.h5)
artifacts+=(out/scene/T100/jump_map_false.h5)
"${stage_map[@]}" > said 2>&1 || wrong "a map of jumps" "$(tail -n 1 said)"
if found=$(grep -l -r -F "$work" out); [ -z "$found" ]; then ok "no artifact holds a path of the machine"; else
  wrong "no artifact holds a path of the machine" "$found"; fi
for artifact in "${artifacts[@]}"; do
  if "$bin/gear-inspect" $artifact > said 2>&1 && [ -s said ]; then ok "gear-inspect ${artifact##*/}"; else
    wrong "gear-inspect ${artifact##*/}" "$(head -n 1 said)"; fi
  if ! command -v h5ls > /dev/null; then echo "skipped: units of ${artifact##*/} (h5ls is not installed)"; continue; fi
  bare=$(h5ls -rv $artifact 2> /dev/null | awk '
    function judge() { if (dataset != "" && units + long_name + (axes || scalar) < 3) print dataset }
    /^\// { judge()
      dataset = $2 == "Dataset" && $1 !~ /^\/(provenance|VTKHDF)/ ? $1 : ""; scalar = $3 == "{SCALAR}"
      units = long_name = axes = 0; seen += dataset != "" }
    /Attribute: units/ { units = 1 }
    /Attribute: long_name/ { long_name = 1 }
    /Attribute: axes/ { axes = 1 }
    END { judge(); if (!seen) print "no datasets" }' | tr '\n' ' ')
  claim="every dataset of ${artifact##*/} has units, a long name and, unless it is one number, axes"
  if [ -z "$bare" ]; then ok "$claim"; else wrong "$claim" "$bare"; fi
done

# --- every program's --help ends with examples, and they run, in the order of the flow on a coarse pair of the paper's name
mkdir -p examples/data/scenes
ln -s "$(dirname "$plots")" examples/pipelines
cp -r "$(dirname "$scene_of_paper")"/../{studies,published,examples} examples/data/
sed "$coarse; s/^torque_Nm = .*/torque_Nm = [100, 150]/; s/from = 2000, to = 2100/from = 2350, to = 2400/" "$scene_of_paper" > examples/data/scenes/parker2000.toml
cp "$(dirname "$scene_of_paper")/lin-parker-planetary.toml" examples/data/scenes/
# A system of elastic gears, in whose folder examples look.
cp scene-inline.toml examples/data/scenes/three-in-line.toml
in_line() { command_of "out/scene-inline/$1" | sed 's/scene-inline/three-in-line/g'; }
(cd examples && "$bin/gear-scene" --scene data/scenes/three-in-line.toml --output three-in-line.mk --out out && cp -r ../out/bodies/. out/bodies/ && $(cd ..; in_line T60/static.h5) && $(cd ..; in_line modes.h5)) > /dev/null 2>&1 || wrong "a system for the examples" "it is not made"
flow="scene mesh reduce static impact sweep spectra lumped harris jump-map loaded animate plot inspect scorecard report study variant"
examples_of() { "$bin/$1" --help | sed '1,/^Examples\{0,1\}:$/d; s/^ *//; /^$/d'; }
run_example() { (cd examples && eval "timeout 120 $bin/$1") > said 2>&1 < /dev/null; }
# Examples write here, because what make has made bears make's command: as_made <name> <path> puts it where later ones read it.
as_made() {
  local e
  mkdir -p "$(dirname "examples/out/parker2000/$2")"
  for e in hdf h5; do [ ! -e "examples/$1.$e" ] || mv "examples/$1.$e" "examples/out/parker2000/$2.$e"; done
}
for program in $(sed 's/\<[a-z]/gear-&/g; s/-gear-/-/g' <<< "$flow") $(cd "$bin" && echo gear-*); do
  case " ${tried:-} " in *" $program "*) continue ;; esac
  tried="${tried:-} $program"
  claim="the examples in $program --help run"
  examples_of "$program" > examples/lines
  cat examples/lines >> examples/all
  grep -m1 parker2000 examples/lines > examples/pair
  [ -s examples/lines ] || wrong "$claim" "there are none; end it with 'Example:' and a command line of the default scene"
  broken=
  while read -r line; do run_example "$line" || broken="$line: $(tail -n 1 said)"; done < examples/lines
  if [ -z "$broken" ]; then [ ! -s examples/lines ] || ok "$claim"; else wrong "$claim" "$broken"; fi
  # what later examples read besides
  case $program in
    gear-mesh) as_made mesh pinion/mesh ;;
    gear-reduce) as_made body pinion/body ;;
    gear-static) as_made static T150/static; run_example "$(sed 's/150/100/g' examples/pair)"; as_made static T100/static
      # a second design, of the same bodies
      sed 's/^centre_distance_mm = 150.0/centre_distance_mm = 150.05/' examples/data/scenes/parker2000.toml > examples/data/scenes/parker2000-longer.toml
      run_example 'gear-scene --scene data/scenes/parker2000-longer.toml --output longer.mk --out out'
      run_example "$(sed 's|out/parker2000/|out/parker2000-longer/|g' examples/pair)"; as_made static ../parker2000-longer/T150/static ;;
    gear-sweep) as_made sweep T150/up/sweep; run_example "$(sed 's/\<up\>/down/g' examples/pair)"; as_made sweep T150/down/sweep ;;
    gear-spectra) as_made response T150/up/response; run_example "$(sed 's/\<up\>/down/g' examples/lines)"; as_made response T150/down/response ;;
  esac
done

found=$(cd "$bin" && for program in gear-*; do "./$program" --help | grep -n -o -i -w -E 'rungs?|rooms?|ledger|foretold|answers?|march|told|held|settles?|secants|fragments?|hashes' | sed "s/^/$program: /"; done | tr '\n' ' ')
[ -z "$found" ] && ok "--help speaks of gears, not of the insides" || wrong "--help speaks of gears, not of the insides" "$found"
grep -q '^# .*gaps are drawn wider than at scale' examples/animation.tsv && ok "an animation says what is drawn wider than at scale" ||
  wrong "an animation says what is drawn wider than at scale" "$(head -n 4 examples/animation.tsv 2>&1 | tr '\n' ' ')"

# Stage parameters and fragments of make are as good by hand; artifacts bear the command that made them.
found=$(grep -o -E -- '--output out/[^ ]*' examples/all | tr '\n' ' ')
[ -z "$found" ] && ok "no example writes an artifact where make puts its own" || wrong "no example writes an artifact where make puts its own" "$found"

# --- what ParaView sees
if /usr/bin/python3 -c 'from vtkmodules.vtkIOHDF import vtkHDFReader' 2> /dev/null && command -v h5dump > /dev/null; then
  at=examples/out/parker2000
  load=$(h5dump -d /tooth_load -y -w 0 examples/loaded.h5 | awk '/DATA/ { on = 1; next } on && /}/ { exit } on { gsub(",", " "); for (i = 1; i <= NF; i++) sum += $i } END { print sum }')
  /usr/bin/python3 "$tests/vtk_reads.py" $at/pinion/mesh.hdf $at/pinion/body.hdf examples/loaded.hdf "$load" 0.0254 out/scene-inline/modes.hdf 2> said || wrong "VTK reads the artifacts" "$(tail -n 1 said)"
else echo "skipped: VTK reads mesh, mode shapes and loaded gears (make deps-vtk installs it)"; fi
rm -rf examples

# --- the command line
declare -A whole=([gear-scene]="$scene_command" [gear-jump-map]="${stage_map[*]}" [gear-plot]="$bin/gear-plot fig12 --plots $plots --output fig12 out/scene/T100/static.h5"
  [gear-scorecard]="$bin/gear-scorecard --printed $claims --output x out/scene/T100/static.h5"
  [gear-report]="$bin/gear-report out/scene/T100/static.h5 --output x"
  [gear-inspect]="gear-inspect out/scene/T100/static.h5"
  [gear-sound]="$bin/gear-sound --sweep out/scene/T100/up/sweep.h5 --mesh-frequency 2000 --output x"
  [gear-compare]="$bin/gear-compare out/scene/T100/static.h5 --output x"
  [gear-export]="$bin/gear-export --model $scene_of_paper out/scene/T100/static.h5 --output x.rexs"
  [gear-import]="$bin/gear-import --input $scene_of_paper --output x.toml"
  [gear-animate]="$bin/gear-animate --mesh pinion=out/scene/pinion/mesh.h5 --mesh wheel=out/scene/wheel/mesh.h5 --plots $plots --sweep out/scene/T100/up/sweep.h5 --output x"
  [gear-study]="$bin/gear-study --study scene.toml --output study.mk"
  [gear-reading]="$bin/gear-reading --printed $claims --plan scene.toml --output x"
  [gear-variant]="$bin/gear-variant --params out/scene/params/static.toml --body pinion=out/scene/pinion/body.h5 --body wheel=out/scene/pinion/body.h5 --output x"
  [gear-harris]="gear-harris --static-params out/scene/params/static.toml --body pinion=out/scene/pinion/body.h5 --body wheel=out/scene/pinion/body.h5 --design-torque 100 --output x")
for artifact in "${artifacts[@]}"; do
  made_by=$(command_of "$artifact")
  program=${made_by%% *}
  [ -n "${whole[${program##*/}]:-}" ] || whole[${program##*/}]=$made_by  # of a program of pairs and trains the pair's
done
for program in "$bin"/gear-*; do
  name=$(basename "$program")
  "$program" --help > said 2>&1 && grep -q -- --help said && ok "$name --help" || wrong "$name --help" "$(head -n 1 said)"
  "$program" --version > said 2>&1 && grep -q '[0-9]\.[0-9]' said && ok "$name --version" || wrong "$name --version" "$(head -n 1 said)"
  rejected "$name rejects an unknown option" 2 --no-such-option ${whole[$name]/#gear-/$bin/gear-} --no-such-option
done
# Links and other spellings of a path are the same file.
ln -s pinion/body.h5 out/scene/linked.h5
while read -r name file; do
  rejected "$name does not write over its input $file" 2 "--output input" ${whole[$name]%--output*} --output $file
done << 'CASES'
gear-scene scene.toml
gear-mesh out/scene/pinion/body.toml
gear-reduce ./out/scene/pinion/mesh.h5
gear-reduce out/scene/pinion/body.toml
gear-static out/scene/wheel/body.h5
gear-static out/scene/linked.h5
gear-impact out/scene/T100/static.h5
gear-sweep out/scene/../scene/T100/static.h5
gear-spectra out/scene/T100/up/sweep.h5
gear-runup out/scene/T100/static.h5
gear-report out/scene/T100/static.h5
gear-export out/scene/T100/static.h5
gear-compare out/scene/T100/static.h5
CASES
rejected "teeth without sweeps" 3 'teeth response.h5 up 100' "$bin/gear-report" --teeth out/scene/T100/static.h5 --output x.html
rejected "one design has nothing to be compared with" 3 'compare 1 two' "$bin/gear-compare" out/scene/T100/static.h5 --output x.html
rejected "a figure that is not against speed has no axis in rpm" 2 'speed pair' "$bin/gear-plot" fig12 --axis rpm:driver --plots "$plots" --output x out/scene/T100/static.h5
rm out/scene/linked.h5
rejected "a map without a damping" 3 'no case damping ratios' $(sed 's/--damping-ratio [^ ]* //' <<< "${stage_map[*]}")
rejected "a map with a damping ratio that is no number" 2 "--damping-ratio much" "${stage_map[@]/0.05,0.1/much}"
rejected "a map with a corner rule that is none" 2 "--corner-contact sometimes" "${stage_map[@]/false/sometimes}"
rejected "a map with an angle beyond a right one" 2 '--corner-contact 91 0 90' "${stage_map[@]/false/91}"
rejected "a map whose loads are wanted outside its speeds" 3 '2400 2700' "${stage_map[@]/2800/2400}"
"$bin/gear-scene" --scene scene.toml --set bore_radius_mm=35 --set corner_contact=false --variant scene_variant.toml > said 2>&1
[ "$(grep -c -E '^(bore_radius_mm = 35|corner_contact = false)$' scene_variant.toml)" = 2 ] && ok "gear-scene --set writes a variant" ||
  wrong "gear-scene --set writes a variant" "$(head -n 1 said)"
rejected "a change of a key that no scene has" 2 "--set bore_radius bore_radius_mm" "$bin/gear-scene" --scene scene.toml --set bore_radius=35 --variant scene_x.toml
rejected "a change without a variant to write" 2 '--set --variant' "$bin/gear-scene" --scene scene.toml --set bore_radius_mm=35
"$bin/gear-scene" --scene scene.toml --set bore_radius_mm=90 --variant scene_wide.toml > said 2>&1
rejected "a variant that cannot be" 3 'scene_wide.toml:* bore_radius_mm 90' "$bin/gear-scene" --scene scene_wide.toml --output wide.mk --out out
"$bin/gear-plot" jump-map --plots "$plots" --output map out/scene/T100/jump_map_false.h5 > said 2>&1 && grep -q 'no corner contact' map.svg &&
  ok "a map of one torque is drawn" || wrong "a map of one torque is drawn" "$(head -n 1 said)"
rm -f map.* scene_variant.toml scene_wide.toml
rejected "decibels re nothing" 2 '--db 0' "$bin/gear-plot" waterfall --plots "$plots" --db 0 --output cuts out/scene/T100/up/sweep.h5 out/scene/T100/down/sweep.h5
rejected "a speed of no gear" 2 'carrier pinion wheel' "$bin/gear-plot" waterfall --plots "$plots" --axis rpm:carrier --output cuts out/scene/T100/up/sweep.h5 out/scene/T100/down/sweep.h5
rejected "two modes.h5 in the report of a system" 2 'whine/modes second' "$bin/gear-report" out/scene-inline/modes.h5 out/scene-inline/../scene-inline/modes.h5 --output x.html
rejected "a sweep of a system without its statics in a report" 3 'static.h5' "$bin/gear-report" out/scene-inline/modes.h5 out/scene-inline/T60/up/response.h5 --output x.html
rejected "two sweeps of a system in one direction in a report" 3 'response.h5 up twice' "$bin/gear-report" out/scene-inline/T60/static.h5 out/scene-inline/modes.h5 out/scene-inline/T60/up/response.h5 out/scene-inline/../scene-inline/T60/up/response.h5 --output x.html
rejected "artifacts of a pair in the report of a system" 3 'out/scene/T100/static.h5 scene' "$bin/gear-report" out/scene-inline/modes.h5 out/scene/T100/static.h5 --output x.html
rejected "artifacts of two systems in a report" 3 'scene-train scene-inline' "$bin/gear-report" out/scene-inline/T60/static.h5 out/scene-train/modes.h5 --output x.html
rejected "load sharing of a system without planets" 3 'planets' "$bin/gear-plot" load-sharing --plots "$plots" out/scene-inline/T60/static.h5 --output x
rejected "two static.h5 of one torque in a report" 3 'static.h5 100 twice' "$bin/gear-report" out/scene/T100/static.h5 out/scene/../scene/T100/static.h5 --output x.html
mkdir -p other_scene/params other_scene/T100 && cp out/scene/T100/static.h5 other_scene/T100 && echo Other > other_scene/params/title.txt
rejected "two scenes in an export" 3 'other_scene/T100/static.h5 other_scene Other scene' "$bin/gear-export" --model "$scene_of_paper" \
  out/scene/T100/static.h5 other_scene/T100/static.h5 --output x.rexs
rm -r other_scene
rejected "a map of the same torque and rule twice" 3 'two 100' "$bin/gear-plot" jump-map --plots "$plots" --output map \
  out/scene/T100/jump_map_false.h5 out/scene/T100/jump_map_false.h5
rejected "the sensitivity to nothing" 3 'one variant' "$bin/gear-plot" sensitivity --plots "$plots" --output map out/scene/T100/jump_map_false.h5

# --- an option in front of the list of inputs takes one word, as make gives it
$(sed 's/ up / down /; s|/up/|/down/|g' <<< "$stage_spectra") > /dev/null 2>&1
if "$bin/gear-plot" order-cuts --plots "$plots" --output levels --db 1e-6 out/scene/T100/up/response.h5 out/scene/T100/down/response.h5 > said 2>&1 &&
  grep -q 're 1 µm' levels.tsv; then ok "order cuts in dB"; else wrong "order cuts in dB" "$(tail -n 1 said)"; fi
rm -f levels.*; rm -f out/scene/T100/down/response.h5

# --- progress within one speed
WHINE_PROGRESS_SECONDS=0 $(sweep scene up | sed 's|--output .*|--output x.h5|') 2> said
if grep -q -E '^gear-sweep up: 0 of 3 after [0-9.]+ min; 2000 Hz; mesh period [0-9]+ of at most 3000$' said; then ok "a sweep says how far it is within one speed"; else
  wrong "a sweep says how far it is within one speed" "$(head -n 2 said | tr '\n' ' ')"; fi
rm -f x.h5

# --- sound
sound=("$bin/gear-sound" --sweep out/scene/T100/up/sweep.h5 --mesh-frequency 2000 --seconds 0.1 --output heard)
for value in nan inf -inf; do
  rejected "a sound at the speed $value" 2 "--mesh-frequency $value" "${sound[@]/#2000/$value}"
  rejected "a sound of $value as full scale" 2 "--full-scale $value" "${sound[@]}" "--full-scale=$value"
done
rejected "a sound at a speed that no sweep has" 3 '2001 2000' "${sound[@]/#2000/2001}"
rejected "a force on a bearing that is rigid" 2 'pinion:x <body>:x <body>:y' "${sound[@]}" --bearing pinion:x
printf 'frequency_Hz,magnitude,phase_deg\n1,1,0\n2,1,0\n' > low.csv
rejected "a sound of which a transfer function leaves nothing" 3 'up 24000 transfer' "${sound[@]}" --transfer low.csv
rejected "two such sounds" 3 'up heard' "${sound[@]}" --sweep out/scene/T100/down/sweep.h5 --transfer low.csv
if "${sound[@]}" --sweep out/scene/T100/down/sweep.h5 > said 2>&1 && [ "$(sed '1,2d' heard.tsv | cut -f1 | tr '\n' ' ')" = 'up down ' ]; then ok "a sound has a line for each branch"; else
  wrong "a sound has a line for each branch" "$(tail -n 1 said) $(cut -f1 heard.tsv 2>&1 | tr '\n' ' ')"; fi
rejected "a sound of one sweep twice" 2 './out/scene/T100/up/sweep.h5 out/scene/T100/up/sweep.h5 already' "${sound[@]}" --sweep ./out/scene/T100/up/sweep.h5
mkdir -p out/strange/T100/up && cp out/scene/T100/up/sweep.h5 out/strange/T100/up
rejected "a sound of a sweep in another scene's folder" 3 'out/strange/T100/up/sweep.h5 out/scene/params/sweep.toml out/strange' \
  "${sound[@]/#out\/scene/out/strange}"
rm -r out/strange
mkdir -p out/scene/T100/kept && mv out/scene/T100/up/runup_5000.h5 out/scene/T100/kept && cp out/scene/T100/kept/runup_5000.h5 out/scene/T100/down
rejected "a sound of a run-up in the folder of run-downs" 3 'out/scene/T100/down/runup_5000.h5 up down' "$bin/gear-sound" --runup out/scene/T100/down/runup_5000.h5 --output heard
rm out/scene/T100/down/runup_5000.h5; mv out/scene/T100/kept/runup_5000.h5 out/scene/T100/up; rmdir out/scene/T100/kept
rejected "a length of a sound of a run-up" 2 '--seconds --sweep' "$bin/gear-sound" --runup out/scene/T100/none.h5 --seconds 2 --output heard
rejected "a run-up and a sweep as one sound" 2 '--sweep --runup' "${sound[@]}" --runup out/scene/T100/none.h5
rejected "a sound of nothing" 2 '--sweep --mesh-frequency 0 --runup' "$bin/gear-sound" --output heard
rejected "a sound of a run-up that is a sweep" 3 'sweep.h5' "$bin/gear-sound" --runup out/scene/T100/up/sweep.h5 --output heard
rm -f low.csv heard.*
rejected "a direction that is none" 2 '--direction sideways' $(sweep scene up) --direction sideways
ring_down=("${stage_impact[@]::${#stage_impact[@]}-2}")
"${ring_down[@]}" --calibrate 0.05 --contact-state one > said 2> /dev/null
eta=$(sed -n 's/^rayleigh_stiffness_s = \([^ ]*\)  # damping ratio 0.05 .* one, .* undamped_depth_mm 0.5.*/\1/p' said)
sed "s/^rayleigh_stiffness = [^ ]*/rayleigh_stiffness = ${eta:-none}/" out/scene/params/impact.toml > calibrated.toml
"$bin/gear-impact" --params calibrated.toml $measured_pair --output calibrated.h5 > said 2>&1
if grep -q 'one [0-9.]* Hz 5.000 %' said; then ok "the eta that gear-impact prints gives the damping ratio that was asked for"; else
  wrong "the eta that gear-impact prints gives the damping ratio that was asked for" "$(head -n 1 said)"; fi
rm -f calibrated.*
rejected "a ring-down without --output or --calibrate" 2 '--output --calibrate' "${ring_down[@]}"
rejected "a ring-down with both" 2 '--output --calibrate' "${stage_impact[@]}" --calibrate 0.05
rejected "a torque step above a half" 3 'step 0.6' "${stage_impact[@]}" --torque-step 0.6
rejected "a ring-down so large that contact comes and goes" 1 'exponentials decay' "${stage_impact[@]}" --torque-step 0.5
rejected "a damping ratio that no eta gives" 3 '0.9 largest' "${ring_down[@]}" --calibrate 0.9
rejected "a contact state that does not occur" 3 "five one two mean" "${ring_down[@]}" --calibrate 0.05 --contact-state five
at_torque=("$bin/gear-static" --params out/scene/params/static.toml "${pair[@]}" --output x.h5 --torque)
for torque in ten nan inf 0x10 '' '100 ' 1e999; do
  rejected "a torque of '$torque', which is no finite number" 2 "--torque" "${at_torque[@]}" "$torque"; done
rejected "a torque below zero" 3 'torque_Nm -5' "${at_torque[@]}" -5
rejected "a torque that moves teeth far" 3 '400000 0.75 quarter' "${at_torque[@]}" 400000
for stage in static sweep impact; do
  mkdir -p line; sed 's/^contact = .*/contact = "line"/' out/scene/params/$stage.toml > line/$stage.toml; done
mkdir -p full; for stage in sweep impact; do sed 's/^body = .*/body = "full"/' out/scene/params/$stage.toml > full/$stage.toml; done
line_static=("$bin/gear-static" --params line/static.toml "${pair[@]}" --torque 100 --output line/static.h5)
if "${line_static[@]}" --next-level > said 2>&1 && grep -q ' 8 strips change, elsewhere' said; then ok "gear-static --next-level"; else
  wrong "gear-static --next-level" "$(head -n 1 said)"; fi
budget=("$bin/gear-static" --params out/scene/params/static.toml "${pair[@]}" --torque 100 --error-budget --output budget.h5)
if "${budget[@]}" > said 2>&1 && grep -q -E '^gear-static: largest root stress of wheel changes by (-?[0-9.e-]+, )+-?[0-9.e-]+ % each time .* halved(; order at last [0-9.]+|; the last changes do not shrink)?$' said && "$bin/gear-inspect" budget.h5 > said 2>&1 && grep -q '^ *or contact line ' said &&
  grep -q '^ *or matching at 1 mm ' said && "$bin/gear-plot" error-budget --plots "$plots" --output budget budget.h5 > said 2>&1 &&
  grep -q '>matching<' budget.svg && grep -q '>at 1 mm<' budget.svg && grep -q -P '^curve\terror .*\tmean_stiffness .%.' budget.tsv && grep -q -P '^strips 8 to 16\t1\t' budget.tsv && [ "$(grep -c '^largest root stress' budget-roots.tsv)" = 4 ]; then ok "gear-static --error-budget, with the other choices apart, and its figure"; else
  wrong "gear-static --error-budget, with the other choices apart, and its figure" "$(head -n 1 said)"; fi
rm -f budget.*
rejected "the next model level of the last one" 3 'last level' "${at_torque[@]}" 100 --next-level
rejected "a ring-down with one line per pair" 3 'contact line [fidelity] ring-downs strips' \
  $(sed 's|out/scene/params|line|; s|out/scene/T100/static|line/static|g' <<< "${stage_impact[*]}")
rejected "a sweep on a static result of another contact" 3 'contact line strips' \
  $(sweep scene up | sed 's|--static out/scene/T100|--static line|')
rejected "a sweep whose dampers come from another contact" 3 'line/static.h5 contact line' \
  $(sweep scene up | sed 's|--reference-static out/scene/T100|--reference-static line|')
line_sweep="$(sweep scene up | sed 's|out/scene/params|line|; s|--output .*|--output line/sweep.h5|')"
rejected "a sweep with one line per pair from statics on strips" 3 'contact strips line' $line_sweep
if ${line_sweep//out\/scene\/T100/line} > said 2>&1 && [ -s line/sweep.h5 ]; then ok "a sweep with one line per pair"; else
  wrong "a sweep with one line per pair" "$(head -n 1 said)"; fi
sed -i 's/^body = .*/body = "relaxed"/' line/sweep.toml
if ${line_sweep//out\/scene\/T100/line} --next-level > said 2>&1 && grep -q 'contact = "line" against "strips" at 3 speeds' said &&
  grep -q 'body = "relaxed" against "modal": jumps none against none' said; then ok "gear-sweep --next-level"; else
  wrong "gear-sweep --next-level" "$(head -n 1 said)"; fi
rejected "a branch from a sweep's motion without its speed" 2 '--from-sweep --at together' "${stage_orbit[@]}" --from-sweep up
rejected "a branch from a speed outside the scene's" 3 '900 mesh_frequency_Hz 2000' "${stage_orbit[@]}" --from-sweep up --at 900
# One program, pairs and trains: options that one of them alone has.
rejected "a torque for a train" 2 '--torque train drives' "${stage_system[@]}" --torque 60
rejected "statics for the sweep of a train" 2 '--static train' "${stage_system_sweep[@]}" --static out/scene-inline/T60/static.h5
rejected "another level for the sweep of a train" 2 '--next-level train' "${stage_system_sweep[@]}" --next-level
rejected "modes of a pair that rings down" 2 '--modes pair' "${stage_impact[@]}" --modes 3
rejected "a pair at rest without a torque" 2 '--torque needed pair' "$bin/gear-static" --params out/scene/params/static.toml "${pair[@]}" --output x.h5
rejected "a branch of a pair without its statics" 2 '--static needed pair' "$bin/gear-orbit" --params out/scene/params/sweep.toml "${pair[@]}" --output x.h5
rejected "parameters of another stage of a train" 3 'sweep statics system params/static.toml' "${stage_system[@]/static.toml/sweep.toml}"
rejected "a branch of three mesh periods" 3 '1 2 4' "${stage_orbit[@]}" --periods 3
if "${stage_orbit[@]/out\/scene\/T100\/branch.h5/line\/branch.h5}" --from-sweep up --at 2050 --periods 2 > said 2>&1 &&
  "$bin/gear-inspect" line/branch.h5 | grep -q 'reached 2000 Hz; the mesh frequency reached 2100 Hz'; then ok "gear-orbit --from-sweep goes both ways"; else
  wrong "gear-orbit --from-sweep goes both ways" "$(head -n 1 said)"; fi
rejected "jumps located to nothing" 3 'jumps -1' $(sweep scene up) --jump-width -1
rejected "the next model level of a sweep on the last ones" 3 'contact strips body full last' \
  $(sweep scene up | sed 's|out/scene/params|full|') --next-level
rejected "every mode from a body with some" 3 'every mode modes' $(sweep scene up | sed 's|out/scene/params|full|')
rejected "a ring-down with every mode" 3 'body full [fidelity] ring-downs modal' "${stage_impact[@]//out\/scene\/params/full}"
rm -rf line full
for range in 'from = 3000.0, to = 2000.0, step = 50.0' 'from = 2000.0, to = 3000.0, step = 0.0'; do
  mkdir -p bad; sed "s/from = .*/$range }/" out/scene/params/sweep.toml > bad/sweep.toml
  rejected "stage parameters with the speeds $range" 3 'mesh_frequency' $(sweep scene up | sed 's|out/scene/params|bad|'); done
rm -rf bad
# --- sweeps that run and say what is out of the ordinary: <claim> | <pattern> | <sed script on the stage parameters>
while IFS='|' read -r claim pattern script; do
  mkdir -p said_of; sed -E "$script" out/scene/params/sweep.toml > said_of/sweep.toml
  $(sweep scene up | sed 's|out/scene/params|said_of|; s|--output .*|--output said_of/sweep.h5|') > /dev/null 2> said
  status=$?
  if [ $status = 0 ] && grep -q -E "^gear-sweep: $pattern" said; then ok "$claim"; else wrong "$claim" "status $status: $(tr '\n' '|' < said)"; fi
  rm -rf said_of
done << 'CASES'
a time step too long for the contact|warning: a time step is too long for the contact: 5\.[0-9]+ steps per oscillation|s/^steps_per_period = .*/steps_per_period = 8/; s/^min_sample_rate = .*/min_sample_rate = 0.0/
a default damping that is not for these gears|warning: rayleigh_stiffness_s = 7.7e-06, the default, .* about 0.8[0-9]{2} %.*make SCENE=.* calibrate|s/^total_inertia = .*/total_inertia = 1.0/
a motion that repeats after two mesh periods|at 6000 Hz the motion is subharmonic: it repeats after 2 mesh periods|s/^rayleigh_stiffness = .*/rayleigh_stiffness = 2e-6/; s/from = .*/from = 6000.0, to = 6000.0, step = 100.0 }/
a motion that never repeats|warning: at 6000 Hz the motion is not periodic after 3000 mesh periods; the state still changes by [0-9.]+ per|s/^rayleigh_stiffness = .*/rayleigh_stiffness = 2e-7/; s/^bearing_ratio = .*/bearing_ratio = 0.0001/; s/from = .*/from = 6000.0, to = 6000.0, step = 100.0 }/
CASES
if grep -q -E 'warning|subharmonic' <<< "$($(sweep scene up) 2>&1)"; then wrong "an ordinary sweep warns of nothing" "$($(sweep scene up) 2>&1)"; else
  ok "an ordinary sweep warns of nothing"; fi

# --- the scorecard
mkdir -p card/s
"$bin/gear-scorecard" --files > files
while read -r file; do mkdir -p "card/s/$(dirname "$file")"; cp out/scene/T100/up/response.h5 "card/s/$file"; done < files
card=("$bin/gear-scorecard" --printed "$claims" --output card/x $(sed 's|^|card/s/|' files))
rejected "a scorecard from a sweep that is not that of its path" 3 'card/s/T100/down/response.h5 up' "${card[@]}"
cp out/scene/T100/static.h5 card/s/T100/down/response.h5
rejected "a scorecard from an artifact of another kind" 3 'card/s/T100/down/response.h5' "${card[@]}"
rejected "a scorecard from part of a scene" 3 'T100/impact.h5 s card/s/T100/impact.h5' "${card[@]:0:6}"
mkdir -p out/s/T100; cp out/scene/T100/static.h5 out/s/T100
rejected "a scorecard from part of a scene of make" 3 'T100/down/response.h5 s make out/s/T100/down/response.h5' \
  "$bin/gear-scorecard" --printed "$claims" --output card/x out/s/T100/static.h5
rm -r out/s
rejected "a scorecard from a file that no claim reads" 3 'card/s/T100/mesh.h5 claim' "${card[@]}" card/s/T100/mesh.h5
rejected "a scorecard without artifacts" 2 'artifacts scene' "$bin/gear-scorecard" --printed "$claims" --output card/x
rm -rf card files

# --- lumped models
for model in rectangular secant tangent "pairs --hertz"; do
  if $(lumped "$model" | sed 's|--output .*|--output lumped_sweep.h5|') > said 2>&1 && "$bin/gear-spectra" --input lumped_sweep.h5 --output lumped.h5 > said 2>&1 &&
    "$bin/gear-inspect" lumped.h5 > said 2>&1 && grep -q "${model/ --/-}" said; then ok "gear-lumped $model, and gear-spectra reads it"; else
    wrong "gear-lumped $model, and gear-spectra reads it" "$(tail -n 1 said)"; fi
done
rm -f lumped.h5 lumped_sweep.h5
# The exact folds of Eq. 23 at 150 N m do not depend on the torque; here they come out of the programs.
levels=(--levels 335596523.71,504267825.43 --duty 0.75)
folds=($(lumped rectangular) --mass 1.4 "${levels[@]}" --from 2600 --to 2740)
"${folds[@]}" --step 20 > said 2>&1; "${folds[@]/#up/down}" --step 20 >> said 2>&1
if grep -q 'up, .* jumps at 2679.466' said && grep -q 'down, .* jumps at 2662.046' said; then ok "gear-lumped: folds of the rectangular wave, expected 2679.466 and 2662.046 Hz"; else
  wrong "gear-lumped: folds of the rectangular wave, expected 2679.466 and 2662.046 Hz" "$(grep -o 'jumps at.*->' said | tr '\n' ' ')"; fi
wide=("${folds[@]/%2600/2400}")
timeout 60 "${wide[@]/%2740/3000}" --step 150 > said 2>&1
if grep -q 'up, .* jumps at 2679.466' said; then ok "and at steps of 150 Hz, whose parts of 1e-7 Hz an int does not count"; else wrong "and at steps of 150 Hz" "$(tail -n 1 said)"; fi
rm -r out/scene/T100/rectangular # the falling sweep lies in the folder of the rising one
lumped_map=("$bin/gear-lumped" --map --model secant --damper contact --static out/scene/T100/static.h5 --params out/scene/params/lumped_map.toml
  --damping-ratio 0.05,0.1 --from 2700 --to 2900 --step 100 --loads-at 2800 --output lumped_map.h5)
if "${lumped_map[@]}" > said 2>&1 && "$bin/gear-inspect" lumped_map.h5 > said 2>&1 && grep -q 'secant-contact' said &&
  "$bin/gear-plot" jump-map-lumped --plots "$plots" --output map lumped_map.h5 > said 2>&1 && grep -q 'secant, damper in contact' map.svg; then
  ok "gear-lumped --map, and its figure"; else wrong "gear-lumped --map, and its figure" "$(tail -n 1 said)"; fi
rejected "a map of lumped models without one" 3 'lumped artifacts one' "$bin/gear-plot" jump-map-lumped --plots "$plots" --output map out/scene/T100/jump_map_false.h5
rejected "a direction for a map" 2 '--direction --map' "${lumped_map[@]}" --direction up
rejected "neither a direction nor a map" 2 '--direction sweep --map' $(lumped pairs | sed 's/--direction up//')
rejected "two damping ratios for one sweep" 2 '2 --map' $(lumped pairs) --damping-ratio 0.05,0.1
rejected "loads at a speed of a sweep" 2 '--loads-at --map' $(lumped pairs) --loads-at 2400
rejected "a map with a step of zero" 2 'step 0' "${lumped_map[@]/#100/0}"
rejected "a map of an undamped model" 3 'damping 0' "${lumped_map[@]/#0.05,0.1/0}"
rm -f lumped_map.h5 map.*
rejected "a lumped model that is none" 2 '--model cubic' $(lumped pairs) --model cubic
rejected "a lumped sweep without speeds" 2 '--params --from --to --step' $(lumped pairs | sed 's/--params [^ ]*//')
rejected "a lumped sweep with half a range" 2 '--from --to --step together' $(lumped pairs) --from 1000
rejected "a lumped sweep with no speed in its range" 3 '2000 1000' $(lumped pairs) --from 2000 --to 1000 --step 10
rejected "levels without their duty" 2 '--levels --duty' $(lumped rectangular) --levels 1e8,2e8
rejected "levels of another model" 2 '--levels --duty rectangular secant' $(lumped secant) "${levels[@]}"
rejected "a level that is not above 0" 3 'level -1' $(lumped rectangular) --levels=-1,2e8 --duty 0.5
rejected "a level that no tooth has" 3 'level 0.001 4*' $(lumped rectangular) --levels 1e-3,2e8 --duty 0.5
rejected "levels in the wrong order" 3 'second 100000000 first' $(lumped rectangular) --levels 2e8,1e8 --duty 0.5
rejected "Hertz's law of a curve" 2 '--hertz pairs secant' $(lumped secant) --hertz
rejected "a whole scene in place of the stage parameters of a lumped model" 3 'scene.toml out/scene/params/lumped.toml make SCENE=scene.toml' \
  $(lumped pairs | sed 's|out/scene/params/lumped.toml|scene.toml|')
rejected "a whole scene in place of the stage parameters of a map" 3 'scene.toml out/scene/params/map.toml' "${stage_map[@]/out\/scene\/params\/map.toml/scene.toml}"
rejected "the parameters of another stage" 3 'out/scene/params/static.toml static lumped out/<scene>/params/lumped.toml' $(lumped pairs | sed 's|params/lumped.toml|params/static.toml|')
rejected "stage parameters that are not there" 4 'nowhere.toml make out/<scene>/params/lumped.toml' $(lumped pairs | sed 's|out/scene/params/lumped.toml|nowhere.toml|')
rejected "an artifact that is not there, where make makes none" 4 'nowhere/static.h5 below out/' $(lumped pairs | sed 's|out/scene/T100/static.h5|nowhere/static.h5|')
rejected "a level that is no number" 2 "--levels many" $(lumped rectangular) --levels 1e8,many --duty 0.5
rejected "one level" 2 '--levels 100000000 two numbers' $(lumped rectangular) --levels 1e8 --duty 0.5
for duty in 0 1 1.5; do rejected "a duty of $duty" 3 "duty $duty" $(lumped rectangular) --levels 1e8,2e8 --duty $duty; done
rejected "a damping ratio in per cent" 3 'ratio 8' $(lumped pairs) --damping-ratio 8
rejected "a mass of zero" 3 'mass 0' $(lumped pairs) --mass 0
rejected "a damping ratio below zero" 3 'ratio -0.1' $(lumped pairs) --damping-ratio=-0.1
rejected "a torque that static.h5 does not hold" 3 '100 --torque 150' $(lumped pairs) --torque 150
rejected "half a cell" 2 '--cells 12.5' $(lumped secant) --cells 12.5
rejected "Newmark with a damper in contact only" 3 'exact integrator' $(lumped pairs) --integrator newmark --damper contact
rejected "a sweep in place of static.h5" 3 'sweep.h5' $(lumped pairs | sed 's|T100/static.h5|T100/up/sweep.h5|')

# --- scenes: <claim> | <fields of the message> | <sed script>
while IFS='|' read -r claim fields script; do
  [ -n "$claim" ] || continue
  sed -E "$coarse" "$scene_of_paper" | sed -E "$script" > scene_bad.toml
  rejected "scene: $claim" 3 "$fields" "$bin/gear-scene" --scene scene_bad.toml --output scene.mk --out out
done << 'CASES'
it is empty|gear|d
an unknown key|face_widht_mm|s/^face_width_mm/face_widht_mm/
an unknown section|dampling|s/^\[damping\]/[dampling]/
a missing key|module_mm|/^module_mm/d
a missing torque|torque_Nm|/^torque_Nm/d
a key twice|teeth|s/^teeth = 50/teeth = 50\nteeth = 51/
a negative module|module_mm|s/^module_mm = 3.0/module_mm = -3.0/
nan|face_width_mm|s/^face_width_mm = 25.4/face_width_mm = nan/
inf|youngs_modulus_GPa|s/^youngs_modulus_GPa = 207.0/youngs_modulus_GPa = inf/
a torque that is no number|torque_Nm|s/^torque_Nm = .*/torque_Nm = ["ten"]/
a speed below 1 Hz|from 1|s/from = [0-9]*/from = 0.5/
a step of zero|step 0|s/step = [0-9]*/step = 0/
a torque of zero|torque_Nm|s/^torque_Nm = .*/torque_Nm = [0]/
a list without torques|torque_Nm|s/^torque_Nm = .*/torque_Nm = []/
half a tooth|teeth|s/^teeth = 50/teeth = 50.5/
a near field that is none|near_field subtraction matching|s/^\[discretisation\]/[discretisation]\nnear_field = "penalty"/
a matching depth of zero|matching_depth_mm 0|s/^\[discretisation\]/[discretisation]\nnear_field = "matching"\nmatching_depth_mm = 0/
a matching depth without matching|scene_bad.toml:* matching_depth_mm near_field matching|s/^\[discretisation\]/[discretisation]\nmatching_depth_mm = 1.0/
speeds that go down|mesh_frequency_Hz|s/^mesh_frequency_Hz = .*/mesh_frequency_Hz = { from = 4000, to = 600, step = 20 }/
a material that is not there|stell|s/^material = "steel"/material = "stell"/
a gear that is not there|gear|s/^driven = "wheel"/driven = "wheell"/
a gear like itself|like|s/^like = "pinion"/like = "wheel"/
TOML that is none|scene_bad.toml|s/^teeth = 50/teeth = = 50/
a crack longer than the tooth|[gear.pinion]* depth_mm 20 most|s/^\[material.steel\]/[gear.pinion.crack]\ndepth_mm = 20\n&/
a crack in a tooth that is not there|tooth [gear.pinion.crack] 50 0 49|s/^\[material.steel\]/[gear.pinion.crack]\ntooth = 50\ndepth_mm = 2\n&/
a crack that starts off the fillet|start_deg 2 fillet|s/^\[material.steel\]/[gear.pinion.crack]\nstart_deg = 2\ndepth_mm = 2\n&/
CASES
rejected "scene: it is not there" 4 nowhere.toml "$bin/gear-scene" --scene nowhere.toml --output scene.mk --out out

# --- gears and pairs that cannot exist; whichever stage knows first has to say so
# impossible <claim> <pattern> <sed script>
impossible() {
  rm -rf scene_bad.toml bad
  sed -E "$coarse" "$scene_of_paper" | sed -E "$3" > scene_bad.toml
  cat > bad_chain << CHAIN
set -e
mkdir -p bad
$bin/gear-scene --scene scene_bad.toml --output bad/scene.mk --out bad > /dev/null 2> bad/said || { s=\$?; cat bad/said >&2; exit \$s; }
mkdir -p bad/scene_bad/T100/up
for step in "gear-mesh --params bad/scene_bad/pinion/body.toml --output bad/scene_bad/pinion/mesh.h5" \\
  "gear-mesh --params bad/scene_bad/wheel/body.toml --output bad/scene_bad/wheel/mesh.h5" \\
  "gear-reduce --params bad/scene_bad/pinion/body.toml --mesh bad/scene_bad/pinion/mesh.h5 --output bad/scene_bad/pinion/body.h5" \\
  "gear-reduce --params bad/scene_bad/wheel/body.toml --mesh bad/scene_bad/wheel/mesh.h5 --output bad/scene_bad/wheel/body.h5" \\
  "gear-static --params bad/scene_bad/params/static.toml --body pinion=bad/scene_bad/pinion/body.h5 --body wheel=bad/scene_bad/wheel/body.h5 --torque 100 --output bad/scene_bad/T100/static.h5" \\
  "gear-sweep --params bad/scene_bad/params/sweep.toml --body pinion=bad/scene_bad/pinion/body.h5 --body wheel=bad/scene_bad/wheel/body.h5 --static bad/scene_bad/T100/static.h5 --reference-static bad/scene_bad/T100/static.h5 --direction up --output bad/scene_bad/T100/up/sweep.h5"; do
  $bin/\$step > /dev/null 2> bad/said || { s=\$?; cat bad/said >&2; exit \$s; }
done
CHAIN
  timeout 60 bash bad_chain 2> said
  found=$?
  if [ $found != 3 ]; then wrong "$1" "status $found instead of 3: $(head -n 1 said)"
  elif [ "$(wc -l < said)" != 1 ]; then wrong "$1" "$(wc -l < said) lines: $(head -n 2 said | tr '\n' '|')"
  elif ! grep -q -i -E "^gear-[a-z]*: error: .*($2)" said; then wrong "$1" "no '$2' in: $(cat said)"
  else ok "$1 ($(cut -d: -f1 said))"; fi
  rm -rf said scene_bad.toml bad bad_chain
}
impossible "a pair that does not reach" 'reach|contact ratio' 's/^centre_distance_mm = .*/centre_distance_mm = 160.0/'
impossible "a pair that jams" 'jam|backlash' 's/^centre_distance_mm = .*/centre_distance_mm = 149.0/'
impossible "a contact ratio below 1" 'contact ratio' 's/^addendum = 1.0/addendum = 0.5/'
impossible "an inertia below the body's" 'inertia' 's/^total_inertia_kgm2 = .*/total_inertia_kgm2 = 0.001/'
impossible "a bore above the root" 'bore' 's/^bore_radius_mm = .*/bore_radius_mm = 74.0/'
impossible "an undercut flank" 'undercut' 's/^teeth = 50/teeth = 8/; s/^bore_radius_mm = .*/bore_radius_mm = 4.0/; s/^centre_distance_mm = .*/centre_distance_mm = 24.0/'
impossible "a pointed tooth" 'tip' 's/^addendum = 1.0/addendum = 2.5/; s/^dedendum = .*/dedendum = 3.0/; s/^bore_radius_mm = .*/bore_radius_mm = 30.0/; s/^rack_tip_radius = .*/rack_tip_radius = 0.05/'

impossible "a matching depth beyond the tooth" 'matching_depth_mm = 6 ' 's/^\[discretisation\]/[discretisation]\nnear_field = "matching"\nmatching_depth_mm = 6/'

# --- the near field matched at a depth: another body on the same mesh
sed -E "$coarse; s/^\[discretisation\]/[discretisation]\nnear_field = \"matching\"\nmatching_depth_mm = 1.25/" "$scene_of_paper" > scene_matched.toml
matched=out/scene_matched/pinion
"$bin/gear-scene" --scene scene_matched.toml --output matched.mk --out out > /dev/null 2>&1
if "$bin/gear-reduce" --params $matched/body.toml --mesh out/scene/pinion/mesh.h5 --output $matched/body.h5 > said 2>&1 &&
  grep -q 'near field by matching at 1.25 mm' said && "$bin/gear-inspect" $matched/body.h5 > said 2>&1 &&
  grep -q 'matching at 1.25 mm below the flank' said; then ok "gear-reduce matches at the depth of the scene, and body.h5 says so"; else
  wrong "gear-reduce matches at the depth of the scene, and body.h5 says so" "$(tail -n 1 said)"; fi
rm -f said

# --- a cracked tooth: another mesh and body of that gear alone, statics over a turn, no ring-down
sed -E "$coarse; s/^\[material.steel\]/[gear.pinion.crack]\ntooth = 3\ndepth_mm = 2\n&/" "$scene_of_paper" > scene_cracked.toml
cracked=out/scene_cracked
"$bin/gear-scene" --scene scene_cracked.toml --output cracked.mk --out out > /dev/null 2>&1
mkdir -p $cracked/T100
cracked_pair=(--body pinion=$cracked/pinion/body.h5 --body wheel=$cracked/wheel/body.h5)
if [ "$(readlink $cracked/wheel)" = "$(readlink out/scene/wheel)" ] && [ "$(readlink $cracked/pinion)" != "$(readlink out/scene/pinion)" ] &&
  "$bin/gear-mesh" --params $cracked/pinion/body.toml --output $cracked/pinion/mesh.h5 > said 2>&1 &&
  "$bin/gear-reduce" --params $cracked/pinion/body.toml --mesh $cracked/pinion/mesh.h5 --output $cracked/pinion/body.h5 > said 2>&1 &&
  "$bin/gear-static" --params $cracked/params/static.toml "${cracked_pair[@]}" --torque 100 --output $cracked/T100/static.h5 > said 2>&1 &&
  grep -q '50 mesh periods' said && "$bin/gear-plot" crack --plots "$plots" --output crack $cracked/T100/static.h5 > said 2>&1; then
  ok "a cracked tooth: mesh, body, statics over a turn and its figure"; else
  wrong "a cracked tooth: mesh, body, statics over a turn and its figure" "$(tail -n 1 said)"; fi
rejected "the mesh of a gear without the crack" 3 "tooth 0 3" "$bin/gear-reduce" \
  --params $cracked/pinion/body.toml --mesh out/scene/pinion/mesh.h5 --output $cracked/pinion/body.h5
rejected "a ring-down with a cracked tooth" 3 "gear.pinion.crack cracked" "$bin/gear-impact" --params $cracked/params/impact.toml "${cracked_pair[@]}" \
  --static $cracked/T100/static.h5 --reference-static $cracked/T100/static.h5 --output $cracked/T100/impact.h5
rejected "a lumped model of a cracked tooth" 3 "gear.pinion.crack cracked" "$bin/gear-lumped" --model secant --static $cracked/T100/static.h5 \
  --params $cracked/params/sweep.toml --direction up --output $cracked/T100/lumped.h5
rejected "root stress without two sweeps of one torque" 3 'two response.h5 static.h5 up down' "$bin/gear-plot" root-stress --plots "$plots" --output root \
  out/scene/T100/static.h5 out/scene/T100/up/response.h5 out/scene/T100/up/response.h5
{ cat out/scene/params/static.toml; printf '\n[friction]\nlaw = "constant"\ncoefficient = 0.05\nsmoothing = 0.01\nviscosity = 0.0\nroughness = 0.0\nlubricant_factor = 1.0\nstatic_frequency = 0.0\n'; } > friction.toml
if "$bin/gear-static" --params friction.toml "${pair[@]}" --torque 100 --output friction.h5 > said 2>&1 && "$bin/gear-inspect" friction.h5 > said 2>&1 &&
  grep -q 'efficiency 99[.][0-9]* % at a coefficient of friction of 0.05' said; then ok "friction at rest has an efficiency"; else wrong "friction at rest has an efficiency" "$(tail -n 1 said)"; fi
rejected "a lumped model with friction" 3 "friction" "$bin/gear-lumped" --model secant --static friction.h5 \
  --params out/scene/params/sweep.toml --direction up --output lumped.h5
rejected "losses of a pair without friction" 3 '[friction]' "$bin/gear-plot" efficiency --plots "$plots" --output losses \
  out/scene/T100/static.h5 out/scene/T100/up/response.h5 out/scene/T100/up/response.h5
rejected "a figure of a crack without one" 3 "[gear.<name>.crack]" "$bin/gear-plot" crack --plots "$plots" --output crack out/scene/T100/static.h5
rm -rf said crack.* cracked.mk "$(readlink -f $cracked/pinion)" $cracked

# --- artifacts: cut off, of another kind, of another version, not there
head -c 3000 out/scene/pinion/body.h5 > cut.h5
rejected "an artifact that is cut off" '4' 'cut.h5' "$bin/gear-static" --params out/scene/params/static.toml --body pinion=cut.h5 --body wheel=out/scene/wheel/body.h5 --torque 100 --output x.h5
: > empty.h5
rejected "an empty artifact" '4' 'empty.h5' "$bin/gear-spectra" --input empty.h5 --output x.h5
rejected "an artifact of another stage" 3 'static.h5' "$bin/gear-spectra" --input out/scene/T100/static.h5 --output x.h5
rejected "an artifact that is not there" '4' 'none.h5' "$bin/gear-spectra" --input none.h5 --output x.h5
mv out/scene/T100/up/sweep.h5 sweep_away.h5
"$bin/gear-inspect" out/scene/T100/up/response.h5 > said 2>&1
status=$?
if [ $status = 3 ] && grep -q 'MISSING; .*make SCENE=scene.toml out/scene/T100/up/sweep.h5' said; then ok "gear-inspect: an input that is missing is status 3"; else
  wrong "gear-inspect: an input that is missing is status 3" "status $status: $(grep input said)"; fi
mv sweep_away.h5 out/scene/T100/up/sweep.h5
if said=$("$bin/gear-inspect" --check out 2>&1) && [ -z "$said" ]; then ok "gear-inspect --check is silent when all is well"; else
  wrong "gear-inspect --check is silent when all is well" "$(head -n 1 <<< "$said")"; fi
# inspected <claim> <status> <extended pattern> <arguments of gear-inspect...>
inspected() {
  "$bin/gear-inspect" "${@:4}" > said 2>&1
  local status=$?
  if [ $status = $2 ] && grep -q -E "$3" said; then ok "$1"; else wrong "$1" "status $status: $(grep -E 'input|error' said | tr '\n' '|')"; fi
}
inspected "gear-inspect compares stage parameters with the scene of the folder" 0 'input params .* fresh: as the stage parameters and as scene.toml' out/scene/T100/static.h5
mv scene.toml away.toml
inspected "gear-inspect says that it knows no scene" 0 'input params .* not compared with a scene, give --scene' out/scene/T100/static.h5
mkdir -p data/scenes; sed "s/corner_contact = true/corner_contact = false/" away.toml > data/scenes/scene.toml
inspected "gear-inspect: a scene that says otherwise than the stage parameters is status 3" 3 'STALE: data/scenes/scene.toml says otherwise' out/scene/T100/static.h5
inspected "and leaves alone what does not depend on it" 0 'as data/scenes/scene.toml' out/scene/T100/impact.h5
rm -r data
sed 's/^corner_contact = true/corner_contact = false/' away.toml > scene.toml
inspected "an edited scene is told with the make that follows it" 3 'input params .* STALE: scene.toml says otherwise now; (delete it; )?rebuild it with: make SCENE=scene.toml out/scene/T100/static.h5' out/scene/T100/static.h5
"$bin/gear-inspect" --check out/scene/T100 > /dev/null 2> said && wrong "--check tells an edited scene" "silent" ||
  { grep -q 'static.h5: input params, .*STALE: scene.toml' said && ok "--check tells an edited scene" || wrong "--check tells an edited scene" "$(head -n 1 said)"; }
mv away.toml scene.toml
inspected "gear-inspect compares stage parameters with the scene" 0 'input params .* fresh: as the stage parameters and as scene.toml' out/scene/T100/static.h5 out/scene/pinion/body.h5 --scene scene.toml
inspected "gear-inspect of a static result: elements, near field, contact, pressure" 0 'order 1, 1.5 mm on the flank' out/scene/T100/static.h5
for line in 'near field  *subtraction' 'contact  *strips, 8 across' 'peak pressure  *[0-9.]+ MPa .*half-width there 0.0[0-9]+ mm'; do
  inspected "gear-inspect of a static result: $line" 0 "$line" out/scene/T100/static.h5; done
rejected "stage parameters in place of a scene" 3 'scene itself' "$bin/gear-scene" --scene out/scene/params/static.toml --output x.mk --out x
rejected "a body's stage parameters in place of a scene" 3 'scene itself' "$bin/gear-scene" --scene out/scene/pinion/body.toml --output x.mk --out x
if grep -q 'corner_contact.*#' out/scene/params/*.toml; then wrong "stage parameters give no unit to true" "$(grep corner_contact out/scene/params/*.toml)"; else
  ok "stage parameters give no unit to true"; fi
plot_help=$("$bin/gear-plot" --help | tr -s ' \n' ' ')
if grep -q 'see above' <<< "$plot_help" || ! grep -q 'From response.h5 of sweeps up and down' <<< "$plot_help"; then wrong "gear-plot --help says what each figure takes" ""; else
  ok "gear-plot --help says what each figure takes"; fi
rejected "a speed for a figure of no single speed" 2 'fig12 --mesh-frequency' "$bin/gear-plot" fig12 --plots "$plots" --mesh-frequency 2400 --output other out/scene/T100/static.h5
rejected "fig15 without speeds" 2 'fig15 --mesh-frequency 0' "$bin/gear-plot" fig15 --plots "$plots" --output other out/scene/T100/pairs/up/sweep.h5
rejected "fig15 with three speeds" 2 'fig15 3' "$bin/gear-plot" fig15 --plots "$plots" --mesh-frequency 1,2,3 --output other out/scene/T100/pairs/up/sweep.h5
mkdir -p titled/params titled/T100 && cp out/scene/T100/static.h5 titled/T100 && echo 'Gears of <a_b> & {c}' > titled/params/title.txt
if "$bin/gear-plot" fig12 --plots "$plots" --output titled/fig12 titled/T100/static.h5 > said 2>&1 && grep -q '^# scene titled: Gears of <a_b> & {c}$' titled/fig12.tsv &&
  grep -q 'titled: Gears of &lt;a_b.*&amp; {c}' titled/fig12.svg; then ok "the title of a scene stands on its figures as it is written"; else
  wrong "the title of a scene stands on its figures as it is written" "$(grep -o 'titled:[^/]*' titled/fig12.svg) $(tail -n 1 said)"; fi
if command -v xmllint > /dev/null; then xmllint --noout titled/fig12.svg 2> said && ok "a figure is well-formed SVG" || wrong "a figure is well-formed SVG" "$(head -n 1 said)"; fi
"$bin/gear-plot" fig12 --plots "$plots" --paper-figure fig12 --output titled/beside titled/T100/static.h5 > said 2>&1
if ! grep -q P2000 titled/fig12.tsv titled/fig12.svg && grep -q '^# Static transmission error, as Figure 12 of P2000$' titled/beside.tsv; then
  ok "only figures of the paper's pairs name the figure of P2000"; else wrong "only figures of the paper's pairs name the figure of P2000" "$(head -n 1 titled/fig12.tsv titled/beside.tsv | tr '\n' ' ')"; fi
found=$(for f in titled/fig12.tsv titled/fig12-harmonics.tsv; do awk -F '\t' -v f="$f" '/^#/ { next } !columns { columns = NF; if ($1 !~ /\[/) print f ": no name with a unit: " $1; next } NF != columns || $1 + 0 != $1 { print f ": " $0 }' "$f"; done)
[ -z "$found" ] && [ "$(find titled -maxdepth 1 -name '*.tsv' | wc -l)" = 4 ] && ok "the numbers of a figure are one table a file, with one line of names" ||
  wrong "the numbers of a figure are one table a file, with one line of names" "$(head -n 1 <<< "$found") $(ls titled)"
rm -r titled
inspected "gear-inspect says its units first" 0 '^units: mm .gears., µm .*N/µm' out/scene/T100/static.h5
# On a terminal the search of a calibration shows that it is at work.
if command -v script > /dev/null; then
  script -q -e -c "${ring_down[*]} --calibrate 0.05 --contact-state one" /dev/null > said 2>&1
  if grep -q 'gear-impact \[\.*\] 0/' said; then ok "a calibration shows progress from its start"; else wrong "a calibration shows progress from its start" "$(head -c 200 said)"; fi
else echo "skipped: progress of a calibration (script is not installed)"; fi
# Files of another gear, on which the stage itself would run well.
sed "$coarse; s/^bore_radius_mm = .*/bore_radius_mm = 38.0/" "$scene_of_paper" > scene_other.toml
"$bin/gear-scene" --scene scene_other.toml --output other.mk --out out > /dev/null 2>&1
other=out/scene_other/pinion
"$bin/gear-mesh" --params $other/body.toml --output $other/mesh.h5 > /dev/null 2>&1
"$bin/gear-reduce" --params $other/body.toml --mesh $other/mesh.h5 --output $other/body.h5 > /dev/null 2>&1
rejected "a mesh of another gear" 3 'bore_radius 0.038 0.04 make' "${stage_reduce[@]:0:3}" --mesh $other/mesh.h5 --output x.h5
rejected "a driver of another scene" 3 'pinion make out/bodies/*/body.h5' "$bin/gear-static" --params out/scene/params/static.toml \
  --body pinion=$other/body.h5 --body wheel=out/scene/wheel/body.h5 --torque 100 --output x.h5
rejected "a driven gear of another scene" 3 'wheel make out/bodies/*/body.h5' "$bin/gear-static" --params out/scene/params/static.toml \
  --body pinion=out/scene/pinion/body.h5 --body wheel=$other/body.h5 --torque 100 --output x.h5
"$bin/gear-static" --params out/scene_other/params/static.toml --body pinion=$other/body.h5 --body wheel=$other/body.h5 --torque 100 \
  --output other_static.h5 > /dev/null 2>&1
rejected "the wave of another scene" 3 'other_static.h5 pinion out/scene/T100/static.h5' $(lumped rectangular) --reference-static other_static.h5
# Changed where HDF5 has a checksum of its own, then the content hash put right. (test_artifact.cpp: an older schema.)
cp out/scene/T100/up/sweep.h5 out/old.h5
place=$(grep -a -b -o -m1 schema_version out/old.h5 | head -n 1 | cut -d: -f1)
byte=$(od -An -tu1 -j $((place + 40)) -N1 out/old.h5)
printf "\\x$(printf %x $((byte ^ 1)))" | dd of=out/old.h5 bs=1 seek=$((place + 40)) conv=notrunc status=none
rejected "an artifact that was edited" 4 'out/old.h5 delete make' "$bin/gear-spectra" --input out/old.h5 --output x.h5
digits=$(($(grep -a -b -o -m1 'in place of these digits: ' out/old.h5 | head -n 1 | cut -d: -f1) + 26))
printf '%064d' 0 | dd of=out/old.h5 bs=1 seek=$digits conv=notrunc status=none
sha256sum < out/old.h5 | head -c 64 | dd of=out/old.h5 bs=1 seek=$digits conv=notrunc status=none
rejected "an artifact that was edited and has its hash put right" 3 'schema damaged make out/old.h5' "$bin/gear-spectra" --input out/old.h5 --output x.h5
rm out/old.h5

# --- interrupted and full
# A sweep over so many speeds that it is still at work when the signal comes; the status says that it was.
sed "$coarse; s/^mesh_frequency_Hz = .*/mesh_frequency_Hz = { from = 100, to = 4000, step = 0.1 }/" "$scene_of_paper" > scene_long.toml
"$bin/gear-scene" --scene scene_long.toml --output long.mk --out out > /dev/null 2>&1
long_sweep=($(sweep scene up))
long_sweep[2]=out/scene_long/params/sweep.toml
kept=$(contents)
for signal in TERM KILL; do
  claim="SIG$signal amid a sweep leaves the earlier artifact whole"
  "${long_sweep[@]}" > /dev/null 2>&1 &
  killed=$!
  sleep 1
  kill -$signal $killed 2> /dev/null
  wait $killed 2> /dev/null
  status=$?
  if [ $status != $((128 + $(kill -l $signal))) ]; then wrong "$claim" "the sweep ended by itself with status $status"
  elif [ "$(contents)" != "$kept" ]; then wrong "$claim" "files have changed"
  else ok "$claim"; fi
  all_killed="${all_killed:-} $killed"
done
# Killed a moment later, amid writing, they would have left these.
for killed in $all_killed; do head -c 1000 out/scene/T100/up/sweep.h5 > "out/scene/T100/up/sweep.h5.tmp.$(uname -n).$killed"; done
$(sweep scene up) > /dev/null 2>&1
if [ "$(contents)" = "$kept" ]; then ok "the next run makes the same artifact and removes what killed runs left"; else
  wrong "the next run makes the same artifact and removes what killed runs left" "$(find out -name '*.tmp*' | tr '\n' ' ')"; fi
# A limit on the size of files stands for a full disk: the write fails half-way with an error, as on a full one.
for name in gear-mesh gear-reduce gear-static gear-loaded gear-impact gear-sweep gear-orbit gear-folds gear-runup gear-lumped gear-spectra gear-modes gear-plot; do
  before=$(contents)
  (ulimit -f 8; trap '' XFSZ; exec ${whole[$name]}) > /dev/null 2> said
  status=$?
  leftover=$(find . -name '*.tmp*' | head -n 1)
  lines=$(wc -l < said)
  if [ $status != 4 ] || [ "$lines" != 1 ] || ! grep -q "^$name: error: " said; then wrong "$name on a full disk" "status $status: $(head -n 2 said | tr '\n' '|')"
  elif ! grep -q "error: .*$(sed -n 's/.*--output \([^ ]*\).*/\1/p' <<< "${whole[$name]}").*: File too large" said; then wrong "$name on a full disk" "does not say which file, or why: $(head -n 1 said)"
  elif [ -n "$leftover" ]; then wrong "$name on a full disk" "leaves $leftover"
  elif [ "$(contents)" != "$before" ]; then wrong "$name on a full disk" "files have changed"
  else ok "$name on a full disk says so, and what was there stays"; fi
done
mkdir -p page/index.html && echo before > page/results.tsv
rejected "a page that cannot be written leaves its table, too" 4 'page/index.html regular' "$bin/gear-report" --output page/index.html out/scene/T100/static.h5
rm -r page
touch file
rejected "a folder that cannot be" 4 'file/x.h5' "$bin/gear-spectra" --input out/scene/T100/up/sweep.h5 --output file/x.h5
