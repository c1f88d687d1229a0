// What a user gives to make, judged before the makefiles read it: a shell and make obey characters of names, goals need values, and
// scenes need names and files of their own. Messages say variable, value, limit and remedy.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "base/error.h"

namespace whine {

struct MakeRequest {
  std::vector<std::string> goals;
  std::map<std::string, std::string> variables;  // of the command line; known ones of the environment, too

  bool asks(const std::string& goal) const;
  const std::string& value(const std::string& variable) const;  // "" if it is not given
  std::vector<std::string> words(const std::string& variable) const;
};

// goals: with a blank between; variables: each as NAME=value.
MakeRequest make_request(const std::string& goals, const std::vector<std::string>& variables);

// Error(input) for characters that are not allowed, targets and variables that do not exist, values out of range, files that are
// missing or take the place of others. Reads makefiles, scenes and studies below the working folder.
void check_request(const MakeRequest& request);

// What check_request() says of them, one printable line; "" if all is right.
std::string wrong_with(const std::string& goals, const std::vector<std::string>& variables);

// Its files alone: scenes, studies, models, transfer functions.
void check_files(const MakeRequest& request);

// Helpers of both.
template <class... Parts>
[[noreturn]] void refuse(const std::string& variable, const std::string& value, const Parts&... parts) {
  fail(Failure::input, variable, "=", value, ": ", parts...);
}
std::string joined_by(const char* between, const std::vector<std::string>& words);
bool present(const std::string& path);  // something of this name is there
bool listed_in(const std::vector<std::string>& list, const std::string& word);

}  // namespace whine
