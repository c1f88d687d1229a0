# The layers of common/: a layer includes only layers below it, heavy libraries stay behind their walls. The report sees no layer that
# solves: it reads results, and evaluates closed forms of gear/ (geometry, ISO 6336, Hertz) and signal/ alone.
set -uo pipefail
shopt -s globstar
B=${B:-build}

declare -A below=(
  [base]="base"
  [model]="base model"
  [gear]="base model gear"
  [contact]="base model gear contact"
  [results]="base model results"
  [solid]="base model gear contact solid results"
  [signal]="base model results signal"
  [orbits]="base orbits"
  [system]="base model gear contact solid results signal system"
  [dynamics]="base model gear contact solid results signal orbits system dynamics"
  [studies]="base model gear contact solid results signal orbits system dynamics studies"
  [lumped]="base model gear contact solid results signal orbits lumped"
  [io]="base model gear contact solid results signal orbits system dynamics studies lumped io"
  [report]="base model gear results signal io report"
  [paper]="base model gear contact solid results signal orbits system dynamics studies lumped io report paper"
)
# One process for all files: a shell that starts one for each takes half a minute.
faults=$(for layer in "${!below[@]}"; do echo "$layer ${below[$layer]}"; done | awk '
  NR == FNR { for (i = 2; i <= NF; ++i) below[$1, $i] = 1; place[$1] = 1; next }
  FNR == 1 { split(FILENAME, part, "/"); layer = part[2]; if (!(layer in place)) print FILENAME ": layer \x27" layer "\x27 has no place in the order" }
  !/^#include "/ || !(layer in place) { next }
  { split($0, quoted, "\""); slash = index(quoted[2], "/"); other = substr(quoted[2], 1, slash - 1)
    if (!slash) print FILENAME " includes \"" quoted[2] "\" without its layer"
    else if (!((layer, other) in below)) print FILENAME " includes " other "/, which is not below " layer "/" }' - common/**/*.h common/**/*.cpp)
if [ -z "$faults" ]; then echo "ok: layers include only layers below them"; else echo "FAILED: $faults"; fi

# confined <header> <pattern of files that may include it>
confined() {
  local found
  found=$(grep -l "#include <$1" common/**/*.* tools/* tests/**/test_*.cpp | grep -v -E "^($2)$" | tr '\n' ' ')
  if [ -z "$found" ]; then echo "ok: only $2 includes $1"; else echo "FAILED: $1 is included by $found"; fi
}
confined hdf5 'common/io/.*\.cpp|common/io/h5(_handle)?\.h'
confined gmsh 'common/solid/gmsh_mesh\.cpp'
confined cholmod 'common/solid/.*\.cpp'
confined fftw3 'common/signal/.*\.cpp'
confined toml 'common/io/.*\.cpp|common/io/toml\.h'
confined pugixml 'common/io/rexs/(rexs|results)\.cpp'
confined jsoncpp 'common/io/rexs/(rexs|results|json)\.cpp|tests/(.*/)?rexs_models\.h'
confined zip 'common/io/rexs/archive\.cpp|tests/(.*/)?(rexs_models\.h|test_rexs\.cpp)'
confined sndfile 'common/io/wav\.cpp|tests/(.*/)?test_sound\.cpp'
confined CLI/ 'common/base/options\.cpp'

found=$(grep -n -E '__DATE__|__TIME__|__TIMESTAMP__|std::format' common/**/*.* tools/* | head -3)
if [ -z "$found" ]; then echo "ok: no date is compiled in"; else echo "FAILED: a date or std::format: $found"; fi
# gmsh's library has an Eigen of its own, compiled for another processor: a template that a program exports would take its place.
programs=$(find "$B/bin" -name 'gear-*' -o -name 'whine-*' 2> /dev/null)
exported=$(for program in $programs; do
  symbols=$(nm -D --defined-only "$program" 2>&1) || echo "$program ($symbols)"
  case $symbols in *Eigen*) echo "$program" ;; esac
done)
drawn=$(for name in gear-plot gear-report gear-compare; do
  [ ! -e "$B/bin/$name" ] || { readelf -d "$B/bin/$name" | grep -E 'NEEDED.*(gmsh|cholmod)'; nm -C "$B/bin/$name" | grep -m 1 -o -E 'whine::(equilibrium|ComplementaritySolver|SystemStatics|reduce)\b'; } | sed "s/^/$name /"
done)
if [ -z "$programs" ]; then
  echo "skipped: what programs that draw link ($B/bin has none)"
elif [ -z "$drawn" ]; then
  echo "ok: programs that draw link no solver, gmsh or CHOLMOD"
else
  echo "FAILED: $drawn"
fi
if [ -z "$programs" ]; then
  echo "skipped: what programs export ($B/bin has none)"
elif [ -z "$exported" ]; then
  echo "ok: programs export nothing of Eigen"
else
  echo "FAILED: Eigen's symbols are exported by $exported"
fi
if [ -x "$B/bin/whine-tests" ]; then
  mapfile -t cases < <("$B/bin/whine-tests" --no-colors=true --no-skip --list-test-cases)
  found=$(grep -h -v '^#' tests/slow tests/unsanitized | while read -r pattern; do
    [ ! -e "tests/$pattern" ] || continue
    matched=0
    # shellcheck disable=SC2053 # as a pattern
    for name in "${cases[@]}"; do [[ $name != $pattern ]] || matched=$((matched + 1)); done
    [ $matched = 1 ] || echo "$pattern"; done)
  if [ -z "$found" ]; then echo "ok: each line of tests/slow and tests/unsanitized is a file or a case"; else echo "FAILED: tests/slow, tests/unsanitized: not one case: $found"; fi
fi
# An equation of P2000 is found by its number, `grep -rnw "Eq. 18" common`.
found=$(grep -n -E 'Eqs?\. *$' common/**/*.h common/**/*.cpp tools/*.cpp | head -3)
if [ -z "$found" ]; then echo "ok: no equation is parted from its number by the end of a line"; else echo "FAILED: put the number beside 'Eq.': $found"; fi
named=$(grep -h -o -w -E 'Eq\. [0-9]+' common/**/*.h common/**/*.cpp | sort -u)
found=$(for number in {1..23}; do [[ $'\n'$named$'\n' == *$'\n'"Eq. $number"$'\n'* ]] || echo "Eq. $number"; done)
if [ -z "$found" ]; then echo "ok: each of the 23 equations of P2000 is named in a source"; else echo "FAILED: no source names ${found//$'\n'/, }"; fi
found=$(grep -n -w Approx tests/**/*.h tests/**/*.cpp | grep -v '^tests/relative\.h:' | head -3)
if [ -z "$found" ]; then echo "ok: tests compare numbers by relative() only"; else echo "FAILED: Approx adds 1 to the scale, use relative(): $found"; fi
if ! command -v clang-format > /dev/null; then
  echo "skipped: layout of the sources (clang-format is not installed)"
elif found=$(make -s check-format 2>&1); then
  echo "ok: sources are laid out by clang-format"
else
  echo "FAILED: make format would change $(grep -o '^[^:]*\.\(cpp\|h\)' <<< "$found" | sort -u | tr '\n' ' ')"
fi
