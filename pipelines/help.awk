# The targets by task: first help.txt (a heading, below it targets, or a figure as "fig12: what it shows"), then makefiles, where they stand
# as "target: ... ## what it makes". A target that no heading has stands under the last one, "Other".
FILENAME ~ /help\.txt$/ { if (/^[^ ]/) heading[++headings] = $0; else if ($1 ~ /:$/) { name = substr($1, 1, length($1) - 1)
  says[name] = substr($0, index($0, ": ") + 2); under[headings] = under[headings] " " name } else for (i = 1; i <= NF; i++) under[headings] = under[headings] " " $i; next }
/^[a-z0-9-]+:.*## / { name = $0; sub(/:.*/, "", name); says[name] = $0; sub(/.*## /, "", says[name]); order[++targets] = name }
function say(name) { if (name in says && !(name in said)) printf "  %-15s %s\n", name, says[name]; said[name] = 1 }
END {
  for (h = 1; h <= headings; h++) { print heading[h]; n = split(under[h], names, " "); for (i = 1; i <= n; i++) say(names[i]) }
  for (t = 1; t <= targets; t++) if (!(order[t] in said)) { if (!others++) print "Other"; say(order[t]) }
}
