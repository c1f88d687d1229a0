# Studies from outside: one target per variant, bodies shared, the same numbers as the stages one by one, resumed after a kill, and
# what is rejected by which line. Works on a copy of the tree with the real programs and a coarse scene.
source tests/cases
in_copy_of_tree
contents() { find out -type f -name '*.h5' -print0 | sort -z | xargs -0 -r sha256sum; }
stages() { grep -c "^[^ ]*bin/gear-$1 " "$log"; }

sed 's/^element_mm = [^ ]*/element_mm = 1.5/; s/^element_order = [^ ]*/element_order = 1/; s/^modes = [^ ]*/modes = 5/
  s/^\[discretisation\]/&\npositions = 32/; s/^steps_per_period = [^ ]*/steps_per_period = 32/
  s/^min_sample_rate_kHz = [^ ]*/min_sample_rate_kHz = 50/; s/^torque_Nm = .*/torque_Nm = [100, 150]/
  s/^mesh_frequency_Hz = .*/mesh_frequency_Hz = { from = 2200, to = 2400, step = 100 }/' data/scenes/parker2000-standard-tooth.toml > own.toml
cat > small.toml <<'STUDY'
scene = "own.toml"
stage = "sweep"
directions = ["up"]
[[vary]]
key = "damping.rayleigh_stiffness_s"
values = [5.5e-6, 7.7e-6]
[[vary]]
key = "operation.torque_Nm"
values = [100, 150]
STUDY

# --- two variants side by side
sed 's/^stage = .*/&\ncompare = [0, 2]/' small.toml > marked.toml
make_ -n STUDY=marked.toml compare
grep -q 'gear-compare --output out/compare/marked-first[+]marked-second/index.html .*out/marked-second/T100/down/response.h5' "$log" &&
  ok "the two variants that a study marks are compared" || wrong "the two variants that a study marks are compared" "$(tail -n 1 "$log")"
make_ -n STUDY=small.toml compare
grep -q 'small.toml: marks no variants to compare; add compare' "$log" && ok "a study that marks none is told how" ||
  wrong "a study that marks none is told how" "$(tail -n 1 "$log")"
rm -rf out/compare out/marked-first out/marked-second out/studies/marked

# --- a study, and what it answers beside the stages
if make_ STUDY=small.toml study && [ -s out/studies/small/study.png ] && [ -s out/studies/small/study.tsv ]; then
  ok "a study of four variants gives a table and a figure"
else
  wrong "a study of four variants gives a table and a figure" "$(grep -m1 -E 'error|\*\*\*' "$log")"
  exit 1
fi
[ "$(stages mesh) $(stages reduce) $(stages variant)" = "1 1 4" ] && ok "one body for all, one target per variant" ||
  wrong "one body for all, one target per variant" "$(stages mesh) $(stages reduce) $(stages variant)"
expected=$(contents)
make_ -q STUDY=small.toml study && ok "and is up to date then" || wrong "and is up to date then" "$(make -n STUDY=small.toml study | head -n 2)"
if ! command -v h5dump > /dev/null; then echo "skipped: answers of a variant beside those of the stages (h5dump is not installed)"
elif make_ SCENE=own.toml out/own/T150/up/response.h5; then
  [ "$(stages reduce)" = 0 ] && ok "a scene and its study share the body" || wrong "a scene and its study share the body" "$(stages reduce)"
  number() { h5dump -y -w 0 -m %.17g -d "$1" "$2" | awk '/DATA {/ { on = 1; next } on && /}/ { exit } on' | tr -d ' ,'; }
  rms=$(number /dte_rms out/own/T150/up/response.h5 | sort -g | tail -n 1) load=$(number /tooth_load_max out/own/T150/up/response.h5 | sort -g | tail -n 1)
  stiffness=$(number /mean_stiffness out/own/T150/static.h5)
  # Row of 7.7e-6 s at 150 N m: the last.
  row() { number "/quantity/$1" out/studies/small/study.h5 | tail -n 1; }
  if [ -n "$rms" ] && [ "$rms $load $stiffness" = "$(row rms_max_up) $(row tooth_load_max_up) $(row mean_stiffness)" ]; then ok "answers of a variant are those of the stages, bit by bit"
  else wrong "answers of a variant are those of the stages, bit by bit" "$rms $load $stiffness against $(row rms_max_up) $(row tooth_load_max_up) $(row mean_stiffness)"; fi
else wrong "the stages of the same scene run" "$(tail -n 1 "$log")"; fi

# --- what changes redo
changed() { sed "$1" small.toml > small.new; mv small.new small.toml; make_ -n STUDY=small.toml study; }
cp small.toml small.original
changed 's/^values = \[100, 150\]/values = [150, 100, 200]/'
[ "$(stages reduce) $(stages variant)" = "0 2" ] && ok "another torque computes its own variants, whatever the order" || wrong "another torque computes its own variants" "$(stages reduce) $(stages variant)"
cp small.original small.toml
make_ STUDY=small.toml study
changed '1i # a comment'; [ "$(grep -c '^[^ ]*bin/gear-' "$log")" = 0 ] && ok "a comment redoes nothing" || wrong "a comment redoes nothing" "$(grep -m1 bin/gear- "$log")"
changed '1i title = "Another"'; [ "$(stages variant) $(stages study) $(stages plot)" = "0 1 1" ] && ok "another title redoes table and figure only" || wrong "another title" "$(cat "$log")"
cp small.original small.toml
changed 's/^stage = .*/stage = "static"/; /^directions/d; s/^values = \[5.*/values = [7.7e-6, 5.5e-6]/'
[ "$(stages variant)" = 2 ] && ok "at rest, variants that differ in damping alone are one" || wrong "at rest, variants that differ in damping alone are one" "$(stages variant)"
cp small.original small.toml
make_ STUDY=small.toml study

# --- broken off
rm -rf out/studies
setsid make $sanitize -j1 STUDY=small.toml study > "$log" 2>&1 & job=$!
for _ in $(seq 600); do [ -z "$(find out/studies/small/variants -name '*.h5' 2> /dev/null)" ] || break; sleep 0.05; done
kill -KILL -- -$job; wait $job 2> /dev/null
before=$(find out/studies -name '*.h5' | wc -l)
make_ STUDY=small.toml study && [ "$(contents | grep studies)" = "$(grep studies <<< "$expected")" ] && [ "$before" -ge 1 ] && [ "$(stages variant)" -lt 4 ] &&
  ok "a make that was killed goes on at what is missing and ends with the same bytes" || wrong "a make that was killed" "$before before, $(stages variant) made again: $(tail -n 1 "$log")"
rm -rf out/studies
make_ STUDY=small.toml SHARE=1/2 study && [ "$(stages variant) $(stages study)" = "2 0" ] && make_ STUDY=small.toml SHARE=2/2 study && [ "$(stages variant)" = 2 ] &&
  make_ STUDY=small.toml study && [ "$(stages variant) $(stages study)" = "0 1" ] && ok "two shares and the table" || wrong "two shares and the table" "$(tail -n 1 "$log")"

# --- rejected
# rejected <claim> <fields of a line> <make arguments>: status not 0
rejected() {
  local claim=$1 fields=$2
  shift 2
  if make_ "$@"; then wrong "$claim" "make ended with status 0"
  elif ! named_in "$log" "$fields"; then wrong "$claim" "no '$fields' in: $(head -n 3 "$log" | tr '\n' ' ')"
  else ok "$claim"; fi
}
rejected "make study without STUDY lists the studies" 'STUDY tolerances' study
rejected "a study that does not exist" 'data/studies/nowhere.toml tolerances' STUDY=nowhere study
sed 's/rayleigh_stiffness_s/rayleigh_stifness_s/' small.original > typo.toml
rejected "a key that no scene has, by file, line and the nearest" "typo.toml:5 damping.rayleigh_stifness_s damping.rayleigh_stiffness_s" STUDY=typo.toml study
sed 's/7.7e-6/7.7/' small.original > wide.toml
rejected "a value out of range, by variant and limit" "wide.toml:5 2 damping.rayleigh_stiffness_s 7.7 operation.torque_Nm 100 1" STUDY=wide.toml study
sed 's/^scene.*/scene = "gone.toml"/' small.original > lost.toml
rejected "a scene that is not there" "lost.toml 0 gone.toml" STUDY=lost.toml study
printf 'scene = "own.toml"\n[[vary]]\nkey = "mesh.centre_distance_mm"\nvalues = [150, 170]\n' > apart.toml
rejected "gears that do not reach each other, by the variant, before anything runs" "apart.toml 1 mesh.centre_distance_mm 170 [[mesh]]" STUDY=apart.toml study
[ ! -e out/studies/apart ] && [ ! -e out/studies/typo ] && ok "what is rejected leaves no files" || wrong "what is rejected leaves no files" "$(ls out/studies)"
printf 'scene = "own.toml"\n[[vary]]\nkey = "damping.rayleigh_stiffness_s"\nvalues = [1e-6, 2e-6]\n' > alike.toml
rejected "keys that the stage does not depend on" "2 alike" STUDY=alike.toml study
mkdir -p other; cp small.toml other/tolerances.toml
rejected "a study of one's own does not take the place of one of the project" 'out/studies/tolerances data/studies/tolerances.toml rename' STUDY=other/tolerances.toml study
rejected "a share that is none" 'SHARE=3/2 i/n' STUDY=small.toml SHARE=3/2 study

# A torque at which the flanks are not long enough: the stage fails.
printf 'scene = "own.toml"\n[[vary]]\nkey = "operation.torque_Nm"\nvalues = [100, 900000]\n' > heavy.toml
rejected "a variant outside the model's range, by its values" "gear-variant 1 operation.torque_Nm 900000 pinion-wheel 0.75" -k STUDY=heavy.toml study
[ "$(find out/studies/heavy -name '*.h5' | wc -l)" = 1 ] && ok "make -k computes the others, but no table" || wrong "make -k computes the others, but no table" "$(find out/studies/heavy -name '*.h5')"
sed -i '1i outside_model = "mark"' heavy.toml
if make_ STUDY=heavy.toml study && grep -q 'warning: variant 1 (operation.torque_Nm = 900000) lies outside the model.s range: ' "$log" && grep -q '^# outside the model.s range (1): ' out/studies/heavy/study.tsv; then
  ok "outside_model = \"mark\": a line of the table that says so"; else wrong "outside_model = \"mark\"" "$(tail -n 2 "$log" | tr '\n' ' ')"; fi
sed -i 's/^outside_model = .*/outside_model = "stop"/' heavy.toml
rejected "outside_model = \"stop\" again: what was marked is an error, by variant and reason" \
  'gear-study out/studies/heavy/plan.toml 1 operation.torque_Nm 900000 quarter' STUDY=heavy.toml study

# Marked is what lies outside the model's range, not what this machine or a setting does.
cat > large.toml <<'STUDY'
scene = "own.toml"
outside_model = "mark"
[set]
"gear.pinion.error.iso_class" = 5
"discretisation.positions" = 65536
[[vary]]
key = "operation.torque_Nm"
values = [100, 150]
STUDY
rejected "outside_model = \"mark\" does not mark a setting that asks for too much" 'gear-variant variant positions GB' -k STUDY=large.toml study
[ -z "$(find out/studies/large -name '*.h5')" ] && ok "nor leaves it as an artifact" || wrong "nor leaves it as an artifact" "$(find out/studies/large -name '*.h5')"

# --- what the stages warn of: here a motion that hardly anything damps
sed 's/^values = \[5.*/values = [1e-10, 2e-10]/; s/^values = \[100.*/values = [100]/; s/^directions.*/&\n[set]\n"discretisation.steady_state" = "integrate"/' small.original > restless.toml
if make_ STUDY=restless.toml study; then
  grep -q -E 'gear-variant: warning: variant 1 \(damping.rayleigh_stiffness_s = 2e-10, .*\): speed up: at [0-9]* Hz the motion is not periodic' "$log" &&
    ok "a variant warns of what gear-sweep warns of, by its name" || wrong "a variant warns of what gear-sweep warns of, by its name" "$(grep -m1 warning "$log")"
  grep -q 'gear-study: warning: 2 variants have speeds at which no periodic motion was found' "$log" && grep -q '^# .*; 2 have speeds that did not settle' out/studies/restless/study.tsv &&
    ok "and the table says which did not settle" || wrong "and the table says which did not settle" "$(head -n 3 out/studies/restless/study.tsv | tr '\n' ' ')"
else wrong "a study of motions that do not settle" "$(tail -n 1 "$log")"; fi

# --- a study of a train: what it answers beside static.h5 of the same scene
sed '$a [discretisation]\nelement_mm = 2.0\npositions = 8
  s/^title = .*/title = "A train"/' data/scenes/three-in-line.toml > train.toml
cat > loads.toml <<'STUDY'
scene = "train.toml"
quantities = ["te_peak_to_peak.idler-wheel", "mesh_force_static.pinion-idler", "bearing_force_static.idler"]
[set]
"fidelity.contact" = "line"
[[vary]]
key = "drive.pinion.torque_Nm"
values = [30, 60]
STUDY
sed 's/^torque_Nm = 60.0/torque_Nm = 30.0/; s/^\[discretisation\]/[fidelity]\ncontact = "line"\n&/' train.toml > train-30.toml
if make_ STUDY=loads.toml study && [ -s out/studies/loads/study.png ]; then ok "a study of a train gives a table and a figure"
else wrong "a study of a train gives a table and a figure" "$(grep -m1 -E 'error|\*\*\*' "$log")"; fi
[ "$(stages reduce) $(stages variant)" = "3 2" ] && ok "its three gears have a body each, its variants a target each" ||
  wrong "its three gears have a body each, its variants a target each" "$(stages reduce) $(stages variant)"
make_ -q STUDY=loads.toml study && ok "the study of a train is up to date then" || wrong "the study of a train is up to date then" "$(make -n STUDY=loads.toml study | head -n 2)"
if ! command -v h5dump > /dev/null; then echo "skipped: answers of a variant of a train beside those of its statics (h5dump is not installed)"
elif make_ SCENE=train-30.toml static; then
  [ "$(stages reduce)" = 0 ] && ok "a train and its study share the bodies" || wrong "a train and its study share the bodies" "$(stages reduce)"
  file=$(grep -l 'torque = 30.0' out/studies/loads/variants/*/*.toml | head -n 1)
  number() { h5dump -y -w 0 -m %.17g -d "$1" "$2" | awk '/DATA {/ { on = 1; next } on && /}/ { exit } on' | tr -d ' ,'; }
  largest=$(number /mesh_force out/train-30/T30/static.h5 | awk 'NR % 2 == 1 && $1 > most { most = $1 } END { printf "%.17g", most }')
  [ "$(number /quantity/mesh_force_static.pinion-idler "${file%.toml}.h5")" = "$largest" ] && ok "answers of a variant of a train are those of its statics, bit by bit" ||
    wrong "answers of a variant of a train are those of its statics, bit by bit" "$(number /quantity/mesh_force_static.pinion-idler "${file%.toml}.h5") against $largest"
else wrong "the statics of the train run" "$(tail -n 1 "$log")"; fi
