// What all programs share: numbers of options, exit statuses.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <new>

#include "base/error.h"
#include "base/tool.h"
#include "refusal.h"

using namespace whine;

TEST_CASE("the number of an option is decimal, finite and the whole word") {
  CHECK(number_option("--torque", "150") == 150);
  CHECK(number_option("--torque", "62.5") == 62.5);
  CHECK(number_option("--torque", "-1e3") == -1000);
  for (const char* word : {"", " 1", "1 ", "0x10", "inf", "-inf", "nan", "1e999", "ten", "1,5", "+1"}) {
    CHECK(refused([&] { number_option("--torque", word); }, Failure::usage,
                  {"--torque", text("'", word, "'")}));
  }
}

TEST_CASE("a tool's exit status says the kind of failure") {
  char name[] = "/usr/bin/gear-x";
  char* argv[] = {name, nullptr};
  const int silent = dup(STDERR_FILENO), null = open("/dev/null", O_WRONLY);
  dup2(null, STDERR_FILENO);
  const int good = run_tool(1, argv, [](int, char**) {});
  const int own = run_tool(1, argv, [](int, char**) { return 3; });
  const int io = run_tool(1, argv, [](int, char**) { fail(Failure::io, "no room"); });
  const int memory = run_tool(1, argv, [](int, char**) -> int { throw std::bad_alloc(); });
  dup2(silent, STDERR_FILENO);
  close(silent);
  close(null);
  CHECK(good == 0);
  CHECK(own == 3);
  CHECK(io == 4);
  CHECK(memory == 1);
}
