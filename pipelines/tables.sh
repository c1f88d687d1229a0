#!/usr/bin/env bash
# Generated tables, on standard output: tables.sh <name> <folder of the programs>.
#   keys       keys of a scene, from gear-scene --keys                      data/keys.tsv, a file of its own
#   features   what goals and stages do not take, from gear-scene --features common/studies/README.md
#   scenes     files and titles of the scenes                               data/scenes/README.md
#   studies    files and titles of the studies                              data/studies/README.md
#   scorecard  verdicts on the claims of P2000, from scorecard.tsv          data/published/README.md
#   sets       sets of claims and their readings, from claim_sets.tsv       data/published/README.md
#   renew      puts those of pages between <!-- name --> and <!-- end of name -->, keys into their file; tests/pages.sh compares
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
  keys) "$2/gear-scene" --keys | sed '2d; s/^| //; s/ |$//; s/ | /\t/g; s/`//g; s/\\|/|/g; 1s/^/# /' ;;
  scorecard)
    echo '| scene | agree | differ | given or fitted | cannot be compared | misprint of P2000 |'
    echo '|---|---|---|---|---|---|'
    sed -n 's/^# \([^ ]*\): \([0-9]*\) agree, \([0-9]*\) differ, \([0-9]*\) given or fitted, \([0-9]*\) cannot be compared, \([0-9]*\) misprint.*/| `\1` | \2 | \3 | \4 | \5 | \6 |/p' data/published/scorecard.tsv
    ;;
  sets)
    echo '| set of claims | readings with all | closest reading lacks |'
    echo '|---|---|---|'
    awk -F '\t' '!/^#/ { print "| " $1 ": " $2 " | " $3 " | " $4 " |" }' data/published/claim_sets.tsv
    ;;
  features) "$2/gear-scene" --features ;;
  scenes | studies) titles "data/$1" ;;
  renew)
    pipelines/tables.sh keys "$2" > data/keys.tsv.new && mv data/keys.tsv.new data/keys.tsv
    for block in common/studies:features data/scenes:scenes data/studies:studies data/published:scorecard data/published:sets; do
      page=${block%:*}/README.md name=${block#*:}
      pipelines/tables.sh "$name" "$2" | awk -v name="$name" 'NR == FNR { table = table $0 "\n"; next } $0 == "<!-- " name " -->" { printf "%s\n%s", $0, table; skip = 1 }
        $0 == "<!-- end of " name " -->" { skip = 0 } !skip' - "$page" > "$page.new" && mv "$page.new" "$page"
    done ;;
  *) echo "tables.sh: there is no table '$1'" >&2; exit 2 ;;
esac
