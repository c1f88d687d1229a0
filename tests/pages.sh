# The pages (every README.md): links and anchors lead somewhere, paths, programs, options, keys, datasets, variables, targets and
# functions (`name()`) that they name exist, their make commands pass `make -n`, generated tables are up to date, and pages stay short.
#
# Of the text only code is read: spans in backticks and indented or fenced lines. tests/pages.exceptions lists what cannot be checked,
# with a reason each. A page with planted faults shows that each check can fail.
source tests/cases
shopt -s globstar
bin=$PWD/$B/bin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
set -f # words of pages are no patterns
export SLURM_ARRAY_TASK_ID=1 # of a command for a cluster

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
makefiles=$(cat Makefile; set +f; cat pipelines/*.mk tests/*.mk)
while read -r name; do is_target[$name]=1; done < <(make help | sed -n 's/^  \([a-z0-9-]*\) .*/\1/p')
while read -r name; do is_variable[$name]=1; done < <(grep -o -w '[A-Z][A-Z_]\+' <<< "$makefiles" | sort -u)
while read -r name; do is_key[$name]=1; done < <("$bin/gear-scene" --keys | cut -d'|' -f3 | tr -d '` ')
programs=$(set +f; cd tools && echo gear-*.cpp)
for program in ${programs//.cpp/}; do help_of[$program]=$("$bin/$program" --help | tr -s ' \n,' '   '); done
sources_of_functions=$(set +f; cat common/**/*.h common/**/*.cpp tools/*.cpp tests/*.h tests/**/test_*.cpp)
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

# walls_of <page>: tables of more than 40 rows, cells of more than 200 characters
walls_of() {
  awk '
    function flush() { if (rows > 42) print FILENAME ":" FNR ": a table of " rows - 2 " rows; at most 40"; rows = 0 }
    !/^\|/ { flush(); next }
    { rows++; split($0, cells, / ?\| ?/); for (c in cells) if (length(cells[c]) > 200) print FILENAME ":" FNR ": a cell of " length(cells[c]) " characters; at most 200" }
    END { flush() }' "$1"
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
{ echo '| a | b |'; echo '|---|---|'; printf '| %0201d | |\n' 1; yes '| a | b |' | head -n 40; echo; } > "$work/walls.md"
[ "$(walls_of "$work/walls.md" | wc -l)" = 2 ] && ok "a table of 41 rows and a cell of 201 characters are found" || wrong "walls are found" "$(walls_of "$work/walls.md")"
rm -f "$work/commands" "$work/used"

# --- the pages
declare -A most_lines=([README.md]=160 [pipelines/README.md]=150 [tools/README.md]=80 [data/published/README.md]=120)
for page in "${pages[@]}"; do
  found=$(faults_of "$page")
  if [ -z "$found" ]; then ok "links, paths and names of $page"; else wrong "links, paths and names of $page" "$(tr '\n' '|' <<< "$found")"; fi
  limit=${most_lines[$page]:-300}
  lines=$(wc -l < "$page")
  [ "$lines" -le "$limit" ] && ok "$page has $lines lines" || wrong "$page is short" "$lines lines; at most $limit"
  found=$(walls_of "$page")
  [ -z "$found" ] && ok "tables of $page are short" || wrong "tables of $page are short" "$(tr '\n' '|' <<< "$found")"
done
found=$(for folder in tools pipelines data tests common $(set +f; echo common/*/); do [ -e "${folder%/}/README.md" ] || echo "${folder%/}"; done)
[ -z "$found" ] && ok "every folder has its page" || wrong "every folder has its page" "$found"
found=$(set +f; declare -A text; for header in common/**/*.h; do
  folder=${header#common/}; folder=common/${folder%%/*}
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
for part in bin id; do ln -s "$top/$B/$part" "$work/tree/$B/$part"; done
cp -p "$B/settings" "$work/tree/$B"
for name in my-pair mass x path/to/x path/to/pair path/to/scene; do { cat data/scenes/first-pair.toml; printf '[friction]\ncoefficient = 0.05\n'; } > "$work/tree/$name.toml"; done
cp data/scenes/helical-17-67.toml "$work/tree/my-helical.toml"
sed 's|\.\./scenes|../../data/scenes|' data/studies/tolerances.toml > "$work/tree/path/to/it.toml"
cp data/studies/tolerances.toml "$work/tree/data/studies/big.toml"
compiler=$(sed 's/ .*//' "$B/settings")
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
fresh() { # name of the table, where it stands, its text
  local claim="the table of $1 in $2 is up to date"
  if [ -s "$3" ] && pipelines/tables.sh "$1" "$B/bin" | diff - "$3" > "$work/said"; then ok "$claim"; else
    wrong "$claim" "make docs-tables puts it there: $(head -n 2 "$work/said" | tr '\n' '|')"; fi
}
fresh keys data/keys.tsv data/keys.tsv
for table in common/studies:features data/scenes:scenes data/studies:studies data/published:scorecard data/published:sets; do
  page=${table%:*}/README.md name=${table#*:}
  sed "1,/^<!-- $name -->\$/d; /^<!-- end of $name -->\$/,\$d" "$page" > "$work/table"
  fresh "$name" "$page" "$work/table"
done

# --- the scorecard
card=data/published/scorecard.tsv
claim="$card holds every claim with its printed value"
if grep -v '^#' "$card" | cut -f1-7 | diff - <("$bin/gear-scorecard" --claims --printed data/published/claims.toml) > "$work/said"
then ok "$claim"; else wrong "$claim" "make docs puts it there: $(head -n 2 "$work/said" | tr '\n' '|')"; fi
# the counts above it, from the verdicts of each scene: columns 11, 16 and 21
for scene in 11:parker2000 16:parker2000-standard-tooth 21:parker2000-calibrated; do
  counts=$(awk -F '\t' -v column="${scene%%:*}" '!/^#/ { n[$column]++ }
    END { print n["agrees"] + 0 " agree, " n["differs"] + 0 " differ, " n["given"] + n["fitted"] " given or fitted, " n["cannot be compared"] + 0 " cannot be compared, " \
      n["misprint of P2000"] + 0 " misprint of P2000" }' "$card")
  claim="the bottom line of ${scene#*:} in $card is that of its rows"
  if grep -q -F "# ${scene#*:}: $counts;" "$card"; then ok "$claim"; else wrong "$claim" "the rows say $counts"; fi
done
claim="README.md quotes the bottom line of the default scene"
counts=$(sed -n 's/^# parker2000: \([0-9]*\) agree, \([0-9]*\) differ.*/\1 agree and \2 differ/p' "$card")
if tr '\n' ' ' < README.md | grep -q -F "$counts"; then ok "$claim"; else wrong "$claim" "the scorecard says $counts"; fi
