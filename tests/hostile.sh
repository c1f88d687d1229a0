# Names of files and folders, titles and numbers that were made to do harm: make and the programs take them for data or reject them.
#
# Works on a copy of the tree with the real makefiles and programs. A command that runs leaves a file `mark`.
source tests/cases
in_copy_of_tree
coarse='s/^element_mm = [^ ]*/element_mm = 1.5/; s/^element_order = [^ ]*/element_order = 1/; s/^modes = [^ ]*/modes = 5/
  s/^\[discretisation\]/&\npositions = 32/; s/^torque_Nm = .*/torque_Nm = [100]/'
scene() { sed "$coarse" data/scenes/parker2000.toml; }
# Everything but what make and the programs may write.
others() { find . -path "./$B" -prune -o -path ./out -prune -o -print | sort; }

# --- names of files: no shell, no rule and no make function reads them
scene > s.toml
echo 'scene = "s.toml"' > study.toml
echo precious > precious.toml
# shellcheck disable=SC2088 # a folder named ~
attempts=('h/;{touch,mark};/s.toml' 'k/>precious.toml' '$(shell touch mark).toml' '${shell touch mark}.toml' "'; touch mark; '.toml" '`touch mark`.toml'
  'p%/s.toml' 'b\/s.toml' 'a#/s.toml' 'a=b/s.toml' 'a&touch mark&/s.toml' 'a|touch mark/s.toml' 'a"$(touch mark)"/s.toml' $'e\e[31m/s.toml' '~/s.toml')
for name in "${attempts[@]}"; do
  mkdir -p "./$(dirname "$name")"
  cp s.toml "./$name" 2> /dev/null
done
for name in "${attempts[@]}"; do
  shown=$(tr -d '\033' <<< "$name")
  for variable in SCENE STUDY; do
    claim="$variable=$shown is rejected before a shell sees it"
    before=$(others)
    goal=static
    [ $variable = SCENE ] || goal=study
    for given in argument environment; do
      if [ $given = argument ]; then make $sanitize -n "$variable=$name" $goal > "$log" 2>&1 && wrong "$claim" "status 0"
      else env "$variable=$name" make $sanitize -n $goal > "$log" 2>&1 && wrong "$claim" "status 0, from the environment"; fi
      if [ "$(others)" != "$before" ]; then wrong "$claim" "made $(diff <(echo "$before") <(others) | tail -n 1)"; rm -f mark
      elif [ "$(cat precious.toml)" != precious ]; then wrong "$claim" "has overwritten a file"; echo precious > precious.toml
      elif ! grep -q -E "\*\*\* $variable.*: it holds .*may hold letters, digits and . _ - \+ , @ / only" "$log"; then wrong "$claim" "$(tail -n 1 "$log")"
      elif grep -q $'\e' "$log"; then wrong "$claim" "a control character reaches the terminal"
      elif [ $given = environment ]; then ok "$claim"; fi
    done
  done
done
for goal in 'out/parker2000/T1;touch${IFS}mark;/static.h5' "out/parker2000/T'\$(touch\${IFS}mark)'/static.h5" 'out/parker2000/T$(shell)/static.h5' 'out/parker2000/T1%/static.h5'; do
  make $sanitize -n "$goal" > "$log" 2>&1
  if [ -e mark ]; then wrong "the target $goal" "runs a command"; rm -f mark
  elif grep -q '\*\*\* target.*: it holds ' "$log"; then ok "the target $goal is rejected"
  else wrong "the target $goal is rejected" "$(tail -n 1 "$log")"; fi
done
for given in 'TORQUE=1;touch mark' 'PHASE=$(shell touch mark)' 'SHARE=1/2"$(touch mark)"' 'DAMPING=`touch mark`' 'AT=$(shell touch mark)' 'TRANSFER=x;touch mark' 'MODEL=x;touch mark' 'STAGE=$(shell touch mark)' 'SCENES=a.toml b.toml;touch mark' 'AXIS=rpm:x;touch mark' 'DB=`touch mark`'; do
  make $sanitize -n "$given" STUDY=study.toml study calibrate loaded $([[ $given != AT=* && $given != TRANSFER=* ]] || echo histories) > "$log" 2>&1
  if [ -e mark ]; then wrong "$given" "runs a command"; rm -f mark
  elif grep -q '\*\*\* .*: it holds ' "$log"; then ok "$given is rejected"
  else wrong "$given is rejected" "$(tail -n 1 "$log")"; fi
done
# Every variable that the makefiles let a user set, and those that they only ask for.
variables=$(sed -n 's/^\([A-Z][A-Z_]*\) *?=.*/\1/p' Makefile pipelines/*.mk tests/*.mk)
for variable in $variables JUMP_MAP SENSITIVITY HARRIS_DYNAMIC FREEZE SANITIZE; do
  claim="$variable is data"
  for value in '0.07; touch mark' '0.07 $(shell touch mark)' '0.07 `touch mark`' $'0.07\ntouch mark' '0.07>mark' '0.07 | touch mark' '*' "'; touch mark; '"; do
    make $sanitize -n "$variable=$value" jump-map fold-curves harris-map sensitivity bench > "$log" 2>&1
    if [ -e mark ]; then wrong "$claim" "'$value' runs a command"; rm -f mark
    elif ! grep -q "\*\*\* $variable.*: it holds .*, and may hold letters, digits" "$log"; then wrong "$claim" "'$value': $(tail -n 1 "$log")"
    else continue; fi
    claim=
    break
  done
  [ -z "$claim" ] || ok "$claim"
done
# Where no gear-scene is there to judge: before anything is compiled.
mv "$B/bin/gear-scene" judge
for goal in fig05 build help "$B/bin/gear-scene"; do
  make $sanitize 'SCENE=$(shell touch mark).toml' "$goal" > "$log" 2>&1 && wrong "make $goal without gear-scene rejects what it would expand" "status 0"
  if [ -e mark ]; then wrong "make $goal without gear-scene rejects what it would expand" "runs a command"; rm -f mark
  elif grep -q '\*\*\* SCENE: it holds \$' "$log"; then ok "make $goal without gear-scene rejects what it would expand"
  else wrong "make $goal without gear-scene rejects what it would expand" "$(tail -n 1 "$log")"; fi
done
mv judge "$B/bin/gear-scene"
mkdir -p h
for given in SCENE STUDY; do
  cp $([ $given = SCENE ] && echo s.toml || echo study.toml) h/.toml
  make $sanitize -n $given=h/.toml $([ $given = SCENE ] && echo static || echo study) > "$log" 2>&1
  grep -q "\*\*\* $given=h/.toml: the file has no name before .toml" "$log" && ok "$given=h/.toml is rejected: its results would be the default's" ||
    wrong "$given=h/.toml is rejected" "$(tail -n 1 "$log")"
done
mkdir -p 'mü/ß@a+b,c'
cp s.toml 'mü/ß@a+b,c/own_1.toml'
make $sanitize -n 'SCENE=mü/ß@a+b,c/own_1.toml' static > "$log" 2>&1 && grep -q 'bin/gear-static .*out/own_1/T100' "$log" &&
  ok "a folder may hold letters of any alphabet and @ + ," || wrong "a folder may hold letters of any alphabet and @ + ," "$(tail -n 1 "$log")"

# --- a decimal point where the locale has a comma
if mkdir -p "$base/locale" && localedef -i de_DE -f UTF-8 "$base/locale/de_DE.UTF-8" 2> /dev/null; then
  LOCPATH=$base/locale LC_ALL=de_DE.UTF-8 make $sanitize -n build > "$log" 2>&1
  ! grep -q 'ninja -C' "$log" && ok "another order of the alphabet compiles nothing anew" || wrong "another order of the alphabet compiles nothing anew" "$(grep -c . "$log") commands"
  LOCPATH=$base/locale LC_ALL=de_DE.UTF-8 make $sanitize -n out/parker2000/T62.5/static.h5 > "$log" 2>&1 && ok "a torque of 62.5 in a path, where the locale has a comma" ||
    wrong "a torque of 62.5 in a path, where the locale has a comma" "$(tail -n 1 "$log")"
else echo "skipped: a torque of 62.5 in a path, where the locale has a comma (localedef cannot make one)"; fi

# --- an artifact in the place of another: fresh by its inputs, and of another scene, torque, direction, model or kind
bin=$PWD/$B/bin
motion='s/^steps_per_period = [^ ]*/steps_per_period = 32/; s/^min_sample_rate_kHz = [^ ]*/min_sample_rate_kHz = 50/
  s/^mesh_frequency_Hz = .*/mesh_frequency_Hz = { from = 2300, to = 2400, step = 100 }/'
scene | sed "$motion" > s.toml
scene | sed "$motion; s/^bore_radius_mm = [^ ]*/bore_radius_mm = 35.0/" > other.toml
if ! make_ SCENE=s.toml out/s/T100/static.h5 out/s/T200/static.h5 out/s/T100/{up,down,secant/up}/response.h5 ||
  ! make_ SCENE=other.toml out/other/T100/static.h5; then
  wrong "two coarse scenes are computed" "$(grep -m1 -E 'error|\*\*\*' "$log")"
  exit 1
fi
"$bin/gear-inspect" --check out > "$log" 2>&1 && ok "gear-inspect --check finds nothing in what make has made" || wrong "gear-inspect --check finds nothing in what make has made" "$(head -n 1 "$log")"
# rejected <claim> <status> <fields of the message> <command...>
rejected() {
  local claim=$1 status=$2 fields=$3 found
  shift 3
  timeout 60 "$@" > said.out 2> said
  found=$?
  if [ "$found" != "$status" ]; then wrong "$claim" "status $found instead of $status: $(head -n 1 said)"
  elif ! named_in said "$fields"; then wrong "$claim" "no '$fields' in: $(head -c 300 said)"
  elif [ "$(wc -c < said)" -gt 4000 ] || grep -q $'\e' said; then wrong "$claim" "a message of $(wc -c < said) bytes, or with control characters"
  else ok "$claim"; fi
}
# swapped <from> <to> <fields> <stage that reads it...>
swapped() {
  local from=$1 to=$2 fields=$3
  shift 3
  cp -p "$to" kept && cp "$from" "$to"
  rejected "$from in the place of ${to#out/}: gear-inspect --check" 3 "$to $fields" "$bin/gear-inspect" --check out
  rejected "$from in the place of ${to#out/}: $(basename "$1")" 3 "$to $fields delete make" "$@"
  cp -p kept "$to"
}
body_of() { readlink "out/$1/pinion" | sed 's|^\.\./|out/|'; }
swapped out/s/T100/static.h5 out/s/T200/static.h5 '100 T200' "$bin/gear-plot" fig12 --output x out/s/T200/static.h5
swapped out/other/T100/static.h5 out/s/T100/static.h5 'out/other/params/static.toml out/s' "$bin/gear-plot" fig12 --output x out/s/T100/static.h5
swapped out/s/T100/up/sweep.h5 out/s/T100/down/sweep.h5 'up down' "$bin/gear-spectra" --input out/s/T100/down/sweep.h5 --output x.h5
swapped out/s/T100/secant/up/response.h5 out/s/T100/up/response.h5 'secant T100' "$bin/gear-report" --output x.html out/s/T100/static.h5 out/s/T100/up/response.h5
swapped "$(body_of other)/body.h5" "$(body_of s)/body.h5" 'stage parameters' "$bin/gear-static" --params out/s/params/static.toml --body pinion="$(body_of s)/body.h5" --body wheel="$(body_of s)/body.h5" --torque 100 --output x.h5
swapped "$(body_of s)/mesh.h5" out/s/T100/static.h5 "whine/mesh whine/static" "$bin/gear-plot" fig12 --output x out/s/T100/static.h5
pair=(--body pinion=out/s/pinion/body.h5 --body wheel=out/s/wheel/body.h5)
rejected "gear-impact with the parameters of a sweep" 3 'out/s/params/sweep.toml sweep ring-down out/<scene>/params/impact.toml' \
  "$bin/gear-impact" --params out/s/params/sweep.toml "${pair[@]}" --static out/s/T100/static.h5 --reference-static out/s/T100/static.h5 --output x.h5
rejected "a report of a lumped sweep" 3 'out/s/T100/secant/up/response.h5 lumped secant elastic' "$bin/gear-report" --output x.html out/s/T100/static.h5 out/s/T100/secant/up/response.h5

# --- what is printed and not written
for program in "$bin"/gear-*; do
  "$program" --help > /dev/full 2> said
  [ $? = 4 ] && grep -q 'error: standard output cannot be written' said || { wrong "${program##*/} --help on a full disk" "$(cat said)"; broken=1; }
  grep -q '^Exit status: 0 done; 1 .*; 2 .*; 3 ' <<< "$("$program" --help)" || { wrong "${program##*/} --help" "lacks the exit statuses"; broken=1; }
done
[ -z "${broken:-}" ] && ok "every program ends with status 4 where its --help cannot be written, and says the exit statuses there"
rejected "gear-scene --keys on a full disk" 4 'standard output' bash -c "'$bin/gear-scene' --keys > /dev/full"
rejected "gear-inspect on a full disk" 4 'standard output' bash -c "'$bin/gear-inspect' out/s/T100/static.h5 > /dev/full"

# --- what make takes for made
place=out/s/T100/static.h5
mv $place kept
: > $place; rejected "an empty artifact" 4 "$place delete make" "$bin/gear-plot" fig12 --output x $place
rm $place; mkfifo $place; rejected "a pipe for an artifact" 4 "$place delete make" "$bin/gear-plot" fig12 --output x $place
rm $place; mkdir $place; rejected "a folder for an artifact" 4 "$place remove folder make" "$bin/gear-plot" fig12 --output x $place
rmdir $place; rejected "a missing artifact" 4 "$place make" "$bin/gear-plot" fig12 --output x $place
mv kept $place

# --- strips: contact of next to no load beside errors of the teeth
{ sed 's/^torque_Nm = .*/torque_Nm = [1e-4]/' s.toml; printf '[gear.pinion.error]\niso_class = 5\n[gear.wheel.error]\niso_class = 5\n'; } > light.toml
make_ SCENE=light.toml -n static
rejected "statics on strips that no memory holds" 3 'strips GB 2' \
  "$bin/gear-static" --params out/light/params/static.toml --body pinion="$(body_of s)/body.h5" --body wheel="$(body_of s)/body.h5" --torque 1e-4 --output x.h5

# --- values from elsewhere: a dataset that HDF5 would read out of another file, its content hash put right
if ! c++ -O1 $(pkg-config --cflags hdf5) -o "$base/links" tests/faults/links.cpp $(pkg-config --libs hdf5) 2> "$log"; then
  wrong "datasets that draw their values from elsewhere" "$(head -n 1 "$log")"; fi
mkfifo endless
for kind in soft external storage virtual filter; do
  cp $place linked.h5
  "$base/links" linked.h5 $kind "$(case $kind in external | virtual) echo "$tree/out/s/T200/static.h5" ;; *) echo "$tree/endless" ;; esac)" || wrong "a dataset by $kind" "is not made"
  digits=$(($(grep -a -b -o -m1 'in place of these digits: ' linked.h5 | head -n 1 | cut -d: -f1) + 26))
  printf '%064d' 0 | dd of=linked.h5 bs=1 seek=$digits conv=notrunc status=none
  sha256sum < linked.h5 | head -c 64 | dd of=linked.h5 bs=1 seek=$digits conv=notrunc status=none
  said_of='link'
  [ $kind != storage ] && [ $kind != virtual ] || said_of='another file'
  [ $kind != filter ] || said_of='filter 3'
  for program in "gear-plot fig12 --output x" gear-inspect; do
    rejected "a dataset by $kind: ${program%% *}" 3 "linked.h5 /transmission_error $said_of" "$bin"/$program linked.h5; done
done
rm -f endless linked.h5

# --- scenes
to_scene=("$bin/gear-scene" --output x.mk --out x --scene)
{ printf 'a'; yes .a | head -n 1000000 | tr -d '\n'; echo ' = 1'; } > deep.toml
rejected "a key of a million parts" 3 'deep.toml:1 megabyte' "${to_scene[@]}" deep.toml
{ printf 'title = "x" # ............................................\na'; yes .a | head -n 100000 | tr -d '\n'; echo ' = 1'; } > deep.toml
rejected "a key of a hundred thousand parts" 3 'deep.toml:2 key 32' "${to_scene[@]}" deep.toml
{ printf 'title = "'; head -c 200000 /dev/zero | tr '\0' x; echo '"'; grep -v '^title' s.toml; } > long.toml
rejected "a title of 200 kB" 3 "title 200000 500" "${to_scene[@]}" long.toml
rejected "a path of 120 kB" 4 'name long' bash -c "'$bin/gear-scene' --output x.mk --out x --scene \"\$(head -c 60000 /dev/zero | tr '\\0' x | sed 's|.|x/|g')s.toml\""
rejected "a name of 100 kB" 3 'name 100000 100' bash -c "'$bin/gear-scene' --output x.mk --out x --scene \"\$(head -c 100000 /dev/zero | tr '\\0' x).toml\""
{ printf '"\\u001b[31mred" = 1\n'; cat s.toml; } > red.toml
rejected "a key with control characters" 3 "red.toml:1 <U+001B>[31mred" "${to_scene[@]}" red.toml
sed 's/^module_mm = .*/module_mm = 0.049999999999999/' s.toml > near.toml
rejected "a value beside its limit" 3 '0.049999999999999 0.05' "${to_scene[@]}" near.toml
sed '0,/^\[gear.wheel\]/s//[gear.pinion.crack]\ndepth_mm = 1e-9\n[gear.wheel]/' s.toml > crack.toml
rejected "a crack of 1e-9 mm" 3 'crack.toml:* [gear.pinion] depth_mm 1e-09 0.01 0.03' "${to_scene[@]}" crack.toml


# --- what a scene makes expensive is said before anything is computed
costs() { sed "$1" s.toml > dear.toml; "${to_scene[@]}" dear.toml 2>&1 | grep -c -E "$2"; }
[ "$(costs 's/^strips = [^ ]*/strips = 1001/; /^positions/d' 'dear.toml: gear-static takes about [0-9]+ min: strips = 1001, 128 positions')" = 1 ] &&
  [ "$(costs 's/^element_mm = .*/element_mm = 0.1/' 'gear-reduce, .* takes about [0-9]+ min: element_mm = 0.1 is 0.0333.* modules')" = 1 ] &&
  [ "$(costs 's/^body = "modal"/body = "full"/' 'body = "full" finds all modes by dense algebra')" = 1 ] &&
  [ "$(costs '' 'take')" = 0 ] && ok "gear-scene says what a scene makes expensive, and nothing of an ordinary one" ||
  wrong "gear-scene says what a scene makes expensive" "$("${to_scene[@]}" dear.toml 2>&1 | head -n 2)"

# --- files
before=$(find . -name '.*' | sort)
rejected "--output ''" 2 '--output empty' "$bin/gear-plot" fig12 --output '' $place
rejected "--out ''" 2 '--out empty' "$bin/gear-scene" --scene s.toml --output x.mk --out ''
[ "$(find . -name '.*' | sort)" = "$before" ] || wrong "--output ''" "has written hidden files"
# exec keeps the number of the process that the name of the temporary file holds
(
  ln -s precious.toml "x.mk.tmp.$(hostname).$BASHPID"
  exec "$bin/gear-scene" --scene s.toml --out x --output x.mk
) > "$log" 2>&1
if [ "$(cat precious.toml)" = precious ] && [ -s x.mk ] && [ ! -L x.mk ]; then ok "a link in the place of a temporary file is not followed"; else
  wrong "a link in the place of a temporary file is not followed" "$(head -n 1 precious.toml)"; fi

# --- memory, time, clocks
if [ -z "$sanitize" ]; then
  rejected "an address space too small for linear algebra" 1 'address space MB limit' \
    bash -c "ulimit -v 400000; exec '$bin/gear-reduce' --params out/s/pinion/body.toml --mesh out/s/pinion/mesh.h5 --output x.h5"
fi
WHINE_PROGRESS_SECONDS=0 "$bin/gear-static" --params out/s/params/static.toml "${pair[@]}" --torque 100 --output x.h5 2> said
[ "$(grep -c -E '^gear-static: mesh positions: [0-9]+ of 32 after .* min left$' said)" -ge 31 ] && ok "gear-static says how far it is where there is no terminal" ||
  wrong "gear-static says how far it is where there is no terminal" "$(head -n 1 said)"
make_ SCENE=s.toml $place
touch -d '1 hour' "$B/id/gear-static"
make_ SCENE=s.toml $place
make_ SCENE=s.toml $place
if grep -q 'bin/gear-static ' "$log"; then wrong "a program's hash of the future" "redoes results in every run"; else ok "a program's hash of the future redoes results once"; fi
