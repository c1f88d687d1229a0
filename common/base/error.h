// Errors that end a stage with one clear line: what, the value, the limit, where, what to do next.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <ostream>
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

// An argument of text(): its address and the function that prints it. A type is printed the same way in every list.
class TextPart {
 public:
  template <class T>
  explicit TextPart(const T& value) : value_(&value), print_(&print<T>) {}
  explicit TextPart(const char* const& value) : value_(value), print_(&print_words) {}
  template <size_t n>
  explicit TextPart(const char (&value)[n]) : value_(value), print_(&print_words) {}
  friend std::ostream& operator<<(std::ostream& out, const TextPart& part) {
    part.print_(out, part.value_);
    return out;
  }

 private:
  template <class T>
  static void print(std::ostream& out, const void* value) {
    out << *static_cast<const T*>(value);
  }
  static void print_words(std::ostream& out, const void* value) { out << static_cast<const char*>(value); }

  const void* value_;
  void (*print_)(std::ostream&, const void*);
};

std::string text_of(std::initializer_list<TextPart> parts);

// Joins its arguments with operator<<, numbers with 10 significant digits.
template <class... Parts>
std::string text(const Parts&... parts) {
  return text_of({TextPart(parts)...});
}

// Throws Error(kind, text(parts...)).
template <class... Parts>
[[noreturn]] void fail(Failure kind, const Parts&... parts) {
  throw Error(kind, text(parts...));
}

}  // namespace whine
