# Sizes: no file of common/ above 600 lines, no program above 150. Functions: readability-function-size in .clang-tidy.
#
# tests/size.exceptions lists what may be longer, a line for each: path, colon, reason. A line that nothing needs any more is
# reported, too.
set -uo pipefail
shopt -s globstar

most() { case $1 in tools/*) echo 150 ;; *) echo 600 ;; esac; }
exceptions=tests/size.exceptions
long=$(wc -l common/**/*.h common/**/*.cpp tools/*.cpp | while read -r lines file; do
  [ "$file" = total ] || [ "$lines" -le "$(most "$file")" ] || echo "$file $lines"
done)
excepted() { grep -q "^$1: ..*" "$exceptions"; }

found=$(while read -r file lines; do
  [ -z "$file" ] || excepted "$file" || echo "$file has $lines lines, $(most "$file") is the most"
done <<< "$long")
if [ -z "$found" ]; then echo "ok: no file of common/ has more than 600 lines, no program more than 150"; else
  echo "FAILED: split by what they know, or give a reason in $exceptions: ${found//$'\n'/; }"; fi

found=$(grep -v -e '^#' -e '^$' "$exceptions" | while IFS= read -r line; do
  file=${line%%:*}
  [[ $line == *": "?* ]] || { echo "'$line' gives no reason"; continue; }
  grep -q "^$file " <<< "$long" || echo "$file is not too long"
done)
if [ -z "$found" ]; then echo "ok: each line of $exceptions is needed and gives a reason"; else
  echo "FAILED: $exceptions: ${found//$'\n'/; }"; fi

# What clang-tidy leaves out says why: the rest of the line.
found=$(grep -n 'NOLINT[A-Z]*(readability-function-size)' common/**/*.* tools/* | grep -v -E 'readability-function-size\): ..*')
if [ -z "$found" ]; then echo "ok: each function that may be longer says why"; else echo "FAILED: no reason: ${found//$'\n'/; }"; fi

# Sources are put together for clang-tidy, whose analyzer has to look into each.
if ! command -v clang-tidy > /dev/null; then echo "skipped: clang-tidy reads sources together (it is not installed)"; else
  scratch=$(mktemp -d)
  trap 'rm -rf "$scratch"' EXIT
  folder=$scratch/$(sed -n 's|^lint_folder := $(B)/||p' tests/checks.mk)
  mkdir -p "$folder" "$scratch/common/x"
  echo 'int unset(bool a) { int x; if (a) x = 1; return x; }' > "$scratch/common/x/a.cpp"
  echo "#include \"$scratch/common/x/a.cpp\"" > "$folder/unit.cxx"
  found=$(clang-tidy --quiet --config-file=.clang-tidy --checks=-bugprone-suspicious-include "$folder/unit.cxx" -- -std=c++20 2> /dev/null)
  if [[ $found = "$scratch/common/x/a.cpp:1:"*UndefReturn* ]]; then echo "ok: clang-tidy looks into sources that are read together"; else
    echo "FAILED: clang-tidy looks into sources that are read together: '$found'"; fi
fi
