# What is compiled together, and what a program is linked from, read off the #include lines.
#
#   awk -v units='io/codecs=io/.*_codec ...' -f pipelines/sources.awk common/*/*.h common/*/*.cpp common/*/*/*.h common/*/*/*.cpp tools/*.cpp
#
# prints `unit=layer/source` for each source of common/ and `program:unit` for each unit that a program is linked from. A source is
# of the first unit whose expression fits it, else of <layer>/rest. A program needs the sources that implement the headers which it
# sees, the headers that those see, and so on; with a source, all of its unit. A source implements the header that it includes
# first; several may implement one. Files outside common/ are programs.
function unit_of(source, i) {
  for (i = 1; i <= expressions; ++i)
    if (source ~ "^(" expression[i] ")$") return unit[i]
  sub(/\/.*/, "/rest", source)
  return source
}
BEGIN {
  expressions = split(units, given, " ")
  for (i = 1; i <= expressions; ++i) {
    split(given[i], part, "=")
    unit[i] = part[1]
    expression[i] = part[2]
  }
}
FNR == 1 {
  file = FILENAME
  if (!sub(/^common\//, "", file)) { sub(/.*\//, "", file); programs[++count] = file }
  else if (sub(/\.cpp$/, "", file)) {
    name = unit_of(file)
    print name "=" file
    file = "unit " name
  }
  first = 1
}
/^#include "/ {
  split($0, part, "\"")
  header = part[2]
  sees[file] = sees[file] "\t" header
  if (first && file ~ /^unit /) sees[header] = sees[header] "\t" file
  first = 0
}
/^#include </ { first = 0 }
END {
  for (p = 1; p <= count; ++p) {
    split("", seen)
    ready = 1; reached = 2
    list[1] = programs[p]
    list[2] = "base/precompiled.h"  # before any other
    while (ready <= reached) {
      n = split(sees[list[ready++]], next_ones, "\t")
      for (i = 1; i <= n; ++i)
        if (!(next_ones[i] in seen)) { seen[next_ones[i]] = 1; list[++reached] = next_ones[i] }
    }
    name = programs[p]
    sub(/\.cpp$/, "", name)
    for (i = 2; i <= reached; ++i)
      if (sub(/^unit /, "", list[i])) print name ":" list[i]
  }
}
