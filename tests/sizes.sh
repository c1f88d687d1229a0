# Sizes: no file of common/ above 600 lines, no program above 150. Functions: readability-function-size in .clang-tidy.
#
# tests/size.exceptions lists what may be longer, a line for each: path, colon, reason. A line that nothing needs any more is
# reported, too.
set -uo pipefail

most() { case $1 in tools/*) echo 150 ;; *) echo 600 ;; esac; }
exceptions=tests/size.exceptions
long=$(wc -l common/*/*.h common/*/*.cpp common/*/*/*.h common/*/*/*.cpp tools/*.cpp | while read -r lines file; do
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
found=$(grep -n 'NOLINT[A-Z]*(readability-function-size)' common/*/*.* common/*/*/*.* tools/*.cpp | grep -v -E 'readability-function-size\): ..*')
if [ -z "$found" ]; then echo "ok: each function that may be longer says why"; else echo "FAILED: no reason: ${found//$'\n'/; }"; fi
