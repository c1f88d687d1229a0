// Options of programs: what a list takes of the words behind it.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "base/options.h"

using namespace whine;

namespace {

struct Given {
  std::vector<std::string> inputs, bodies;
  std::vector<double> speeds;
};

Given parsed(std::vector<std::string> words) {
  Given given;
  Options options{"A program", "gear-x"};
  options.add("inputs", given.inputs, "artifacts");
  options.add("--body", given.bodies, "once for each");
  options.add("--speeds", given.speeds, "with commas").separated_by(',');
  words.insert(words.begin(), "gear-x");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  options.parse(static_cast<int>(pointers.size()), pointers.data());
  return given;
}

}  // namespace

TEST_CASE("a list option takes one word each time, and leaves the inputs behind it alone") {
  const Given given = parsed({"--body", "a=1", "x.h5", "--speeds", "1,2", "y.h5", "--body", "b=2", "z.h5"});
  CHECK(given.bodies == std::vector<std::string>{"a=1", "b=2"});
  CHECK(given.speeds == std::vector<double>{1, 2});
  CHECK(given.inputs == std::vector<std::string>{"x.h5", "y.h5", "z.h5"});
  CHECK_THROWS_AS(parsed({"--speeds", "1", "--speeds"}), Error);
}
