// What a call is refused with: its kind, and its message by fields. What, value, limit, place and remedy stand in the message as words of their own, whatever
// the sentence around them; tests/features/sentences.tsv lists sentences.
#pragma once
#include <doctest/doctest.h>

#include <cctype>
#include <ostream>
#include <string>
#include <vector>

#include "base/error.h"

namespace whine {

struct Refusal {
  Failure kind = static_cast<Failure>(0);  // a kind that no error has: none
  std::string message;
};

inline Refusal refusal_of(const auto& call) {
  try {
    call();
  } catch (const Error& error) {
    return {error.kind(), error.what()};
  }
  return {};
}

inline Failure failure_of(const auto& call) {
  return refusal_of(call).kind;
}

inline std::string message_of(const auto& call) {
  return refusal_of(call).message;
}

// Of what may be refused as input alone.
inline std::string message_of_input(const auto& call) {
  const Refusal refusal = refusal_of(call);
  if (!refusal.message.empty()) CHECK(refusal.kind == Failure::input);
  return refusal.message;
}

// A bool that says why when a check of it fails.
struct Reasoned {
  bool holds;
  std::string why;
  operator bool() const { return holds; }
  friend std::ostream& operator<<(std::ostream& out, const Reasoned& v) { return out << v.why; }
};

inline Reasoned contains(const std::string& text, const std::string& part) {
  return {text.find(part) != std::string::npos, "'" + part + "' is not in '" + text + "'"};
}

struct Field {
  std::string words;
  Field(const char* what) : words(what) {}
  Field(std::string what) : words(std::move(what)) {}
  Field(double value) : words(text(value)) {}
  Field(int value) : words(text(value)) {}
};

// Whether a message is one line that has each field as words of its own: 13 is not in "0.13 mm" nor in "130"; 13* may go on.
inline Reasoned names(const std::string& message, const std::vector<Field>& fields) {
  const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  const std::string line = " " + message + "  ";
  Reasoned all{!fields.empty() && line.find('\n') == std::string::npos, "in '" + message + "'"};
  for (auto [words] : fields) {
    REQUIRE(!words.empty());
    const bool open = words.back() == '*';
    if (open) words.pop_back();
    bool found = false;
    for (size_t at = line.find(words, 1); at != std::string::npos && !found; at = line.find(words, at + 1)) {
      const char before = line[at - 1], after = line[at + words.size()], then = line[at + words.size() + 1];
      const bool begins = !(in_word(words.front()) && (in_word(before) || before == '.')),
                 ends = !in_word(words.back()) || !(in_word(after) || (after == '.' && std::isdigit(then)));
      found = begins && (open || ends);
    }
    if (!found) all = {false, "'" + words + "' is not " + all.why};
  }
  return all;
}

// Whether a call is refused with this kind and these fields.
inline Reasoned refused(const auto& call, Failure kind, const std::vector<Field>& fields) {
  const Refusal refusal = refusal_of(call);
  if (refusal.kind != kind)
    return {false, text("another kind, ", static_cast<int>(refusal.kind), ": ", refusal.message)};
  return names(refusal.message, fields);
}

}  // namespace whine
