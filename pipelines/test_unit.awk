# Tests that are compiled together: what they include, once, then each in a namespace of its own, so that their helpers may share names.
#
#   awk -f pipelines/test_unit.awk tests/test_a.cpp tests/test_b.cpp
/^#include/ && !seen[$0]++ { print }
END {
  for (i = 1; i < ARGC; ++i) {
    name = ARGV[i]
    gsub(/.*\/|\.cpp$/, "", name)
    printf "namespace %s {\n#include \"%s\"\n}\n", name, ARGV[i]
  }
}
