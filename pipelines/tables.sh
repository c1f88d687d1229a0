#!/usr/bin/env bash
# The generated tables of the pages, on standard output: tables.sh <name> <folder of the programs>.
#
#   keys      keys of a scene, from gear-scene --keys                 data/README.md
#   targets   targets of make by task, from the comments of makefiles pipelines/README.md
#   options   options and examples of the programs, from --help       tools/README.md
#   datasets  datasets of the artifacts, from gear-inspect --datasets  pipelines/README.md
#   scenes    files and titles of the scenes                          data/scenes/README.md
#   studies   files and titles of the studies                         data/studies/README.md
#
# `make docs-tables` puts them between <!-- name --> and <!-- end of name -->; tests/pages.sh compares.
set -euo pipefail
cd "$(dirname "$0")/.."

# file and title of each .toml of a folder
titles() {
  echo "| file | title |"
  echo "|---|---|"
  for file in "$1"/*.toml; do
    echo "| [\`$(basename "$file")\`]($(basename "$file")) | $(sed -n 's/^title = "\([^"]*\)".*/\1/p' "$file") |"
  done
}

case $1 in
  keys) "$2/gear-scene" --keys ;;
  datasets)
    echo '| artifact | datasets (axes; unit) |'
    echo '|---|---|'
    # "<artifact>  <dataset> (<axes>; <unit>): <meaning>"
    "$2/gear-inspect" --datasets | awk '
      function flush() { if (row != "") print "| `" artifact "` | " row " |"; row = "" }
      { if ($1 != artifact) flush()
        artifact = $1; said = substr($0, length($1) + length($2) + 4, index($0, "): ") - length($1) - length($2) - 3)
        row = row (row == "" ? "" : ", ") "`" $2 "` " said }
      END { flush() }'
    ;;
  targets)
    echo '| `make ...` | makes |'
    echo '|---|---|'
    awk -f pipelines/help.awk pipelines/help.txt Makefile pipelines/*.mk | awk '
      { gsub(/[|]/, "\\|"); gsub(/</, "\\<") }
      /^[^ ]/ { print "| **" $0 "** | |"; next }
      { name = $1; sub(/^ *[^ ]+ +/, ""); print "| `" name "` | " $0 " |" }'
    ;;
  options)
    echo '| program | option | takes | meaning |'
    echo '|---|---|---|---|'
    examples=
    for program in tools/gear-*.cpp; do
      name=$(basename "$program" .cpp)
      said=$("$2/$name" --help)
      examples+=$(sed '1,/^Examples\{0,1\}:$/d; /^ *$/d; s/^ */    /' <<< "$said")$'\n'
      awk -v program="$name" '
        function flush() {
          if (option == "") return
          split(option, words, " "); takes = substr(option, length(words[1]) + 2)
          gsub(/TEXT|INT|FLOAT|[.][.][.]/, "", takes); sub(/REQUIRED/, "required", takes)
          sub(/Needs:/, "with", takes); sub(/Excludes:/, "not with", takes)
          if (match(takes, /:[{][^}]*[}]/)) { choice = substr(takes, RSTART + 2, RLENGTH - 3); gsub(/,/, ", ", choice)
            takes = choice substr(takes, RSTART + RLENGTH) }
          sub(/=/, "; default ", takes); sub(/^ *;? */, "", takes); sub(/ *$/, "", takes); gsub(/  +/, " ", takes)
          if (words[1] !~ /^-h,|^--version$/) {
            gsub(/[|]/, "\\|", meaning); gsub(/</, "\\<", meaning)
            print "| `" program "` | `" words[1] "` | " takes " | " meaning " |"
          }
          option = ""
        }
        /^(Options|Positionals):$/ { listed = 1; next }
        /^$/ { flush(); listed = 0; next }
        listed && /^  [^ ]/ {
          flush()
          # CLI11 begins the meaning in column 31, on the next line where the option is longer
          if (length($0) <= 30 || substr($0, 30, 1) != " ") { option = substr($0, 3); meaning = "" }
          else { option = substr($0, 3, 27); sub(/ +$/, "", option); meaning = substr($0, 31) }
          next
        }
        listed { sub(/^ +/, ""); meaning = meaning (meaning == "" ? "" : " ") $0 }
        END { flush() }' <<< "$said"
    done
    printf '\n%s\n\n%s' 'Examples; the tests run each of them:' "$examples"
    ;;
  scenes | studies) titles "data/$1" ;;
  *) echo "tables.sh: there is no table '$1'" >&2; exit 2 ;;
esac
