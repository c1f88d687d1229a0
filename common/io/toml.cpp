#include "io/toml.h"

#include <algorithm>
#include <cctype>

#include "base/error.h"
#include "io/publish.h"
#include "io/section_reader.h"
#include "io/suggestion.h"

namespace whine {
namespace {

bool beyond_ascii(char c) {
  return (c & 0x80) != 0;
}

constexpr const char* kTooLong =
    "the file is larger than a megabyte, and no scene, study or file of stage parameters is";

struct Stray {
  unsigned line = 0;  // 0: there is none
  const char* what = "";
};

// toml++ follows the parts of a key by recursion, as deep as they go.
constexpr int kMostParts = 32;

// Whether a character may stand between the parts of a key, or within one.
bool in_key(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || std::string("_- \t\"'").find(c) != std::string::npos;
}

// The first character beyond ASCII where TOML allows none: outside of texts and comments, or where a text goes on
// after a backslash at the end of a line; or the first key of too many parts.
Stray stray(const std::string& bytes) {
  static const char* const letter = "a character beyond ASCII stands outside of texts and comments";
  std::string end;  // of the text in which we are; empty: in none
  bool comment = false;
  unsigned line = 1;
  int dots = 0;
  for (std::size_t i = bytes.rfind("\xef\xbb\xbf", 0) == 0 ? 3 : 0; i < bytes.size(); ++i) {
    const char c = bytes[i], next = i + 1 < bytes.size() ? bytes[i + 1] : '\0';
    if (c == '\n') {
      ++line;
      dots = 0;
      comment = false;
      if (end.size() == 1) end.clear();
    } else if (comment) {
      continue;
    } else if (end.empty()) {
      if (beyond_ascii(c)) return {line, letter};
      dots = c == '.' ? dots + 1 : in_key(c) ? dots : 0;
      if (dots >= kMostParts) return {line, "a key has more than 32 parts"};
      comment = c == '#';
      if (c != '"' && c != '\'') continue;
      end = bytes.compare(i, 3, std::string(3, c)) == 0 ? std::string(3, c) : std::string(1, c);
      i += end.size() - 1;
    } else if (c == '\\' && end == "\"\"\"" &&
               (next == ' ' || next == '\t' || next == '\r' || next == '\n')) {
      for (; i + 1 < bytes.size() && std::string(" \t\r\n").find(bytes[i + 1]) != std::string::npos; ++i)
        line += bytes[i + 1] == '\n';
      if (i + 1 < bytes.size() && beyond_ascii(bytes[i + 1])) return {line, letter};
    } else if (c == '\\' && end[0] == '"' && next != '\n') {
      ++i;
    } else if (bytes.compare(i, end.size(), end) == 0) {
      i += end.size() - 1;
      // Two more may belong to a text of several lines.
      for (int more = 0; more < 2 && end.size() == 3 && i + 1 < bytes.size() && bytes[i + 1] == end[0];
           ++more)
        ++i;
      end.clear();
    }
  }
  return {};
}

// The n-th line, from 1.
std::string nth_line(const std::string& bytes, unsigned n) {
  std::size_t begin = 0;
  for (unsigned line = 1; line < n && begin != std::string::npos; ++line) {
    begin = bytes.find('\n', begin);
    if (begin != std::string::npos) ++begin;
  }
  return begin == std::string::npos ? "" : bytes.substr(begin, bytes.find('\n', begin) - begin);
}

}  // namespace

toml::table parse_toml(const std::string& bytes, std::size_t most) {
  if (bytes.size() > most) throw toml::parse_error(kTooLong, toml::source_position{1, 1});
  if (const Stray found = stray(bytes); found.line)
    throw toml::parse_error(found.what, toml::source_position{found.line, 1});
  try {
    return toml::parse(std::string_view(bytes));
  } catch (const toml::parse_error& error) {
    const std::string advice = value_advice(nth_line(bytes, error.source().begin.line));
    if (advice.empty()) throw;
    throw toml::parse_error((std::string(error.description()) + advice).c_str(), error.source().begin);
  }
}

toml::table toml_of(const std::string& path, const std::string& bytes, std::size_t most) {
  try {
    return parse_toml(bytes, most);
  } catch (const toml::parse_error& error) {
    fail(Failure::input, path, ":", error.source().begin.line, ": is not valid TOML: ", error.description());
  }
}

toml::table read_toml(const std::string& path, const std::string& what, std::size_t most) {
  return toml_of(path, read_bytes(path, "check the path of " + what), most);
}

void reject_at(const std::string& path, const toml::node& at, const std::string& what) {
  fail(Failure::input, path, ":", at.source().begin.line, ": ", what);
}

std::vector<const toml::table*> rows_of(const toml::table& root, const std::string& path,
                                        const std::string& name, const std::vector<std::string>& known) {
  const toml::array* list = root.get_as<toml::array>(name);
  if (!list) fail(Failure::input, path, ":1: lacks [[", name, "]]");
  std::vector<const toml::table*> rows;
  for (const toml::node& node : *list) {
    const toml::table* row = node.as_table();
    if (!row) reject_at(path, node, text("[[", name, "]] must be tables"));
    for (const auto& [label, value] : *row)
      if (std::find(known.begin(), known.end(), label.str()) == known.end())
        reject_at(path, value, text("unknown key '", label.str(), "'; known are ", joined(known)));
    rows.push_back(row);
  }
  return rows;
}

std::vector<std::string> words_of(const toml::node& list) {
  std::vector<std::string> words;
  if (const toml::array* items = list.as_array())
    for (const toml::node& item : *items) words.push_back(item.value<std::string>().value_or(""));
  return words;
}

}  // namespace whine
