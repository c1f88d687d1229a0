# The pages (every README.md): links and anchors lead somewhere, paths, programs, options, keys, datasets, variables, targets and
# functions (`name()`) that they name exist, their make commands pass `make -n`, generated tables are up to date, and pages stay short.
#
# Of the text only code is read: spans in backticks and indented or fenced lines. tests/pages.exceptions lists what cannot be checked,
# with a reason each. A page with planted faults shows that each check can fail.
set -uo pipefail
B=${B:-build}
top=$PWD
bin=$PWD/$B/bin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
set -f # words of pages are no patterns
export SLURM_ARRAY_TASK_ID=1 # of a command for a cluster

ok() { echo "ok: $1"; }
wrong() { echo "FAILED: $1: $2"; }

mapfile -t pages < <(find . -name README.md -not -path './build/*' -not -path './out/*' -not -path './.git/*' | sed 's|^\./||' | sort)

# A shell that starts a process for each word, link or header takes minutes: loops over them are of bash alone.
# there <pattern>: whether there is such a path
there() {
  local status
  set +f
  compgen -G "$1" > /dev/null
  status=$?
  set -f
  return $status
}
# plain_path <path>: without its /./ and /../, from the top, in $plain
plain_path() {
  local part parts=()
  local IFS=/
  for part in $1; do
    case $part in
      '' | .) ;;
      ..) if [ ${#parts[@]} -gt 0 ] && [ "${parts[-1]}" != .. ]; then unset 'parts[-1]'; else parts+=(..); fi ;;
      *) parts+=("$part") ;;
    esac
  done
  plain="${parts[*]}"
  [[ $1 != /* ]] || plain=/$plain
}

# --- what there is
# What a page consists of, a line each: kind (link, code, block, heading), line number, text.
parts_of() {
  awk '
    function say(kind, text) { print kind "\t" FNR "\t" text }
    /^ *```/ { fenced = !fenced; blank = 0; next }
    fenced || (/^    / && (blank || indented)) { indented = !fenced; say("block", $0); next }
    { indented = 0; blank = /^ *$/ }
    /^#+ / { title = $0; sub(/^#+ /, "", title); say("heading", title) }
    { rest = $0; plain = ""
      while (match(rest, /`[^`]+`/)) {
        say("code", substr(rest, RSTART + 1, RLENGTH - 2)); plain = plain substr(rest, 1, RSTART - 1); rest = substr(rest, RSTART + RLENGTH) }
      plain = plain rest
      while (match(plain, /\]\([^)]*\)/)) { say("link", substr(plain, RSTART + 2, RLENGTH - 3)); plain = substr(plain, RSTART + RLENGTH) } }
  ' "$1"
}
# The anchors that GitHub gives to the headings of a page.
anchors_of() {
  parts_of "$1" | awk -F '\t' '$1 == "heading" { a = tolower($3); gsub(/[^a-z0-9 _-]/, "", a); gsub(/ /, "-", a)
    print a (seen[a]++ ? "-" seen[a] - 1 : "") }'
}
declare -A anchor is_target is_variable is_key help_of excepted
for page in "${pages[@]}"; do while read -r a; do anchor[$page#$a]=1; done < <(anchors_of "$page"); done
makefiles=$(cat Makefile pipelines/names.mk; set +f; cat pipelines/*.mk)
while read -r name; do is_target[$name]=1; done < <(sed -n 's/^\([a-z0-9-]*\):.*## .*/\1/p' <<< "$makefiles")
while read -r name; do is_variable[$name]=1; done < <(grep -o -w '[A-Z][A-Z_]\+' <<< "$makefiles" | sort -u)
while read -r name; do is_key[$name]=1; done < <("$bin/gear-scene" --keys | cut -d'|' -f3 | tr -d '` ')
programs=$(set +f; cd tools && echo gear-*.cpp)
for program in ${programs//.cpp/}; do help_of[$program]=$("$bin/$program" --help | tr -s ' \n,' '   '); done
sources_of_functions=$(set +f; cat common/*/*.h common/*/*.cpp common/io/rexs/*.h common/io/rexs/*.cpp tools/*.cpp tests/*.cpp tests/*/*.cpp)
sources_of_files=$(set +f; cat common/io/*.h common/io/*.cpp common/io/*/*.h common/io/*/*.cpp common/results/*.h common/model/*.cpp)
while IFS= read -r line; do
  case $line in '#'* | '') continue ;; esac
  excepted["${line%%  # *}"]=1
  [ "${line#*  # }" != "$line" ] || wrong "each line of tests/pages.exceptions has a reason" "$line"
done < tests/pages.exceptions

# --- what is said
# faults_of <page>: a line for each thing that the page names and that is not there; make commands go to $work/commands
faults_of() {
  local page=$1 kind line text word file name first
  local folder=${page%/*}
  [ "$folder" != "$page" ] || folder=.
  while IFS=$'\t' read -r kind line text; do
    [ -n "$text" ] || continue
    if [ -n "${excepted[$text]:-}" ]; then echo "$text" >> "$work/used"; continue; fi
    case $kind in
      link)
        case $text in http://* | https://*) continue ;; esac
        file=${text%%#*}
        name=${text#"$file"}
        plain_path "$folder/${file:-${page##*/}}"
        file=$plain
        if [ ! -e "$file" ]; then echo "$page:$line: link to $text: no such file"
        elif [ -n "$name" ] && [ -z "${anchor[$file$name]:-}" ]; then echo "$page:$line: link to $text: no such heading"; fi
        continue ;;
      heading) continue ;;
    esac
    first=
    for word in $text; do
      word=${word#[\'\"(]}
      while [[ $word == *[\'\",.\;:\)] ]]; do word=${word%?}; done
      [ -n "$word" ] || continue
      [ -n "$first" ] || first=${word##*/}
      [ -z "${excepted[$word]:-}" ] || { echo "$word" >> "$work/used"; continue; }
      case $word in
        *'<'* | *...* | *'$'* | *'{'*) ;;
        common/* | tools/* | pipelines/* | data/* | tests/*)
          there "$word" || echo "$page:$line: $word: no such path" ;;
        gear-*.[a-z]* | whine-*.[a-z]*) ;;
        gear-* | build/bin/gear-*)
          [ -n "${help_of[${word##*/}]:-}" ] || echo "$page:$line: $word: no such program" ;;
        whine-* | build/bin/whine-*)
          [[ $makefiles == *"/bin/${word##*/}"* ]] || echo "$page:$line: $word: no such program" ;;
        --[a-z]*)
          name=${word%%=*}
          case $text in *'-->'*) continue ;; esac # an arrow of the flow
          case $first in
            gear-*) [[ "${help_of[$first]:-} " == *" $name "* ]] || echo "$page:$line: $first has no option $name" ;;
            --*) [[ "${help_of[*]} " == *" $name "* ]] || echo "$page:$line: no program has the option $name" ;;
          esac ;;
        [A-Z][A-Z_]*=*)
          [ -n "${is_variable[${word%%=*}]:-}" ] || echo "$page:$line: ${word%%=*}: no makefile has such a variable" ;;
        /[a-z]*)
          [[ $word == /usr/* || $sources_of_files == *"${word##*/}"* ]] || echo "$page:$line: $word: no artifact has such a dataset" ;;
      esac
    done
    # keys of a scene, a study or a plan of readings
    if [ "$kind" = code ] && { [[ $text =~ ^([a-z_]+)\ =\  ]] || [[ $text =~ ^([a-z_]+_(mm|um|deg|Hz|kHz|Nm|GPa|kgm3|kgm2|per_s))$ ]]; }; then
      name=${BASH_REMATCH[1]}
      [ -n "${is_key[$name]:-}" ] || [[ $sources_of_files == *"$name"* ]] || echo "$page:$line: $name: no such key"
    fi
    # functions: `name()`, `Class::name()`
    if [ "$kind" = code ] && [[ $text =~ ^([A-Za-z_]+::)*([A-Za-z_]+)\(\)$ ]]; then
      name=${BASH_REMATCH[2]}
      [[ $sources_of_functions == *"$name("* ]] || echo "$page:$line: $name(): no such function"
    fi
    # commands of make: targets by name, the whole by a dry run
    if [[ $text =~ (^|[\ \'])make\ (.*) ]] && [[ $text != *...* && $text != *'<'* ]]; then
      text=${BASH_REMATCH[2]}
      text=${text%%  #*}
      text=${text%% # *}
      [[ ${BASH_REMATCH[1]} != \' ]] || text=${text%\'*}
      local words=()
      eval "words=($text)" 2> /dev/null || echo "$page:$line: make $text: no command"
      for word in "${words[@]}"; do
        case $word in
          -* | *=* | out/* | build/bin/*) ;;
          *) [ -n "${is_target[$word]:-}" ] || echo "$page:$line: make $word: no such target" ;;
        esac
      done
      printf '%s\t%s\n' "$page:$line" "$text" >> "$work/commands"
    fi
  done < <(parts_of "$page")
}

# --- planted faults
cat > "$work/planted.md" << 'PLANTED'
# Planted

A [link](no-such-file.md), one to [a heading](planted.md#no-such-heading), `common/motion/no_such_file.cpp`, `tests/no_such_*.cpp`,
`gear-nosuch`, `gear-sweep --no-such-option`, `--no-such-option`, `NO_SUCH_VARIABLE=1`, `/no_such_dataset`, `no_such_key_mm`, `no_such_key = 1`,
`no_such_function()`, `NoSuchClass::no_such_member()`.

    make no-such-target
    make SCENE=no-such.toml static
PLANTED
mapfile -t expected << 'EXPECTED'
link to no-such-file.md: no such file
link to planted.md#no-such-heading: no such heading
common/motion/no_such_file.cpp: no such path
tests/no_such_*.cpp: no such path
gear-nosuch: no such program
gear-sweep has no option --no-such-option
no program has the option --no-such-option
NO_SUCH_VARIABLE: no makefile has such a variable
/no_such_dataset: no artifact has such a dataset
no_such_key_mm: no such key
no_such_key: no such key
no_such_function(): no such function
no_such_member(): no such function
make no-such-target: no such target
EXPECTED
found=$(faults_of "$work/planted.md")
missing=$(for fault in "${expected[@]}"; do grep -q -F ": $fault" <<< "$found" || echo "$fault"; done)
if [ -z "$missing" ] && [ "$(wc -l <<< "$found")" = ${#expected[@]} ]; then ok "each of ${#expected[@]} planted faults is found"; else
  wrong "each planted fault is found" "$(tr '\n' '|' <<< "${missing:-$found}")"; fi
rm -f "$work/commands" "$work/used"

# --- the pages
for page in "${pages[@]}"; do
  found=$(faults_of "$page")
  if [ -z "$found" ]; then ok "links, paths and names of $page"; else wrong "links, paths and names of $page" "$(tr '\n' '|' <<< "$found")"; fi
  limit=300
  [ "$page" != README.md ] || limit=200
  lines=$(sed '/^<!-- .* -->$/,/^<!-- end of .* -->$/d' "$page" | wc -l) # a table that `make docs-tables` writes is looked up, not read
  [ "$lines" -le $limit ] && ok "$page has $lines lines" || wrong "$page is short" "$lines lines; at most $limit"
done
found=$(for folder in tools pipelines data tests common $(set +f; echo common/*/); do [ -e "${folder%/}/README.md" ] || echo "${folder%/}"; done)
[ -z "$found" ] && ok "every folder has its page" || wrong "every folder has its page" "$found"
found=$(set +f; declare -A text; for header in common/*/*.h common/io/rexs/*.h; do
  folder=${header%/*} folder=${folder%/rexs}
  [ -n "${text[$folder]:-}" ] || text[$folder]=$(< "$folder/README.md")
  [[ ${text[$folder]} == *"\`$header\`"* ]] || echo "$header"; done)
[ -z "$found" ] && ok "every header of a layer stands on its page" || wrong "every header of a layer stands on its page" "$(tr '\n' ' ' <<< "$found")"
linked=$(for page in "${pages[@]}"; do parts_of "$page" | awk -F '\t' '$1 == "link" && $3 !~ /^http/ { sub(/#.*/, "", $3); if ($3 != "") print $3 }' |
  while read -r target; do case $page in */*) plain_path "${page%/*}/$target" ;; *) plain_path "$target" ;; esac; echo "$plain"; done; done | sort -u)
found=$(for page in "${pages[@]}"; do [ "$page" = README.md ] || [[ $'\n'$linked$'\n' == *$'\n'"$page"$'\n'* ]] || echo "$page"; done)
[ -z "$found" ] && ok "every page is linked from another" || wrong "every page is linked from another" "$found"
found=$(for program in ${programs//.cpp/}; do grep -q -E "^\| \`$program\` \| ([^\`]|\`[^-])" tools/README.md || echo "$program"; done)
[ -z "$found" ] && ok "tools/README.md says what each program reads and writes" || wrong "tools/README.md says what each program reads and writes" "$found"

found=$(grep -r -o -h -E '\<(common|tools|pipelines|data|tests)/[a-z/]*README\.md' --include='*.cpp' --include='*.h' --include='*.toml' --include='*.mk' common tools pipelines data tests |
  sort -u | while read -r page; do [ -e "$page" ] || echo "$page"; done)
[ -z "$found" ] && ok "pages that sources and scenes name are there" || wrong "pages that sources and scenes name are there" "$found"

# --- make commands, in a tree of their own that shares sources and programs; stand-ins for the files of a user
mkdir -p "$work/tree/$B" "$work/tree/path/to"
for part in Makefile .clang-tidy common tools pipelines tests; do ln -s "$top/$part" "$work/tree/$part"; done
cp -a data "$work/tree"
for part in bin obj id; do ln -s "$top/$B/$part" "$work/tree/$B/$part"; done
cp -p "$B/flags" "$work/tree/$B"
for name in my-pair mass x path/to/x path/to/pair path/to/scene; do cp data/scenes/first-pair.toml "$work/tree/$name.toml"; done
sed 's|\.\./scenes|../../data/scenes|' data/studies/tolerances.toml > "$work/tree/path/to/it.toml"
cp data/studies/tolerances.toml "$work/tree/data/studies/big.toml"
compiler=$(sed 's/ -Icommon .*//' "$B/flags")
[ "$B" = build ] && sanitize= || sanitize=SANITIZE=1
# A line for each set of variables: where it stands, the variables, the targets. What is to be installed is no part of it, and under
# sanitizers other objects would be compiled.
while IFS=$'\t' read -r place command; do
  [ -z "${excepted[make $command]:-}" ] || { echo "make $command" >> "$work/used"; continue; }
  eval "words=($command)"
  variables='' targets=''
  for word in "${words[@]}"; do
    case $word in
      deps | deps-* | test-sanitize | -*) ;;
      *=*) variables="$variables $(printf '%q' "$word")" ;;
      *) targets="$targets $word" ;;
    esac
  done
  [ -z "$targets" ] || printf '%s\t%s\t%s\n' "${variables:- }" "$targets" "$place"
done < <(sort -t$'\t' -k2,2 -u "$work/commands") | sort -t$'\t' -k1,1 |
  awk -F '\t' '$1 != variables && NR > 1 { print variables "\t" targets "\t" places; targets = places = "" }
    { variables = $1; targets = targets $2; places = places " " $3 } END { print variables "\t" targets "\t" places }' > "$work/dry"
dry() { # variables, targets
  eval "words=($1 $2)"
  (cd "$work/tree" && env -u MAKEFLAGS make -n CXX="$compiler" $sanitize "${words[@]}") > "$work/said" 2>&1
}
if dry SCENE=no-such.toml static; then wrong "a make command of a scene that is not there is found" "it passes"; else ok "a make command of a scene that is not there is found"; fi
found=
while IFS=$'\t' read -r variables targets places; do # a blank stands for no variables
  dry "$variables" "$targets" || found="$found$places: make$variables$targets: $(grep -m1 -E '\*\*\*|: error:' "$work/said")|"
done < "$work/dry"
tried=$(wc -l < <(cut -f2 "$work/commands" | sort -u))
if [ -z "$found" ]; then ok "$tried commands of make pass make -n"; else wrong "commands of make pass make -n" "$found"; fi
touch "$work/used"
found=$(printf '%s\n' "${!excepted[@]}" | grep -v -x -F -f "$work/used")
[ -z "$found" ] && ok "every line of tests/pages.exceptions is needed" || wrong "every line of tests/pages.exceptions is needed" "$found"

# --- generated tables
for table in data/README.md:keys pipelines/README.md:targets pipelines/README.md:datasets tools/README.md:options data/scenes/README.md:scenes data/studies/README.md:studies; do
  page=${table%:*} name=${table#*:} claim="the table of ${table#*:} in ${table%:*} is up to date"
  sed "1,/^<!-- $name -->\$/d; /^<!-- end of $name -->\$/,\$d" "$page" > "$work/table"
  if [ -s "$work/table" ] && pipelines/tables.sh "$name" "$B/bin" | diff - "$work/table" > "$work/said"; then ok "$claim"; else
    wrong "$claim" "make docs-tables puts it there: $(head -n 2 "$work/said" | tr '\n' '|')"; fi
done

# --- the scorecard
card=$work/card
sed '1,/^<!-- gear-scorecard -->$/d; /^<!-- end of gear-scorecard -->$/,$d' data/published/README.md > "$card"
claim="the scorecard in data/published/README.md holds every claim with its printed value"
if [ -s "$card" ] && sed -n '3,$p' "$card" | awk -F ' [|] ' '{ print $1 " | " $2 " | " $3 " | " $4 " | " $5 " |" }' | diff - <("$bin/gear-scorecard" --claims --printed data/published/claims.toml) > "$work/said"
then ok "$claim"; else wrong "$claim" "make docs puts it there: $(head -n 2 "$work/said" | tr '\n' '|')"; fi
# columns 6 to 8: a verdict for each scene
for scene in 6:parker2000 7:parker2000-standard-tooth 8:parker2000-calibrated; do
  counts=$(sed -n '3,$p' "$card" | awk -F ' [|] ' -v column="${scene%%:*}" '{ v = $column
    if (v ~ /agrees$/) a++; else if (v ~ /differs$/) d++; else if (v ~ /(given|fitted)$/) g++; else if (v ~ /cannot be compared$/) c++
    else if (v ~ /misprint of P2000$/) m++; else bad++ }
    END { print a + 0 " agree, " d + 0 " differ, " g + 0 " given or fitted, " c + 0 " cannot be compared, " m + 0 " misprint of P2000" \
      (bad ? ", " bad " rows without a verdict" : "") }')
  claim="the bottom line of ${scene#*:} on README.md's first screen is that of its table"
  if grep -q -F "$counts" <<< "$(sed -n '1,60p' README.md | grep -F "| \`${scene#*:}\` |")"; then ok "$claim"; else wrong "$claim" "the table says $counts"; fi
done
