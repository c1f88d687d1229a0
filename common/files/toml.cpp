#include "files/toml.h"

namespace whine {
namespace {

bool beyond_ascii(char c) {
  return (c & 0x80) != 0;
}

// The line of the first character beyond ASCII where TOML allows none: outside of texts and comments, or where a text goes on
// after a backslash at the end of a line. 0: there is none.
unsigned stray_line(const std::string& bytes) {
  std::string end;  // of the text in which we are; empty: in none
  bool comment = false;
  unsigned line = 1;
  for (std::size_t i = bytes.rfind("\xef\xbb\xbf", 0) == 0 ? 3 : 0; i < bytes.size(); ++i) {
    const char c = bytes[i], next = i + 1 < bytes.size() ? bytes[i + 1] : '\0';
    if (c == '\n') {
      ++line;
      comment = false;
      if (end.size() == 1) end.clear();
    } else if (comment) {
      continue;
    } else if (end.empty()) {
      if (beyond_ascii(c)) return line;
      comment = c == '#';
      if (c != '"' && c != '\'') continue;
      end = bytes.compare(i, 3, std::string(3, c)) == 0 ? std::string(3, c) : std::string(1, c);
      i += end.size() - 1;
    } else if (c == '\\' && end == "\"\"\"" &&
               (next == ' ' || next == '\t' || next == '\r' || next == '\n')) {
      for (; i + 1 < bytes.size() && std::string(" \t\r\n").find(bytes[i + 1]) != std::string::npos; ++i)
        line += bytes[i + 1] == '\n';
      if (i + 1 < bytes.size() && beyond_ascii(bytes[i + 1])) return line;
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
  return 0;
}

}  // namespace

toml::table parse_toml(const std::string& bytes) {
  if (const unsigned line = stray_line(bytes))
    throw toml::parse_error("a character beyond ASCII stands outside of texts and comments",
                            toml::source_position{line, 1});
  return toml::parse(std::string_view(bytes));
}

}  // namespace whine
