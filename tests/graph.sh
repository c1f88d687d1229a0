# The graph: which stages make would run after which change.
#
# Works on a copy of the tree with the real makefiles and the real gear-scene; the other programs are replaced by
# shell scripts that write a line to their outputs, so that the whole pipeline runs in a second.
source tests/cases
in_copy_of_tree

# --- a comment in a source: the same object, so the same program. What compiles it is no part of a copied tree.
compile=$(ninja -C "$top/$B" -t commands gear-inspect | sed -n 's/ -o [^ ]* -c .*gear-inspect\.cpp$//p')
mkdir one two && cp tools/gear-inspect.cpp one && { echo '// A comment.'; cat tools/gear-inspect.cpp; } > two/gear-inspect.cpp
objects_of() { for copy in "$@"; do (cd "$top/$B" && $compile -MF "$tree/$copy/d" -o "$tree/$copy/o" -c "$tree/$copy/gear-inspect.cpp") > "$log" 2>&1 || return 1; done; }
if objects_of one two && cmp one/o two/o > "$log"; then ok "a comment in a source leaves the bytes of its program"
else wrong "a comment in a source leaves the bytes of its program" "$(tail -n 1 "$log")"; fi

# --- what is asked of ninja: programs that are older than a source, or all if there are others than before
asks() { make $sanitize -n "$@" 2>&1 | sed ':a;/\\$/{N;s/\\\n//;ba}' | sed -n 's/.*ninja -C [^ ]* *\(-j[^ ]*\)* *\([^;]*\);.*/\2/p' | xargs; }
# asked <claim> <words> <goals>
asked() { local found; found=$(asks "${@:3}"); [ "$found" = "$2" ] && ok "$1" || wrong "$1" "'$found' instead of '$2'"; }
asked "nothing is asked of ninja while programs are newer than their sources" "" build
cp -p tools/gear-mesh.cpp mesh.cpp && touch tools/gear-mesh.cpp
asked "a changed program is asked of ninja, no other one" "bin/gear-mesh" "$B/bin/gear-mesh" "$B/bin/gear-plot"
cp -p mesh.cpp tools/gear-mesh.cpp
cp -p tests/solid/test_elements.cpp solid.cpp && touch tests/solid/test_elements.cpp
asked "a changed test asks for no program that is no test" "" build
[[ $(asks "$B/bin/whine-tests") = *bin/whine-tests* ]] && ok "a changed test is asked for" || wrong "a changed test is asked for" "nothing is compiled"
cp -p solid.cpp tests/solid/test_elements.cpp
printf '// Nothing.\n' > tests/test_older.cpp && touch -d 2020-01-01 tests/test_older.cpp
[[ $(asks "$B/bin/whine-tests") = *bin/whine-tests* ]] && ok "a source that is older than its program is noticed" || wrong "a source that is older than its program is noticed" "nothing is compiled"
rm tests/test_older.cpp

# --- what the scorecard reads, from the real program
wanted=$("$B/bin/gear-scorecard" --files | sed 's|^|out/parker2000/|; p; s|^out/parker2000/|out/parker2000-standard-tooth/|; p; s|^out/parker2000-standard-tooth/|out/parker2000-calibrated/|' | sort)
given=$(make $sanitize -n out/figures/scorecard.txt 2> /dev/null | sed ':a;/\\$/{N;s/\\\n//;ba}' |
  sed -n 's|.*bin/gear-scorecard --printed data/published/claims.toml --fitted data/published/fitted.toml --output out/figures/scorecard ||p' | tr ' ' '\n' | sort)
if [ -n "$wanted" ] && [ "$wanted" = "$given" ]; then ok "make scorecard gives gear-scorecard the files that it lists, of all three scenes"; else
  wrong "make scorecard gives gear-scorecard the files that it lists, of all three scenes" "$(diff <(echo "$wanted") <(echo "$given") | head -3 | tr '\n' ' ')"; fi

# --- stand-ins
for program in "$B"/bin/gear-*; do
  case $program in */gear-scene) continue ;; esac
  cat > "$program" <<'SCRIPT'
#!/bin/bash
# of bash alone: a thousand stages are run, and each process takes its time
name=${0##*/}
while [ $# -gt 0 ]; do
  [ "$1" != --output ] || output=$2
  [ "$1" != --params ] || [ -e "$2" ] || exit 9
  shift
done
echo "$name $output" >> calls
[ "${FAIL:-}" != "$output" ] || exit 1
[ -d "${output%/*}" ] || case $output in */*) mkdir -p "${output%/*}" ;; esac
case $name in
  gear-animate) written=("$output".{tsv,gif} "$output"-{001..048}.png) ;;
  gear-report) written=("$output" "${output%/*}/results.tsv") ;;
  gear-compare) written=("$output" "${output%/*}/compare.tsv") ;;
  gear-sound) written=("$output".{wav,tsv}) ;;
  gear-plot | gear-scorecard) written=("$output".{tsv,svg,png,txt}) ;;
  *) written=("$output") ;;
esac
for file in "${written[@]}"; do echo "$name" > "$file"; done
SCRIPT
done
scene=data/scenes/parker2000.toml
cp $scene scene.original

# stages: what the last make says that it would run or has run, as "program output" in order of the alphabet
shown() { sed -n 's|.*bin/\(gear-[a-z-]*\) .*--output \([^ ]*\).*|\1 \2|p' <(sed ':a;/\\$/{N;s/\\\n//;ba}' "$log") | sort; }
# programs only, each once
programs() { shown | cut -d' ' -f1 | uniq -c | awk '{printf "%s%s*%s", s, $2, $1; s=" "}'; }

# expect <claim> <stages as from programs>: of the last make
expect() {
  local found
  found=$(programs)
  if [ "$found" = "$2" ]; then ok "$1"; else wrong "$1" "expected '$2', found '$found' $(grep -m1 '\*\*\*' "$log")"; fi
}
# Of make -n with further arguments: plans <claim> <stages>, says <claim> <pattern of a line>, refuses <claim> <fields of its line>
plans() { make_ -n "${@:3}"; expect "$1" "$2"; }
says() {
  make_ -n "${@:3}"
  grep -q -- "$2" "$log" && ok "$1" || wrong "$1" "no '$2' in: $(tail -n 1 "$log")"
}
refuses() {
  make_ -n "${@:3}"
  named_in "$log" "$2" && ok "$1" || wrong "$1" "no '$2' in: $(tail -n 1 "$log")"
}
# change <sed script>: edits the scene
change() { sed -i -E "$1" $scene; cmp -s $scene scene.original && echo "FAILED: sed '$1' changed nothing"; }
restore() { cp scene.original $scene; make_ $all; }
all="figures static sweep"

plans "everything is missing at first: one body for two gears that are alike" "gear-impact*5 gear-lumped*14 gear-mesh*1 gear-plot*16 gear-reduce*1 gear-spectra*10 gear-static*5 gear-sweep*10" $all
make_ $all || wrong "the whole pipeline runs" "$(tail -n 1 "$log")"
expect "the pipeline runs what make -n has shown" \
  "gear-impact*5 gear-lumped*14 gear-mesh*1 gear-plot*16 gear-reduce*1 gear-spectra*10 gear-static*5 gear-sweep*10"
if [ "$(sort calls | uniq -d | wc -l)" = 0 ] && [ "$(wc -l < calls)" = 62 ]; then ok "each stage runs once, in parallel, too"
else wrong "each stage runs once" "$(sort calls | uniq -d | head -n 3)"; fi
plans "nothing to do the second time" "" $all
said=$(grep -v -E '^make: (Nothing to be done|.* is up to date)|/id/' "$log" | head -2)
[ -z "$said" ] && ok "and make -n then says nothing else" || wrong "and make -n then says nothing else" "$said"
make_ -q $all && ok "make -q agrees" || wrong "make -q agrees" "status $?"

touch "$B"/bin/gear-*; plans "programs linked anew with the same bytes redo nothing" "" $all; make_ $all
# Else every make from here on would look at the bytes of these programs again; others are older than what they are linked from.
for program in "$B"/bin/gear-*; do [ ! "$B/id/${program##*/}" -nt scene.original ] || touch -r "$B/id/${program##*/}" "$program"; done

change '1i # a comment'; plans "a comment in the scene redoes nothing" "" $all
change 's/^(centre_distance_mm = )150.0/\1  150.000/'; plans "another spelling of a number redoes nothing" "" $all; restore
touch $scene; plans "a touched scene redoes nothing" "" $all

change 's/^(torque_Nm = ).*/\1[100, 160, 200, 300]/'; plans "a changed torque redoes the static and the sweeps of that torque" "gear-spectra*2 gear-static*1 gear-sweep*2" static sweep
shown | grep -v T160 && wrong "only that torque" "$(shown)" || ok "only that torque"; restore
change 's/^(torque_Nm = ).*/\1[110, 150, 200, 300]/'; plans "the first torque sets the dampers of all sweeps" "gear-spectra*8 gear-static*1 gear-sweep*8" static sweep
make_ static sweep; restore; plans "changed back and made again, all is up to date" "" $all

change 's/^bore_radius_mm = [0-9.]+/bore_radius_mm = 30.0/'; plans "the bore redoes everything from the mesh" "gear-impact*5 gear-lumped*14 gear-mesh*1 gear-plot*16 gear-reduce*1 gear-spectra*10 gear-static*5 gear-sweep*10" $all
make_ $all; cp scene.original $scene; plans "going back to a bore keeps its body and redoes what rests on it" "gear-impact*5 gear-lumped*14 gear-plot*16 gear-spectra*10 gear-static*5 gear-sweep*10" $all; restore
change 's/^rayleigh_stiffness_s = [^ ]*/rayleigh_stiffness_s = 5.5e-6/'; plans "damping redoes the elastic sweeps, no lumped one" "gear-impact*5 gear-plot*9 gear-spectra*10 gear-sweep*10" $all; restore
make_ impact; plans "ring-downs are up to date" "" impact
change 's/^(mesh_frequency_Hz = .*)step = 20/\1step = 40/'; plans "speeds redo no ring-down" "" impact; restore
change 's/^rayleigh_stiffness_s = [^ ]*/rayleigh_stiffness_s = 5.5e-6/'; plans "damping redoes the ring-downs" "gear-impact*4 gear-plot*1" impact; restore
change 's/^total_inertia_kgm2 = [^ ]*/total_inertia_kgm2 = 0.0150/'; plans "inertia redoes the sweeps" "gear-impact*5 gear-lumped*14 gear-plot*12 gear-spectra*10 gear-sweep*10" $all; restore
change 's/^corner_contact = [^ ]*/corner_contact = false/'; plans "the corner rule redoes statics and sweeps, no body" "gear-impact*5 gear-lumped*14 gear-plot*16 gear-spectra*10 gear-static*5 gear-sweep*10" $all; restore
change 's/^\[gear.wheel\]/[gear.pinion.modification]\ntip_relief_um = 10\ntip_relief_start_deg = 22\n[gear.wheel]/'; plans "a relief redoes statics and sweeps, no body" "gear-impact*5 gear-lumped*14 gear-plot*16 gear-spectra*10 gear-static*5 gear-sweep*10" $all; restore
change 's/^(mesh_frequency_Hz = .*)step = 20/\1step = 40/'; plans "speeds redo the sweeps" "gear-lumped*14 gear-plot*11 gear-spectra*10 gear-sweep*10" $all; restore
change 's/^like = "pinion"/&\nprofile_shift = 0.1/; s/^centre_distance_mm = .*/centre_distance_mm = 150.4/'; plans "a gear that differs gets a body of its own" "gear-mesh*1" mesh; restore

# --- maps and variants
plans "a map of jumps: one artifact per torque and corner rule or lumped model, statics for these, no body" "gear-folds*5 gear-jump-map*24 gear-lumped*64 gear-plot*2 gear-static*3" jump-map
make_ jump-map; plans "a map is up to date" "" jump-map
change 's/^rayleigh_stiffness_s = [^ ]*/rayleigh_stiffness_s = 5.5e-6/; s/^(mesh_frequency_Hz = .*)step = 20/\1step = 40/'; plans "damping and speeds of the scene redo no map, only the curves of folds" "gear-folds*5 gear-plot*1" jump-map; restore
change 's/^total_inertia_kgm2 = [^ ]*/total_inertia_kgm2 = 0.0150/'; plans "inertia redoes the maps" "gear-folds*5 gear-jump-map*24 gear-lumped*64 gear-plot*2" jump-map; restore; make_ jump-map
rm out/parker2000/T300/jump_map_1.h5; plans "one artifact that is missing, and the figures" "gear-jump-map*1 gear-plot*2" jump-map
make_ jump-map; rm out/parker2000/T300/jump_map_secant-contact.h5; plans "one of a lumped model that is missing, and its figure" "gear-lumped*1 gear-plot*1" jump-map
make_ jump-map; plans "a fine map stands beside the coarse one" "gear-jump-map*48 gear-lumped*128 gear-plot*2 gear-static*8" JUMP_MAP=fine jump-map
plans "torques and corner rules of one's own" "gear-jump-map*2 gear-lumped*8 gear-plot*2 gear-static*1" JUMP_MAP_TORQUES='150 700' JUMP_MAP_CORNERS=2 jump-map
plans "another step redoes the maps" "gear-jump-map*24 gear-lumped*64 gear-plot*2" JUMP_MAP_STEP=25 jump-map
plans "a map without lumped models" "gear-jump-map*24 gear-plot*1" JUMP_MAP_MODELS= JUMP_MAP_STEP=30 jump-map
make_ -n out/parker2000/T300/fold_curves_torque.h5
grep -q 'gear-folds .* --torque 300 --over torque .*--first 300 ' "$log" &&
  ok "folds over torque begin at the torque of their path" || wrong "folds over torque begin at the torque of their path" "$(grep gear-folds "$log" | grep -o -e '--torque.*')"
refuses "a fineness that is none is rejected" 'JUMP_MAP=finer coarse fine' JUMP_MAP=finer jump-map
plans "sensitivity: bodies of the variants whose gears differ, a map of each" "gear-jump-map*18 gear-mesh*9 gear-plot*1 gear-reduce*9" sensitivity
make_ sensitivity; plans "sensitivity is up to date" "" sensitivity
change '1i # a comment'; plans "a comment in the scene redoes no variant" "" sensitivity; restore
change 's/^dedendum = [0-9.]+/dedendum = 1.22/'; plans "another dedendum redoes all but the two variants that set their own" "gear-jump-map*16 gear-mesh*8 gear-plot*1 gear-reduce*8" sensitivity; restore
make_ sensitivity; plans "variants of one's own, one of two keys" "gear-jump-map*1 gear-mesh*1 gear-plot*1 gear-reduce*1" VARIANTS='bore35:bore_radius_mm=35 both:bore_radius_mm=35,dedendum=1.3' sensitivity
refuses "a variant of a key that is none is rejected" 'bore_radius bore_radius_mm' VARIANTS='bad:bore_radius=35' sensitivity
make_ -n LAUNCH='srun -n1' JUMP_MAP_STEP=10 jump-map
[ "$(grep -c '^srun -n1 build.*/bin/gear-jump-map ' "$log")" = 24 ] && [ "$(grep -c '^srun -n1 build.*/bin/gear-lumped --map ' "$log")" = 64 ] && ok "LAUNCH carries the maps" || wrong "LAUNCH carries the maps" "$(tail -n 1 "$log")"

# --- what a goal or a number of a goal may be
refuses "a misspelt target gets the one that is spelt alike" 'raport report' raport
refuses "a variable that nothing reads gets the one that is spelt alike" 'BRANCH BRANCHES' BRANCH=yes report
refuses "a word that is like no target gets make help" 'xyzzyq help' xyzzyq
touch own.toml
refuses "a scene as a target is told SCENE=" 'own.toml SCENE=own.toml' own.toml
rm own.toml
refuses "a damping in per cent is told the share" 'DAMPING=5 0 1 0.05' DAMPING=5 calibrate
refuses "a damping with a decimal comma is rejected" 'DAMPING=0,05 share' DAMPING=0,05 calibrate
refuses "histories without a speed are told how to say one" 'Hz make histories AT=1300' histories
refuses "a sound without a speed is told how to say one" 'Hz make sound AT=2400' sound
says "a sound at a speed and a torque of one's own" 'gear-sound --sweep out/parker2000/T100/up/sweep.h5 --sweep out/parker2000/T100/down/sweep.h5 --mesh-frequency 1300 .*--output out/figures/sound-1300Hz-T100' AT=1300 TORQUE=100 sound
says "the sound of a run-up, then of the run-down over the same speeds" 'gear-sound --runup out/parker2000/T100/up/runup_500_2400_2800.h5 --runup out/parker2000/T100/down/runup_500_2800_2400.h5 .*--output out/figures/sound-runup-500-2400-2800-T100' RATE=500 FROM=2400 TO=2800 TORQUE=100 sound
mkdir -p a b; echo first > a/mic.csv; echo second > b/mic.csv; touch -d 2000-01-01 a/mic.csv b/mic.csv
make_ AT=1300 TORQUE=100 TRANSFER=a/mic.csv sound; plans "a sound behind a transfer function is up to date" "" AT=1300 TORQUE=100 TRANSFER=a/mic.csv sound
plans "a transfer function of the same name in another folder, however old, makes the sound again" "gear-sound*1" AT=1300 TORQUE=100 TRANSFER=b/mic.csv sound
cp -p b/mic.csv a/mic.csv; plans "and so does another one in its place" "gear-sound*1" AT=1300 TORQUE=100 TRANSFER=a/mic.csv sound
refuses "an export without a model is told what it needs" 'export model make SCENE=my-pair.toml MODEL=stage.rexs' export
refuses "an export to a model that is not there" 'MODEL=a/none.rexs file' MODEL=a/none.rexs export
echo first > a/stage.rexsj; make_ MODEL=a/stage.rexsj STAGE='First stage' export; plans "an export is up to date" "" MODEL=a/stage.rexsj STAGE='First stage' export
says "another stage of a model: its results, at all torques" "gear-export --model 'a/stage.rexsj' --stage '12' --output out/figures/stage-results.rexsj .*out/parker2000/T300/down/response.h5" MODEL=a/stage.rexsj STAGE=12 export
sed 's/^bore_radius_mm = .*/bore_radius_mm = 35/' $scene > a/short.toml; cp $scene b/short.toml
refuses "designs without scenes are told how to name them" 'compare scenes make SCENES=' compare
refuses "a design that is not there" 'SCENES=a/none.toml file' SCENES="$scene a/none.toml" compare
refuses "two designs of one name" 'two short.toml out/short' SCENES="a/short.toml b/short.toml" compare
refuses "a figure at a torque that the designs do not have" 'TORQUE=77 100 150 200 300' SCENES="$scene a/short.toml" TORQUE=77 compare
make_ SCENES="$scene a/short.toml" compare; plans "designs side by side are up to date" "" SCENES="$scene a/short.toml" compare
make_ -n SCENES="$scene a/short.toml" TORQUE=200 compare
grep -q 'gear-plot compare-rest --output out/compare/parker2000+short/compare-rest-T200 .*out/parker2000/T200/static.h5 out/short/T200/static.h5' "$log" &&
  ok "designs at another torque" || wrong "designs at another torque" "$(programs)"
make_ SCENES="$scene a/short.toml" AXIS=rpm:driver DB=1e-6 compare
expect "other axes draw the one figure against speed again, and the page" "gear-compare*1 gear-plot*1"
cp data/scenes/three-in-line.toml a/line.toml; cp data/scenes/oh58-planetary.toml a/planets.toml
make_ -n SCENES='a/line.toml a/planets.toml' compare
grep -q 'gear-plot compare-rest --output out/compare/line+planets/compare-rest-own out/line/T60/static.h5 out/planets/T400/static.h5' "$log" &&
  grep -q 'gear-compare .*out/planets/T400/down/response.h5' "$log" && ok "trains side by side, each at its own torque" || wrong "trains side by side, each at its own torque" "$(tail -n 1 "$log")"
make_ -n SCENES="$scene a/line.toml" compare
grep -q 'compare-motion .*out/parker2000/T100/up/response.h5 .*out/line/T60/up/response.h5' "$log" && ok "a train beside a pair, which is at the first of its torques" || wrong "a train beside a pair" "$(tail -n 1 "$log")"
refuses "a torque of trains side by side" 'TORQUE=60 line own' SCENES="$scene a/line.toml" TORQUE=60 compare
make_ -n SCENE=a/planets.toml MESH=sun-planet2 harris-map
grep -q 'gear-harris .*--mesh sun-planet2 .*--check 12 .*--output out/planets/harris_sun-planet2.h5' "$log" && grep -q 'gear-plot harris-map --output out/planets/report/harris-map-sun-planet2 out/planets/harris_sun-planet2.h5' "$log" &&
  ok "a Harris map of one mesh of a train" || wrong "a Harris map of one mesh of a train" "$(tail -n 1 "$log")"
refuses "a Harris map of a train without its mesh is told the meshes" 'MESH sun-planet1 planet4-ring' SCENE=a/planets.toml harris-map
sed 's/^bore_radius_mm = .*/bore_radius_mm = 30/' $scene > b/short.toml
make_ -n SCENE=a/short.toml SCENES="b/short.toml $scene" report
grep -q 'gear-scene.*b/short.toml' "$log" && wrong "SCENES leave a report of SCENE alone" "$(grep -m1 b/short.toml "$log")" ||
  { programs | grep -q 'gear-report\*1' && ok "SCENES leave a report of SCENE alone" || wrong "SCENES leave a report of SCENE alone" "$(programs) $(tail -n 1 "$log")"; }
grep -q '^bore_radius = 0.035 ' out/short/*/body.toml && ok "and its artifacts are of SCENE" || wrong "and its artifacts are of SCENE" "$(grep bore_radius out/short/*/body.toml | head -n 1)"
refuses "a scene and a design of one name" 'SCENE=a/short.toml out/short b/short.toml rename' SCENE=a/short.toml SCENES="b/short.toml $scene" report compare
make_ -n SCENE=a/short.toml SCENES="./a/short.toml $scene" report compare
programs | grep -q 'gear-compare\*1.*gear-report\*1' && ok "a scene that is compared, too, has its report" || wrong "a scene that is compared, too, has its report" "$(tail -n 1 "$log")"
cp $scene a/a--b.toml; cp $scene a/c.toml; cp $scene a/a.toml; cp $scene a/b--c.toml
make_ SCENES='a/a--b.toml a/c.toml' compare; make_ -n SCENES='a/a.toml a/b--c.toml' compare
grep -q 'gear-compare --output out/compare/a+b--c/index.html' "$log" && [ -e out/compare/a--b+c/index.html ] &&
  ok "designs of other names have a folder of their own" || wrong "designs of other names have a folder of their own" "$(ls out/compare) $(tail -n 1 "$log")"
refuses "a figure that has no axis of speed" 'AXIS=rpm:driver multipliers' AXIS=rpm:driver multipliers
for goal in static impact animation; do
  refuses "nor is $goal drawn without a word" "AXIS=rpm:sun $goal" AXIS=rpm:sun SCENE=data/scenes/oh58-planetary.toml $goal
done
make_ -n AXIS=rpm:sun DB=1e-6 SCENE=data/scenes/oh58-planetary.toml report branches
[ "$(grep -c "gear-plot.* --axis 'rpm:sun'" "$log")" = 4 ] && [ "$(grep -c "gear-plot.* --db 1e-6" "$log")" = 3 ] && ok "speeds in rpm and levels of a train: Campbell diagram, sweeps, branch" ||
  wrong "speeds in rpm and levels of a train" "$(grep 'gear-plot' "$log" | cut -c1-120 | tail -n 6)"
train="SCENE=data/scenes/oh58-planetary.toml"
refuses "a speed of a gear that the scene does not have, before anything is computed" 'AXIS=rpm:pinion sun planet4 carrier' AXIS=rpm:pinion $train report
refuses "a speed that its sweeps do not have" 'AT=1470 1450 600 6000 50' AT=1470 $train sound
refuses "and a mesh that it does not have" 'MESH=sun-planet5 sun-planet4' AT=1450 MESH=sun-planet5 $train sound
says "the motion of a train at one speed" 'gear-plot fig08 --output out/oh58-planetary/report/histories-1450Hz-T400 --mesh-frequency 1450 out/oh58-planetary/T400/up/sweep.h5 out/oh58-planetary/T400/down/sweep.h5' AT=1450 $train histories
refuses "a figure that has no amplitudes in dB" 'DB=1e-6 fig05' DB=1e-6 fig05
refuses "a sound at a speed and of a run-up" 'AT=1300 RATE=500' AT=1300 RATE=500 sound
refuses "a speed of something" 'AXIS=order:1 rpm:<gear>' AXIS=order:1 fig05
refuses "decibels of nothing" 'DB=0 length 0' DB=0 order-cuts
mkfifo a/pipe.csv a/pipe.rexs a/pipe.toml
for given in 'TRANSFER=a/pipe.csv AT=1300 sound' 'MODEL=a/pipe.rexs export' 'MODEL=/dev/zero export' 'SCENE=a/pipe.toml report' 'STUDY=a/pipe.toml study'; do
  timeout 60 make $sanitize -n $given > "$log" 2>&1
  grep -q "\*\*\* ${given%% *}: it is no regular file" "$log" && ok "${given%% *}, which has no end, is not read" || wrong "${given%% *}, which has no end, is not read" "$(tail -n 1 "$log")"
done
rm a/pipe.*
refuses "a transfer function that is not there" 'TRANSFER=a/none.csv file' TRANSFER=a/none.csv AT=1300 sound
refuses "a file whose name is that of an option" 'option ./-t.csv' TRANSFER=-t.csv AT=1300 sound
refuses "a share whose numbers overflow" 'SHARE=18446744073709551617/18446744073709551617 i/n' STUDY=tolerances SHARE=18446744073709551617/18446744073709551617 study
refuses "a variant whose name leads out of its folder" 'VARIANTS ../..:bore_radius_mm=35 folder' VARIANTS=../..:bore_radius_mm=35 sensitivity
refuses "a variant without a change" 'VARIANTS ../.. name:key=value' VARIANTS=../.. sensitivity
refuses "a number that leads out of its folder" 'JUMP_MAP_TORQUES=../.. /' JUMP_MAP_TORQUES=../.. jump-map
make_ order-cuts; before=$(ls out/figures/order-cuts.*)
FAIL=out/figures/order-cuts make_ DB=1e-6 order-cuts
[ "$(ls out/figures/order-cuts.*)" = "$before" ] && [ "$(wc -l <<< "$before")" -ge 3 ] && ok "a figure that fails leaves all files of the earlier one" ||
  wrong "a figure that fails leaves all files of the earlier one" "$(printf '%s ' out/figures/order-cuts.*)"
refuses "a run-up at a rate that is none is told what it is" 'RATE=fast rpm/s' RATE=fast runup
refuses "a run-up without a rate is told how to say one" 'rpm/s make runup RATE=1000' runup
refuses "a run-up with one end is told to give both" 'both none' FROM=2400 runup
make_ -n RATE=500 WAY=down FROM=2800 TO=2400 TORQUE=100 runup
grep -q "gear-runup --params .*T100/static.h5 .*--direction down --rate '500' --from '2800' --to '2400' --output out/parker2000/T100/down/runup_500_2800_2400.h5" "$log" &&
  grep -q 'gear-plot runup --output out/figures/runup-500-2800-2400-down-T100 ' "$log" &&
  ok "a run-down between two speeds" || wrong "a run-down between two speeds" "$(tail -n 1 "$log")"
make_ -n AT=1300 TORQUE=100 histories
grep -q 'gear-plot fig08 --output out/figures/histories-1300Hz-T100 --mesh-frequency 1300 .*out/parker2000/T100/up/sweep.h5' "$log" &&
  grep -q 'gear-plot fig10 --output out/figures/history-loads-1300Hz-T100 --mesh-frequency 1300 ' "$log" && ok "histories at a speed and a torque of one's own" ||
  wrong "histories at a speed and a torque of one's own" "$(tail -n 1 "$log")"
refuses "a phase beyond the mesh period is told its range" 'PHASE=1.2 share 0 1' PHASE=1.2 loaded
make_ help
if grep -q '^Other$' "$log"; then wrong "make help has a task for each target" "$(sed -n '/^Other$/,$p' "$log" | tr '\n' ' ')"; else
  [ "$(grep -c '^  [a-z0-9-]* .* ' "$log")" -gt 50 ] && ok "make help has a task for each target" || wrong "make help lists the targets" "$(head -n 3 "$log")"; fi

# --- loaded gears, moving gears
make_ static; plans "loaded gears rest on statics and meshes that are there" "gear-loaded*1" loaded
make_ PHASE=0.5 TORQUE=170 loaded
grep -q '^.*bin/gear-loaded --static out/parker2000/T170/static.h5 .*--mesh-phase 0.5 --output out/parker2000/T170/loaded_0.5.h5' <(sed ':a;/\\$/{N;s/\\\n//;ba}' "$log") &&
  ok "at a phase and a torque of one's own" || wrong "at a phase and a torque of one's own" "$(tail -n 1 "$log")"
plans "loaded gears are up to date then" "" PHASE=0.5 TORQUE=170 loaded
plans "other statics load them anew" "gear-loaded*1" -W out/parker2000/T170/static.h5 PHASE=0.5 TORQUE=170 loaded
plans "an animation: one sweep, on the calibrated scene" "gear-animate*1 gear-mesh*1 gear-reduce*1 gear-static*2 gear-sweep*1" animation
make_ animation; plans "an animation is up to date" "" animation
[ "$(find out/figures/animation -name 'motion-*.png' | wc -l)" = 48 ] && [ -e out/figures/animation/motion.gif ] && ok "with its 48 frames" || wrong "with its 48 frames" "$(find out/figures/animation -type f | wc -l) files"
plans "another sweep moves them anew" "gear-animate*1" -W out/parker2000-calibrated/T150/down/sweep.h5 animation
mkdir -p mine; sed -E 's/^torque_Nm = .*/torque_Nm = [90, 120]/' scene.original > mine/moving.toml
make_ -n SCENE=mine/moving.toml animation
grep -q -e '--sweep out/moving/T90/down/sweep.h5 .*--output out/moving/report/animation/motion' <(sed ':a;/\\$/{N;s/\\\n//;ba}' "$log") && ok "of a scene at its first torque" || wrong "of a scene at its first torque" "$(tail -n 1 "$log")"

# --- reports
plans "a report of the paper's scene: its figures and the error budget, all else is there" "gear-plot*11 gear-report*1 gear-static*1" report
make_ report; plans "a report is up to date" "" report
make_ report; grep -q '^report: .*out/parker2000/report/index.html' "$log" && ok "and says where it stands" || wrong "and says where it stands" "$(tail -n 1 "$log")"
mkdir -p mine
sed -E 's/^torque_Nm = .*/torque_Nm = [90, 120]/' scene.original > mine/plain.toml
plans "a report of a scene: every torque both ways, ring-downs, one error budget" "gear-impact*2 gear-plot*11 gear-report*1 gear-spectra*4 gear-static*3 gear-sweep*4" SCENE=mine/plain.toml report
plans "with errors of the motions: two sweeps of refinements more" "gear-impact*2 gear-plot*11 gear-report*1 gear-spectra*4 gear-static*3 gear-sweep*6" SCENE=mine/plain.toml ERRORS=yes report
plans "with branches: one branch, two figures more" "gear-impact*2 gear-orbit*1 gear-plot*13 gear-report*1 gear-spectra*4 gear-static*3 gear-sweep*4" SCENE=mine/plain.toml BRANCHES=yes report
sed -E 's/^contact = .*/contact = "line"/' mine/plain.toml > mine/lines.toml; plans "contact in lines: no ring-down" "gear-plot*11 gear-report*1 gear-spectra*4 gear-static*3 gear-sweep*4" SCENE=mine/lines.toml report
sed -E 's/^\[gear.wheel\]/[gear.pinion.modification]\ntip_relief_um = 10\ntip_relief_start_deg = 22\n&/' mine/plain.toml > mine/relief.toml; plans "relief: a profile chart" "gear-impact*2 gear-plot*12 gear-report*1 gear-spectra*4 gear-static*3 gear-sweep*4" SCENE=mine/relief.toml report
sed -E 's/^\[gear.wheel\]/[gear.pinion.error]\niso_class = 5\n&/' mine/plain.toml > mine/graded.toml; plans "teeth that differ: sidebands instead of figures of one mesh period" "gear-plot*8 gear-report*1 gear-spectra*4 gear-static*2 gear-sweep*4" SCENE=mine/graded.toml report
sed -E 's/^\[gear.wheel\]/[gear.pinion.crack]\ndepth_mm = 1.0\n&/' mine/plain.toml > mine/cracked.toml; plans "a cracked tooth: its figures, no ring-down" "gear-mesh*1 gear-plot*8 gear-reduce*1 gear-report*1 gear-spectra*4 gear-static*2 gear-sweep*4" SCENE=mine/cracked.toml report
refuses "make teeth says what there is of teeth that differ" 'teeth differ make SCENE=mine/graded.toml tooth-loads sidebands residual-signal' SCENE=mine/graded.toml teeth
make_ -n teeth
grep -q 'gear-report --teeth --output out/figures/teeth/index.html out/parker2000/T150/static.h5 .*out/figures/root-stress.png' "$log" && ! grep -q 'T100/up' "$log" && ok "make teeth is at the torque of the figures that it shows" ||
  wrong "make teeth is at the torque of the figures that it shows" "$(grep -e --teeth "$log" | tail -n 1) $(tail -n 1 "$log")"
refuses "make teeth says what there is of a cracked tooth" 'teeth cracked make SCENE=mine/cracked.toml crack residual-signal' SCENE=mine/cracked.toml teeth
plans "teeth that differ have no ring-down in other figures either" "gear-plot*1 gear-spectra*2 gear-static*1 gear-sweep*2" SCENE=mine/graded.toml fig05
plans "a page by its path" "gear-impact*2 gear-plot*11 gear-report*1 gear-spectra*4 gear-static*3 gear-sweep*4" SCENE=mine/plain.toml out/plain/report/index.html

# --- any torque, other scenes
plans "a torque that no list names" "gear-spectra*1 gear-static*1 gear-sweep*1" out/parker2000/T700/up/response.h5
plans "a ring-down at a torque that no list names" "gear-impact*1 gear-static*1" out/parker2000/T700/impact.h5
plans "a lumped model at a torque that no list names" "gear-lumped*1 gear-spectra*1 gear-static*1" out/parker2000/T700/secant/up/response.h5
plans "lumped models run from the statics, without body or sweep" "gear-lumped*27 gear-spectra*40" lumped fig15
make_ lumped; plans "the rectangular wave is that of the first torque, the curves are those of their own" "gear-lumped*1" -W out/parker2000/T100/static.h5 out/parker2000/T150/{rectangular,secant}/up/sweep.h5
make_ lumped fig15; sed -i 's/^lumped_options_pairs-hertz = .*/& --cells 512/; s/--duty 0.755/--duty 0.75/' pipelines/stages.mk; plans "other options of two lumped models redo these" "gear-lumped*9 gear-plot*1 gear-spectra*8" lumped fig15
cp "$top/pipelines/stages.mk" pipelines/stages.mk; make_ lumped fig15; make_ jump-map; sed -i 's/--mass 1.4/--mass 1.3/' pipelines/stages.mk; plans "another mass redoes the maps of lumped models" "gear-lumped*64 gear-plot*1" jump-map
cp "$top/pipelines/stages.mk" pipelines/stages.mk
for goal in fig04 fig5; do
  make_ $goal && wrong "make $goal ends with an error" "status 0"
  [ "$(grep -c . "$log")" = 1 ] && grep -q "$goal: there is no such figure; there are fig01 fig03" "$log" && ok "make $goal lists the figures in one line" || wrong "make $goal lists the figures in one line" "$(cat "$log")"
done
make_ SCENE=$scene scorecard && wrong "a scorecard of SCENE ends with an error" "status 0"
grep -q 'beside its own scenes, parker2000 parker2000-standard-tooth parker2000-calibrated; leave SCENE out' "$log" && ok "a scorecard of SCENE is rejected" || wrong "a scorecard of SCENE is rejected" "$(tail -n 1 "$log")"
rm -f calls; make_ calibrate DAMPING=0.05 TORQUE=700 STATE=one
[ "$(tr '\n' ' ' < calls)" = "gear-static out/parker2000/T700/static.h5 gear-impact  " ] && ok "calibrate runs the static of its torque first" ||
  wrong "calibrate runs the static of its torque first" "$(cat calls "$log")"
make_ calibrate; make_ -n calibrate
grep -q 'gear-impact .*/T150/static.h5 .* --calibrate 0.07 --contact-state two$' "$log" && ok "calibrate: 7 %, 150 N m, two pairs unless told" ||
  wrong "calibrate: 7 %, 150 N m, two pairs unless told" "$(cat "$log")"
plans "a body by its name is up to date" "" out/parker2000/pinion/body.h5
refuses "a torque that is not as %g prints it is rejected" 'T080 torque' out/parker2000/T080/static.h5
mkdir -p elsewhere
sed -E 's/^torque_Nm = .*/torque_Nm = [90]/' scene.original > elsewhere/own.toml
echo broken > data/scenes/parker2000.toml
plans "SCENE opens no other scene file, and a gear that is known keeps its body" "gear-spectra*2 gear-static*1 gear-sweep*2" SCENE=elsewhere/own.toml sweep
plans "SCENE with a torque of its own" "gear-static*1" SCENE=elsewhere/own.toml out/own/T80/static.h5
plans "a sweep waits for the static at the first torque, too" "gear-spectra*1 gear-static*2 gear-sweep*1" SCENE=elsewhere/own.toml out/own/T80/up/response.h5
rm -f calls; make_ SCENE=elsewhere/own.toml figures error-budget
drawn() { sed -n 's/^gear-plot //p' calls | sort | tr '\n' ' '; }
[ "$(drawn)" = "$(printf 'out/own/report/%s ' contact-zone error-budget finite-elements lumped-by-torque lumped-rectangular mesh-stiffness response responses-by-torque rms-and-mean table1 transmission-error)" ] && [ ! -e out/own/T150 ] && ok "figures of SCENE stand in its report, at its own torques" ||
  wrong "figures of SCENE stand in its report, at its own torques" "$(drawn) $(tail -n 1 "$log")"
plans "and are up to date then" "" SCENE=elsewhere/own.toml figures error-budget
rm -f calls; make_ SCENE=elsewhere/own.toml teeth
[ "$(drawn)" = "$(printf 'out/own/report/%s ' flank-pressure load-sharing root-stress tooth-loads)" ] && [ -e out/own/teeth/index.html ] && ok "make teeth draws what a tooth suffers, on a page" ||
  wrong "make teeth draws what a tooth suffers, on a page" "$(drawn) $(tail -n 1 "$log")"
plans "with the branch: one orbit, one figure and the page" "gear-orbit*1 gear-plot*1 gear-report*1" SCENE=elsewhere/own.toml BRANCHES=yes teeth
{ cat elsewhere/own.toml; printf '[friction]\ncoefficient = 0.05\n'; } > elsewhere/slides.toml
plans "losses by friction are drawn from statics and both sweeps at each torque" "gear-plot*1 gear-spectra*2 gear-static*1 gear-sweep*2" SCENE=elsewhere/slides.toml efficiency
refuses "losses without friction are rejected before anything is computed" 'efficiency friction' SCENE=elsewhere/own.toml efficiency
plans "a map of SCENE is at its own torques" "gear-folds*1 gear-jump-map*3 gear-lumped*8 gear-plot*2" SCENE=elsewhere/own.toml jump-map
sed -i -E 's/^torque_Nm = .*/torque_Nm = [600, 90, 80]/' elsewhere/own.toml
make_ -n SCENE=elsewhere/own.toml fig05 fig12
grep -q 'gear-plot fig05 .* out/own/T600/up/response.h5 out/own/T600/down/response.h5 out/own/T600/impact.h5$' "$log" && grep -q 'gear-plot fig12 .* out/own/T600/static.h5 out/own/T90/static.h5 out/own/T80/static.h5$' "$log" &&
  ok "a frequency response takes the first torque of SCENE, statics take them all" || wrong "a frequency response takes the first torque of SCENE, statics take them all" "$(grep gear-plot "$log")"
make_ SCENE=elsewhere/own.toml fig12; sed -i -E 's/^torque_Nm = .*/torque_Nm = [600, 90]/' elsewhere/own.toml
plans "a torque that is taken out redraws the curves" "gear-plot*1" SCENE=elsewhere/own.toml fig12
plans "a figure of SCENE by its path" "gear-plot*1" SCENE=elsewhere/own.toml out/own/report/transmission-error.png
sed -i -E 's/^torque_Nm = .*/torque_Nm = [90]/' elsewhere/own.toml
make_ -n fig05
if [ $? != 0 ] && [ "$(grep -v 'unfinished jobs' "$log" | grep -c .)" = 2 ] && grep -q '^gear-scene: error: ' "$log"; then ok "a broken scene ends with one line and make's own"
else wrong "a broken scene ends with one line and make's own" "$(cat "$log")"; fi
cp scene.original $scene
make_ SCENE=elsewhere/own.toml sweep
mkdir -p other; sed 's/corner_contact = [^ ]*/corner_contact = false/' elsewhere/own.toml > other/own.toml
touch -d 2000-01-01 other/own.toml
make_ -n SCENE=other/own.toml sweep
if [ $? != 0 ] && grep -q 'other/own.toml: out/own is of elsewhere/own.toml, which says otherwise; rename one of the two, or delete out/own' "$log"; then
  ok "two scenes of one name do not share a folder"; else wrong "two scenes of one name do not share a folder" "$(tail -n 1 "$log")"; fi
cp elsewhere/own.toml own.toml; plans "a copy of a scene is that scene" "" SCENE=own.toml sweep
rm own.toml elsewhere/own.toml; plans "a scene in place of one that has gone is noticed, however old" "gear-spectra*2 gear-static*1 gear-sweep*2" SCENE=other/own.toml sweep
cp $scene other/parker2000.toml
make_ -n SCENE=other/parker2000.toml sweep && ok "a copy of a scene of the project is that scene" || wrong "a copy of a scene of the project is that scene" "$(tail -n 1 "$log")"
cp other/own.toml other/parker2000.toml
make_ -n SCENE=other/parker2000.toml sweep
if [ $? != 0 ] && grep -q 'SCENE=other/parker2000.toml: out/parker2000 is of data/scenes/parker2000.toml, which says otherwise; rename the file' "$log"; then
  ok "another scene does not take the place of one of the project"; else wrong "another scene does not take the place of one of the project" "$(tail -n 1 "$log")"; fi
change 's/^title = .*/title = "Another title"/'; : > calls; make_ fig12; plans "figures with another title are up to date" "" fig12
grep -q 'Another title' out/parker2000/params/title.txt && grep -q 'gear-plot out/figures/fig12' calls && ok "another title redraws" || wrong "another title redraws" "$(tail -n 2 calls)"; cp scene.original $scene
plans "natural modes of a system that ships: one stage and its figures" "gear-modes*1 gear-plot*2" modes
make_ modes; plans "and they are up to date then" "" modes
cp data/scenes/lin-parker-planetary.toml train.toml; plans "those of SCENE" "gear-modes*1 gear-plot*2" SCENE=train.toml modes
make_ SCENE=train.toml modes; sed -i 's/^# .*//' train.toml; plans "comments redo nothing" "" SCENE=train.toml modes
sed -i 's/^stiffness_N_um = 500.0/stiffness_N_um = 400.0/' train.toml; plans "stiffnesses redo them" "gear-modes*1 gear-plot*2" SCENE=train.toml modes
plans "a system of elastic gears: three bodies, its statics, its modes" "gear-mesh*3 gear-modes*1 gear-plot*3 gear-reduce*3 gear-static*1" SCENE=data/scenes/three-in-line.toml static modes
cp data/scenes/three-in-line.toml inline.toml; make_ SCENE=inline.toml static modes; sed -i 's/^torque_Nm = 60.0/torque_Nm = 50.0/' inline.toml
plans "another torque needs no body of a system" "gear-modes*1 gear-plot*3 gear-static*1" SCENE=inline.toml static modes
plans "its motion: a sweep each way" "gear-plot*1 gear-spectra*2 gear-sweep*2" SCENE=inline.toml sweep
plans "the report of a system: its picture, its sweeps, its errors at rest, the page" "gear-modes*1 gear-plot*7 gear-report*1 gear-spectra*2 gear-static*2 gear-sweep*2" SCENE=inline.toml report
grep -q 'gear-report.* out/inline/T50/up/response.h5 out/inline/T50/down/response.h5 .*out/inline/report/system-sweep.png' "$log" && ok "the page of a system has its sweeps" || wrong "the page of a system has its sweeps" "$(grep gear-report "$log" | tail -n 1)"
make_ SCENE=inline.toml report; plans "and it is up to date then" "" SCENE=inline.toml report mode-shapes sweep
grep -q 'open out/inline/modes.hdf in ParaView' <(make_ SCENE=inline.toml mode-shapes; cat "$log") && ok "mode shapes for ParaView stand beside the modes" || wrong "mode shapes for ParaView stand beside the modes" "$(tail -n 1 "$log")"
refuses "load sharing needs planets" 'load-sharing SCENE=inline.toml planets make report' SCENE=inline.toml load-sharing
plans "load sharing of planets: bodies, statics, one figure" "gear-mesh*3 gear-plot*1 gear-reduce*3 gear-static*1" SCENE=data/scenes/oh58-planetary.toml load-sharing
plans "teeth of a train: statics, modes, both sweeps, a page" "gear-mesh*3 gear-modes*1 gear-reduce*3 gear-report*1 gear-spectra*2 gear-static*2 gear-sweep*2" SCENE=data/scenes/oh58-planetary.toml teeth
plans "the report of a train with planets" "gear-mesh*3 gear-modes*1 gear-plot*8 gear-reduce*3 gear-report*1 gear-spectra*2 gear-static*2 gear-sweep*2" SCENE=data/scenes/oh58-planetary.toml report
plans "the report of rigid gears: modes, their figures, the picture" "gear-modes*1 gear-plot*3 gear-report*1" SCENE=train.toml report
refuses "load sharing needs elastic gears" 'load-sharing SCENE=train.toml rigid make report' SCENE=train.toml load-sharing
sed -i 's/^rayleigh_stiffness_s = 3e-6/rayleigh_stiffness_s = 4e-6/' inline.toml
plans "another damping of a system redoes its sweeps alone" "gear-plot*1 gear-spectra*2 gear-sweep*2" SCENE=inline.toml static modes sweep
plans "its ring-down needs bodies alone" "gear-impact*1 gear-plot*1" SCENE=inline.toml impact
make_ SCENE=inline.toml sweep; plans "its branch, drawn over both sweeps" "gear-orbit*1 gear-plot*1" SCENE=inline.toml branches
make_ SCENE=inline.toml impact branches; plans "and both are up to date then" "" SCENE=inline.toml impact branches
sed '/^\[operation\]/,$d' inline.toml > still.toml; refuses "a sweep of a system without speeds is rejected" 'speeds [operation]' SCENE=still.toml sweep
refuses "statics of a system reject rigid gears" 'static SCENE=train.toml rigid' SCENE=train.toml static
refuses "stages of pairs reject a system" 'lumped SCENE=inline.toml system' SCENE=inline.toml lumped
refuses "another torque than that of its drives" 'out/three-in-line/T70/static.h5 drives out/three-in-line/T60' out/three-in-line/T70/static.h5
plans "its artifacts are targets, as those of pairs" "gear-static*1 gear-sweep*1" out/three-in-line/T60/static.h5 out/three-in-line/T60/up/sweep.h5
for renamed in static:static sweep:sweep ringdown:impact branch:branches; do
  refuses "system-${renamed%:*} names the target of every scene" "system-${renamed%:*} ${renamed#*:} SCENE" SCENE=inline.toml "system-${renamed%:*}"
done
refuses "modes reject a pair" 'pair modes systems' SCENE=data/scenes/nasa28.toml modes
refuses "a scene that does not exist is named" 'data/scenes/nowhere.toml' out/nowhere/T1/static.h5
refuses "a missing SCENE is named" 'SCENE=nowhere.toml file' SCENE=nowhere.toml sweep
refuses "a SCENE without its .toml is told the file" 'SCENE=other/own other/own.toml' SCENE=other/own sweep
refuses "a SCENE of the project by its name alone is told the file" 'SCENE=parker2000 data/scenes/parker2000.toml' SCENE=parker2000 sweep

# --- broken off, removed, failed
make_ $all
rm -f out/parker2000/params/static.toml out/parker2000/wheel out/parker2000/T200/static.h5
make_ $all && [ -e out/parker2000/wheel/body.h5 ] && [ -e out/parker2000/T200/static.h5 ] && ok "deleted stage parameters, links and results come back" ||
  wrong "deleted stage parameters, links and results come back" "$(tail -n 1 "$log")"
rm -rf out; : > calls
FAIL=out/parker2000/T150/down/sweep.h5 make_ fig05 && wrong "a failed stage fails make" "status 0" || ok "a failed stage fails make"
make_ -n fig05 # the other scene may not have come as far
if grep -q 'gear-sweep out/parker2000/T150/down/sweep.h5' <<< "$(shown)" && ! grep -q -E 'gear-(mesh|reduce|static) out/(bodies|parker2000)/' <<< "$(shown)"; then
  ok "a run that broke off resumes at what is missing"
else wrong "a run that broke off resumes at what is missing" "$(shown)"; fi
make_ fig05 && [ -e out/figures/fig05.png ] && ok "and ends with the figure" || wrong "and ends with the figure" "$(tail -n 1 "$log")"
plans "another gear-sweep redoes sweeps and what follows" "gear-plot*1 gear-spectra*2 gear-sweep*2" -W "$B/id/gear-sweep" fig05
plans "FREEZE=1 keeps them" "" FREEZE=1 -W "$B/id/gear-sweep" fig05
make_ -n LAUNCH='srun -n1 --exact' out/parker2000/T50/up/response.h5
[ "$(grep -c '^srun -n1 --exact build.*/bin/gear-\(static\|sweep\) ' "$log")" = 2 ] && ok "LAUNCH carries the heavy stages" ||
  wrong "LAUNCH carries the heavy stages" "$(grep bin/ "$log")"

# A launcher that ends well and has run nothing, stage by stage: with nothing there, and with an earlier file that is stale.
lost() { grep -q "$2: the launcher 'true' has ended, but its result is not there after 0 s" "$log" || missed="$missed $1"; }
missed=
while read -r stage file; do
  make_ $file; mv $file kept
  make_ LAUNCH_$stage=true LAUNCH_WAIT=0 $file && missed="$missed $stage(status)"; lost $stage $file
  mv kept $file; touch -d 2000-01-01 $file
  make_ LAUNCH_$stage=true LAUNCH_WAIT=0 $file && missed="$missed $stage(stale)"; lost "$stage(stale)" $file
  make_ LAUNCH=env LAUNCH_WAIT=0 $file || missed="$missed $stage(env)"
done << STAGES
mesh $(readlink -f out/parker2000/pinion | sed "s|^$PWD/||")/mesh.h5
reduce $(readlink -f out/parker2000/pinion | sed "s|^$PWD/||")/body.h5
static out/parker2000/T50/static.h5
static out/parker2000/T50/error_budget.h5
impact out/parker2000/T50/impact.h5
sweep out/parker2000/T50/up/sweep.h5
loaded out/parker2000/T50/loaded_0.5.h5
lumped out/parker2000/T50/secant/up/sweep.h5
lumped out/parker2000/T150/jump_map_secant.h5
jump-map out/parker2000/T150/jump_map_true.h5
jump-map out/parker2000/T150/branches.h5
harris out/parker2000/harris_map.h5
harris out/parker2000/harris_dynamic.h5
animate out/parker2000-calibrated/report/animation/motion.tsv
STAGES
[ -z "$missed" ] && ok "a launcher that has ended well without a result is found out for every stage, beside a stale file, too" ||
  wrong "a launcher that has ended well without a result is found out for every stage, beside a stale file, too" "not for$missed"
make_ LAUNCH=true LAUNCH_WAIT=0 out/parker2000/T55/static.h5 && wrong "LAUNCH=true fails at its first stage" "status 0" || ok "LAUNCH=true fails at its first stage"

# --- a fresh machine: deps runs before whatever needs a package, in any order of the goals
mkdir machine
cat > machine/dpkg-query <<'SCRIPT'
#!/bin/bash
[ -e machine/installed ] && printf 'install ok installed'
SCRIPT
cat > machine/apt-get <<'SCRIPT'
#!/bin/bash
echo "$DEBIAN_FRONTEND apt-get $*" >> machine/calls
[ "$1" != install ] || { sleep 0.3; touch machine/installed; }
SCRIPT
cat > machine/cmake <<'SCRIPT'
#!/bin/bash
[ -e machine/installed ] || { echo "$@: compiled before deps" >> machine/early; exit 1; }
touch "$4/build.ninja"
SCRIPT
cat > machine/ninja <<'SCRIPT'
#!/bin/bash
# -C folder, -j, files: gear-scene is the real one
for file in "${@:3}"; do
  case $file in
    -*) continue ;;
    */gear-scene) program=gear-scene ;;
    *) program=program ;;
  esac
  mkdir -p "$2/${file%/*}" && cp machine/$program "$2/$file"
done
SCRIPT
printf '#!/bin/bash\necho sudo >> machine/calls\nexec "$@"\n' > machine/sudo
cp "$B/bin/gear-plot" machine/program
cp "$B/bin/gear-scene" machine/gear-scene
chmod +x machine/*
# --- goals that compile nothing
for goal in "" help deps clean clean-out; do
  rm -rf build machine/calls
  PATH=$PWD/machine:$PATH make $goal > "$log" 2>&1
  status=$?
  if [ $status = 0 ] && [ ! -e build ] && [ ! -e machine/early ]; then ok "make $goal compiles nothing"
  else wrong "make $goal compiles nothing" "status $status $(tail -n 1 "$log")"; fi
done
make > "$log" 2>&1; grep -q '^  fig05 ' "$log" && ok "make prints the targets" || wrong "make prints the targets" "$(tail -n 1 "$log")"

for goals in "deps fig05" "fig05 deps" "-j2 deps build" "-j2 build deps"; do
  rm -rf build out machine/installed machine/calls machine/early
  PATH=$PWD/machine:$PATH make $goals > "$log" 2>&1
  status=$?
  if [ $status = 0 ] && [ ! -e machine/early ] && grep -q 'noninteractive apt-get install .*--no-install-recommends' machine/calls &&
    [ "$(grep -c . machine/calls)" = 2 ]; then ok "make $goals installs first, once"
  else wrong "make $goals installs first, once" "status $status $(cat machine/early machine/calls 2>&1 | head -n 3) $(tail -n 2 "$log")"; fi
done
rm -f machine/calls
PATH=$PWD/machine:$PATH make deps > "$log" 2>&1 && [ ! -e machine/calls ] && ok "make deps asks apt-get for nothing when nothing is missing" ||
  wrong "make deps is idempotent" "$(tail -n 1 "$log")"
rm -f machine/installed
printf '#!/bin/bash\necho 1000\n' > machine/id && chmod +x machine/id
PATH=$PWD/machine:$PATH make deps > "$log" 2>&1 && [ "$(grep -c sudo machine/calls)" = 2 ] && ok "make deps asks sudo where it is not root" ||
  wrong "make deps asks sudo where it is not root" "$(tail -n 1 "$log")"
cd "$top" || exit 1
