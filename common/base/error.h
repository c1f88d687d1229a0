// Errors that end a stage with one clear line: what, the value, the limit, where, what to do next.
#pragma once
#include <sstream>
#include <stdexcept>
#include <string>

namespace whine {

// Exit statuses of the programs; scripts rely on the numbers.
enum class Failure {
  numerical = 1,  // a solver did not converge, or its certificate does not hold
  usage = 2,      // options or arguments are wrong
  input = 3,      // a scene or an artifact is wrong, stale, or asks for what cannot exist
  io = 4          // the file system refused: full disk, no permission, truncated file
};

class Error : public std::runtime_error {
 public:
  Error(Failure kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  Failure kind() const { return kind_; }

 private:
  Failure kind_;
};

// Joins its arguments with operator<<, numbers with 10 significant digits.
template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.precision(10);
  (out << ... << parts);
  return out.str();
}

// Throws Error(kind, text(parts...)).
template <class... Parts>
[[noreturn]] void fail(Failure kind, const Parts&... parts) {
  throw Error(kind, text(parts...));
}

}  // namespace whine
