# Sources that clang-tidy reads as one file: to read and to match the same headers for each took two thirds of its time.
#
#   awk -f pipelines/lint_unit.awk common/gear/crack.cpp common/gear/involute.cpp > unit.cpp
#   awk -v unit=unit.cpp -f pipelines/lint_unit.awk unit.cpp said
#
# The first puts them one behind the other, what they include once at the top, programs each in a namespace of its own. They are not
# included but copied: the analyzer begins paths in the main file only. The second prints what clang-tidy said of unit.cpp with the
# names and lines of the sources.
function name_of(file) {
  gsub(/.*\/|\.cpp$/, "", file)
  gsub(/-/, "_", file)
  return file
}
BEGIN { if (unit) length_of_name = length(unit) }
unit && FILENAME == unit {
  if (/^#line /) { split($0, part, "\""); file = part[2]; line = 1 }
  else place[FNR] = file ":" line++
  next
}
unit {
  # what is said begins with a path, as given or from the root
  if (match($0, "^[^ :]*" unit ":[0-9]+:")) {
    rest = substr($0, RLENGTH)
    said = substr($0, 1, RLENGTH - 1)
    sub(/.*:/, "", said)
    $0 = place[said] rest
  }
  print
  next
}
/^#include/ && !seen[$0]++ { print }
{ text[FILENAME] = text[FILENAME] (/^#include/ ? "" : $0) "\n" }
END {
  for (i = 1; !unit && i < ARGC; ++i) {
    program = ARGV[i] ~ /^tools\//
    if (program) print "namespace " name_of(ARGV[i]) " {"
    printf "#line 1 \"%s\"\n%s", ARGV[i], text[ARGV[i]]
    if (program) print "}"
  }
}
