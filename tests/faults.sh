#!/usr/bin/env bash
# What may happen to a run: kills, full and read-only disks, interrupted renames, damaged files, clocks that go back, two
# makes on one tree, files of two scenes. After each, the next make ends with the bytes of a run that nothing has happened
# to, or stops with one line that names the file, the reason and the target that makes it anew.
#
# FAULT_KILLS kills, FAULT_SEED (1) for their moments and for the bits that flip; FAULT_BITS (1) per dataset. FAULTS=short is
# what `make test` has time for: few kills, one damaged artifact, no disks, no second folder or user.
source tests/cases
[ "${FAULTS:-short}" = short ] && short=1 || short=
kills=${FAULT_KILLS:-3} bits=${FAULT_BITS:-1}
RANDOM=${FAULT_SEED:-1}
base=$(mktemp -d)
mounted=
trap '[ -z "$mounted" ] || umount "$mounted"; rm -rf "$base"' EXIT

# A tree of its own with the real programs, and a coarse scene.
plant() {
  copy_of_tree "$1"
  sed 's/^element_mm = [^ ]*/element_mm = 1.5/; s/^element_order = [^ ]*/element_order = 1/; s/^torque_Nm = .*/torque_Nm = [100]/
    s/^mesh_frequency_Hz = .*/mesh_frequency_Hz = { from = 2000, to = 2100, step = 50 }/
    s/^modes = [^ ]*/modes = 5/; s/^\[discretisation\]/&\npositions = 16/; s/^steps_per_period = [^ ]*/steps_per_period = 32/
    s/^min_sample_rate_kHz = [^ ]*/min_sample_rate_kHz = 50/' data/scenes/parker2000-standard-tooth.toml > "$1/own.toml"
  cat > "$1/few.toml" << 'END'
title = "Two loads, two dampings"
scene = "own.toml"
stage = "sweep"
plan = "grid"
quantities = ["te_peak_to_peak", "rms_max_up"]
[[vary]]
key = "operation.torque_Nm"
values = [100, 150]
[[vary]]
key = "damping.rayleigh_stiffness_s"
values = [5.5e-6, 7.7e-6]
END
}
tree=$base/tree log=$base/log
plant "$tree"
cd "$tree" || exit 1
at=out/own/T100
goals="$at/impact.h5 $at/down/response.h5 $at/pairs/up/response.h5 fig12"
[ -n "$short" ] || goals="$goals $at/loaded_0.25.h5 study STUDY=few.toml"
make_() { make $sanitize SCENE=own.toml "$@" > "$log" 2>&1; }
# Of out, which may be a link; of links in it nothing.
contents() { find -H out -type f ! -name '*.tmp.*' -print0 | sort -z | xargs -0 -r sha256sum; }
inspect=$B/bin/gear-inspect

# --- a run that nothing happens to; what all others are measured by
make_ -j1 $goals || { wrong "a coarse scene runs" "$(tail -n 2 "$log" | tr '\n' ' ')"; exit 1; }
expected=$(contents)
if said=$("$inspect" --check 2>&1) && [ -z "$said" ]; then ok "gear-inspect --check is silent when all is well"; else
  wrong "gear-inspect --check is silent when all is well" "$(head -n 1 <<< "$said")"; fi

# whole: every file that is there is one of the run that nothing happened to
whole() { contents | grep -v -x -F -f <(echo "$expected"); }
# again <claim>: the next make ends with the same bytes and leaves nothing else
again() {
  local left
  if ! make_ $goals; then wrong "$1" "the next make fails: $(grep error "$log" | head -n 1)"; restore
  elif [ "$(contents)" != "$expected" ]; then wrong "$1" "other bytes: $(diff <(echo "$expected") <(contents) | sed -n 's/^[<>] [0-9a-f]* *//p' | sort -u | head -n 3 | tr '\n' ' ')"; restore
  elif left=$(find -H out -name '*.tmp.*' | head -n 1); [ -n "$left" ]; then wrong "$1" "$left is left"; restore
  else ok "$1"; fi
}
cp -a out "$base/whole"
restore() { find -H out -mindepth 1 -delete; cp -a "$base/whole/." out; }
# one_line <claim> <pattern>: the last make stopped, and a program said why in one line with file, reason and target
one_line() {
  local lines
  lines=$(grep -c '^gear-[a-z-]*: error: ' "$log")
  if [ "$lines" = 1 ] && grep -q -E "^gear-[a-z-]*: error: .*($2)" "$log"; then ok "$1"; else
    wrong "$1" "$lines lines: $(grep -m1 'error' "$log")"; fi
}

# --- the same bytes, however they are made
for jobs in 1 2; do
  [ -z "$short" ] || break
  other=$base/elsewhere/$jobs; plant_from=$PWD; cd "$top" && plant "$other" && cd "$other" || exit 1
  make_ -j$jobs $goals
  if [ "$(contents)" = "$expected" ]; then ok "$jobs job$([ $jobs = 1 ] || echo s), another folder: the same bytes"; else
    wrong "$jobs jobs, another folder: the same bytes" "$(diff <(echo "$expected") <(contents) | head -n 2 | tr '\n' ' ')"; fi
  cd "$plant_from" && rm -rf "$other" || exit 1
done
if [ -n "$short" ]; then :; elif [ "$(id -u)" != 0 ] || ! command -v setpriv > /dev/null; then skip "another user: the same bytes (not root)"; else
  other=$base/other; cd "$top" && plant "$other" && chown -R 65534:65534 "$other" && chmod 755 "$base" && cd "$other" || exit 1
  setpriv --reuid=65534 --regid=65534 --clear-groups env HOME="$other" make $sanitize SCENE=own.toml $goals > "$base/log.other" 2>&1
  if [ "$(contents)" = "$expected" ]; then ok "another user: the same bytes"; else
    wrong "another user: the same bytes" "$(tail -n 1 "$base/log.other")"; fi
  cd "$tree" && rm -rf "$other" || exit 1
fi

# --- kills: make and all that it runs, at a moment of the run that is left when a stage has yet to be done
stages=("out/bodies/*/mesh.h5" "out/bodies/*/body.h5" "$at/static.h5" "$at/impact.h5" "$at/down/sweep.h5" "$at/pairs/up/sweep.h5"
  "$at/down/response.h5" "out/own/report/transmission-error.*")
[ -n "$short" ] || stages+=("$at/loaded_0.25.h5" "out/studies/few/variants/*/*.h5" "out/studies/few/study.h5")
declare -A lasts
for stage in "${stages[@]}"; do
  rm -f $stage; begin=$(date +%s%N); make_ $goals; lasts[$stage]=$((($(date +%s%N) - begin) / 1000000))
done
killed=0 survived=0 late=0 faults=
for ((k = 0; killed < kills && late < 3 * kills; )); do
  stage=${stages[k % ${#stages[@]}]}
  rm -f $stage
  setsid make $sanitize SCENE=own.toml $goals > "$log" 2>&1 &
  group=$!
  sleep "$(printf '%d.%03d' $((lasts[$stage] * RANDOM / 32768 / 1000)) $((lasts[$stage] * RANDOM / 32768 % 1000)))"
  kill -KILL -- "-$group" 2> /dev/null
  wait "$group" 2> /dev/null
  status=$?
  # A program that waits for the disk dies after it, and its temporary file is nobody's from then on only.
  for ((wait = 0; wait < 200; ++wait)); do kill -0 -- "-$group" 2> /dev/null || break; sleep 0.05; done
  if [ $status = 137 ]; then
    killed=$((killed + 1)) k=$((k + 1))
    part=$(whole)
    if [ -n "$part" ]; then faults="$faults killed at $stage: $part"
    elif ! make_ $goals; then faults="$faults killed at $stage: the next make fails: $(grep -m1 error "$log")"
    elif [ "$(contents)" != "$expected" ] || [ -n "$(find out -name '*.tmp.*')" ]; then
      faults="$faults killed at $stage: the next make leaves $(diff <(echo "$expected") <(contents) | sed -n 's/^[<>] [0-9a-f]* *//p') $(find out -name '*.tmp.*')"
    else survived=$((survived + 1)); continue; fi
    restore
  else
    late=$((late + 1)) # it had ended already: another moment
  fi
done
if [ $survived != $killed ]; then wrong "$kills kills, seed ${FAULT_SEED:-1}" "$survived of $killed survived; $faults"
elif [ $killed -gt 0 ]; then ok "$killed kills, seed ${FAULT_SEED:-1}, at random moments of ${#stages[@]} stages: $survived survived"; fi
# Moments are shares of times measured before: where these were long, because others had the machine, makes end before they are hit.
[ $killed = "$kills" ] || skip "$((kills - killed)) of $kills kills: $late came after make had ended"

# --- disks
if [ -n "$short" ]; then :; elif [ "$(id -u)" = 0 ] && mkdir -p "$base/disk" && mount -t tmpfs -o size=8m tmpfs "$base/disk" 2> /dev/null; then
  mounted=$base/disk
  rm -rf out; ln -s "$base/disk/out" out; mkdir "$base/disk/out"
  size=$(du -sk "$base/whole" | cut -f1)
  for share in 3 12 25 50 90; do
    rm -rf "$base"/disk/out/* && mount -o remount,size=$((size * share / 100 + 8))k "$base/disk"
    if make_ $goals; then wrong "a disk with room for $share % of the files" "make did not fail"; continue; fi
    part=$(whole)
    if [ -n "$part" ]; then wrong "a disk with room for $share % of the files" "part of a file: $part"
    elif ! grep -q 'No space left on device' "$log"; then wrong "a disk with room for $share % of the files" "make does not say that it is full: $(tail -n 1 "$log")"
    else ok "a disk with room for $share % of the files: make says that it is full, and no file is part of one"; fi
    mount -o remount,size=64m "$base/disk"; again "a disk with room for $share % of the files, then for all"
  done
  rm -f out/own/T100/static.h5; mount -o remount,ro "$base/disk"
  make_ $goals && wrong "a read-only disk" "make did not fail" || { grep -q -i 'read-only' "$log" && ok "a read-only disk is named" || wrong "a read-only disk is named" "$(tail -n 1 "$log")"; }
  mount -o remount,rw "$base/disk"; again "a disk that was read-only and is not any more"
  rm out; umount "$base/disk"; mounted=; mkdir out; restore
else
  skip "full and read-only disk (no right to mount a tmpfs)"
fi
if [ "$(id -u)" = 0 ] && ! command -v setpriv > /dev/null; then skip "a read-only folder (root writes all the same)"; else
  rm -f $at/static.h5
  if [ "$(id -u)" = 0 ]; then as=(setpriv --reuid=65534 --regid=65534 --clear-groups); chmod 755 "$base"; else as=(); chmod a-w $at; fi
  "${as[@]}" "$B/bin/gear-static" --params out/own/params/static.toml --body pinion=out/own/pinion/body.h5 --body wheel=out/own/wheel/body.h5 \
    --torque 100 --output $at/static.h5 > /dev/null 2> "$log"
  chmod u+w $at; one_line "a read-only folder" "$at/static.h5: cannot create a file beside it .*Permission denied"
  again "and the next make"
fi

# --- system calls that fail; a sanitizer wants to be the first library
if [ -n "$short" ]; then :; elif [ -n "$sanitize" ] || ! cc -shared -fPIC -O1 -o "$base/calls.so" "$top/tests/faults/calls.c" 2> /dev/null; then skip "system calls that fail (needs cc, no sanitizer)"; else
  for fault in rename-kill rename-io fsync-io write-full write-short; do
    for file in $at/static.h5 $at/down/sweep.h5; do
      cp -p $file before; touch "$(case $file in */static.h5) echo out/own/params/static.toml ;; *) echo out/own/params/sweep.toml ;; esac)"
      FAULT=$fault LD_PRELOAD=$base/calls.so make $sanitize SCENE=own.toml $file > "$log" 2>&1
      status=$?
      if [ $fault = write-short ]; then [ $status = 0 ] || wrong "$fault of $file" "$(tail -n 1 "$log")"
      elif [ $status = 0 ]; then wrong "$fault of $file" "make did not fail"
      elif [ -e $file ] && ! cmp -s $file before; then wrong "$fault of $file" "the earlier file has changed"
      elif [ $fault != rename-kill ] && ! grep -q "error: $file: cannot" "$log"; then wrong "$fault of $file" "$(grep -m1 error "$log")"; fi
      again "$fault of ${file##*/}"
    done
  done
  rm -f before
fi

# --- damaged artifacts
victims=$(find out -name '*.h5' -type f | sort)
[ -z "$short" ] || victims=$at/down/sweep.h5
reader_of() { # the goal that reads a file
  case $1 in */mesh.h5) echo out/own/pinion/body.h5 ;; */body.h5) echo $at/static.h5 ;; */static.h5) echo $at/impact.h5 ;;
    */impact.h5 | */response.h5) ;; */sweep.h5) echo "${1%/*}/response.h5" ;; esac
}
# A file that reads as damaged, though make takes it for up to date.
rejected_and_remade() { # <claim> <file>
  local claim=$1 file=$2 goal
  goal=$(reader_of $file)
  if [ -n "$goal" ]; then
    rm -f $goal; touch -r "$base/stamp" $file
    if make_ $goals; then wrong "$claim" "make did not notice"; restore; return; fi
    one_line "$claim: make stops" "${file##*/}: .*(truncated|damaged|empty|no content hash).*make ((SCENE=own|STUDY=path/to/few).toml )?out/[^ ]*${file##*/}"
  fi
  if said=$("$inspect" --check 2>&1) || ! grep -q -E "$file: .*make ((SCENE=own|STUDY=path/to/few).toml )?$file" <<< "$said"; then wrong "$claim: gear-inspect --check names it" "$said"; fi
  rm -f $file; again "$claim: deleted as it says, and made again"
}
for file in $victims; do
  touch -r $file "$base/stamp"; truncate -s $(($(stat -c %s $file) * RANDOM / 32768)) $file
  rejected_and_remade "a truncated ${file##*/}" $file
done
touch -r $at/down/sweep.h5 "$base/stamp"; : > $at/down/sweep.h5; rejected_and_remade "an empty sweep.h5" $at/down/sweep.h5
if ! c++ -O1 $(pkg-config --cflags hdf5) -o "$base/layout" "$top/tests/faults/layout.cpp" $(pkg-config --libs hdf5) 2> "$log"; then
  wrong "where the values of a dataset stand" "$(head -n 1 "$log")"; fi
flipped=0 found=0
for file in $victims; do
  missed=
  while read -r dataset first count; do
    for ((i = 0; i < bits; ++i)); do
      [ "$count" -gt 0 ] || continue
      place=$((first + (RANDOM * 32768 + RANDOM) % count))
      old=$(od -An -tu1 -j $place -N1 $file)
      printf "\\$(printf %03o $((old ^ (1 << RANDOM % 8))))" | dd of=$file bs=1 seek=$place conv=notrunc status=none
      flipped=$((flipped + 1))
      if "$inspect" $file > /dev/null 2> "$log" || ! grep -q -E "$file: .*make ((SCENE=own|STUDY=path/to/few).toml )?$file" "$log"; then missed="$missed $dataset"; else found=$((found + 1)); fi
      printf "\\$(printf %03o $old)" | dd of=$file bs=1 seek=$place conv=notrunc status=none
    done
  done < <("$base/layout" $file)
  [ -z "$missed" ] || wrong "a flipped bit in $file" "not found in $missed"
done
[ $flipped -gt 30 ] && [ $found = $flipped ] && ok "$flipped flipped bits, $bits in each dataset of ${victims//$'\n'/ }: $found found" ||
  wrong "flipped bits" "$found of $flipped found"
again "and flipped back, nothing has changed"

# --- clocks
find out -exec touch -h -d '+3 years' {} +; make_ $goals
if [ -z "$(find out -type f -newermt '+1 day')" ]; then ok "times in the future are brought to the present"; else wrong "times in the future are brought to the present" "$(find out -type f -newermt '+1 day' | head -n 1)"; fi
again "all artifacts of a time to come"
find out -name '*.h5' -exec touch -d '+3 years' {} +
sed -i 's/^corner_contact = true/corner_contact = false/' own.toml; make_ $goals
if make_ -n $goals && ! grep -q -x -F "$(grep static.h5 <<< "$expected")" <<< "$(contents)" && "$inspect" --check --scene own.toml; then
  ok "a scene that changes when the clock was set back redoes what depends on it"; else
  wrong "a scene that changes when the clock was set back redoes what depends on it" "$(tail -n 1 "$log")"; fi
sed -i 's/^corner_contact = false/corner_contact = true/' own.toml
# Variants that no study asks for any more stay, for the day when it asks again.
[ -n "$short" ] || find out/studies -path '*/variants/*' -type f | while read -r file; do
  grep -q -F "  $file" <<< "$expected" || rm "$file"; done
again "and the same when it changes back"
touch -d 1990-01-01 own.toml out/own/params/*.toml; again "a scene and stage parameters from 1990"
touch -d 1990-01-01 out/own/pinion/body.h5; again "a body older than its mesh"

# --- two makes
rm -rf out
make $sanitize SCENE=own.toml $goals > "$log.1" 2>&1 & one=$!
make $sanitize SCENE=own.toml $goals > "$log.2" 2>&1; two=$?
wait $one; one=$?
part=$(whole)
[ -z "$part" ] && ok "two makes on one tree: every file is whole (status $one, $two)" || wrong "two makes on one tree" "$part"
again "two makes on one tree: the next one ends with the same bytes"

# --- by hand, from files of two scenes
sed 's/^bore_radius_mm = .*/bore_radius_mm = 38.0/' own.toml > two.toml
make $sanitize SCENE=two.toml out/two/T100/static.h5 > "$log" 2>&1 || wrong "a second scene runs" "$(tail -n 1 "$log")"
# mixed <claim> <pattern> <command...>
mixed() {
  "${@:3}" > /dev/null 2> "$log" && wrong "$1" "it ran" || one_line "$1" "$2"
  [ ! -e mixed.h5 ] || { wrong "$1" "a result was written"; rm mixed.h5; }
}
one_pair=(--body pinion=out/own/pinion/body.h5 --body wheel=out/own/wheel/body.h5) two_pair=(--body pinion=out/two/pinion/body.h5 --body wheel=out/two/wheel/body.h5)
mixed "a mesh of another scene" 'make' "$B/bin/gear-reduce" --params out/own/pinion/body.toml --mesh out/two/pinion/mesh.h5 --output mixed.h5
mixed "bodies of another scene" 'make' "$B/bin/gear-static" --params out/own/params/static.toml "${two_pair[@]}" --torque 100 --output mixed.h5
for stage in "gear-sweep --direction up" gear-impact; do
  name=${stage%% *}
  mixed "$name with statics of another scene" 'stale.*make SCENE=two.toml out/two/T100/static.h5' "$B"/bin/$stage --params out/own/params/${name#gear-}.toml \
    "${one_pair[@]}" --static out/two/T100/static.h5 --reference-static $at/static.h5 --output mixed.h5
done
mixed "a lumped model with the wave of another scene" 'another body pinion' "$B/bin/gear-lumped" --model rectangular --static $at/static.h5 \
  --reference-static out/two/T100/static.h5 --params out/own/params/sweep.toml --direction up --output mixed.h5
cp out/two/pinion/body.h5 "$(readlink -f out/own/pinion)/body.h5"
mixed "an input that another scene's file was copied over" 'make' "$B/bin/gear-spectra" --input $at/down/sweep.h5 --output mixed.h5
make_ ${goals% study *} && wrong "make with a body of another scene in place of its own" "make did not fail" ||
  one_line "make with a body of another scene in place of its own" 'body.h5.*make'
rm -rf "$(readlink -f out/two/pinion)" out/two out/own/pinion/body.h5; again "deleted as it says, and made again"
