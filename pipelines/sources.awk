# What a program is linked from, read off the #include lines: the sources that implement the headers which it sees, the headers
# that those see, and so on. A source implements the header that it includes first; several may implement one.
#
#   awk -f pipelines/sources.awk common/*/*.h common/*/*.cpp tools/*.cpp      one line `program:layer/source` for each
#
# Files outside common/ are programs.
FNR == 1 {
  file = FILENAME
  if (!sub(/^common\//, "", file)) { sub(/.*\//, "", file); programs[++count] = file }
  first = 1
}
/^#include "/ {
  split($0, part, "\"")
  header = part[2]
  sees[file] = sees[file] " " header
  if (first && file ~ /\/.*\.cpp$/) sees[header] = sees[header] " " file
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
      n = split(sees[list[ready++]], next_ones, " ")
      for (i = 1; i <= n; ++i)
        if (!(next_ones[i] in seen)) { seen[next_ones[i]] = 1; list[++reached] = next_ones[i] }
    }
    name = programs[p]
    sub(/\.cpp$/, "", name)
    for (i = 2; i <= reached; ++i)
      if (list[i] ~ /\.cpp$/) { source = list[i]; sub(/\.cpp$/, "", source); print name ":" source }
  }
}
