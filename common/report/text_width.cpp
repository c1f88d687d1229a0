#include "report/text_width.h"

#include <array>

namespace whine {
namespace {

// Advances of ' ' to '~' in DejaVu Sans 2.37, in 2048ths of the size.
constexpr std::array<int, 95> kAdvance{
    651,  821,  942,  1716, 1303, 1946, 1597, 563,  799,  799,  1024, 1716, 651,  739,  651,  690,
    1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 1303, 690,  690,  1716, 1716, 1716, 1087,
    2048, 1401, 1405, 1430, 1577, 1294, 1178, 1587, 1540, 604,  604,  1343, 1141, 1767, 1532, 1612,
    1235, 1612, 1423, 1300, 1251, 1499, 1401, 2025, 1403, 1251, 1403, 799,  690,  799,  1716, 1024,
    1024, 1255, 1300, 1126, 1300, 1260, 721,  1300, 1298, 569,  569,  1186, 569,  1995, 1298, 1253,
    1300, 1300, 842,  1067, 803,  1298, 1212, 1675, 1212, 1212, 1075, 1303, 690,  1303, 1716};
constexpr double kUnits = 2048, kOther = 0.7;

// Of a byte: beyond ASCII the first one of a character has its width, the others none.
double advance(char byte) {
  const auto c = static_cast<unsigned char>(byte);
  if (c >= 0xc0) return kOther;
  return c >= ' ' && c < 0x7f ? kAdvance[c - ' '] / kUnits : 0;
}

// Behind the '{' at `at` what selects a font: "/:Bold " or "/*0.68 "; the place behind it.
size_t after_font(const std::string& words, size_t at) {
  if (at + 1 >= words.size() || words[at + 1] != '/') return at + 1;
  const size_t blank = words.find(' ', at);
  return blank == std::string::npos ? words.size() : blank + 1;
}

}  // namespace

double text_width(const std::string& words) {
  double width = 0;
  for (size_t i = 0; i < words.size(); ++i) {
    const auto c = static_cast<unsigned char>(words[i]);
    if (c == '{') {
      i = after_font(words, i) - 1;
    } else if (c == '\\' && i + 1 < words.size()) {
      width += advance(words[++i]);
    } else if (c == '}' || c == '_' || c == '^') {
      continue;
    } else {
      width += advance(words[i]);
    }
  }
  return width;
}

std::vector<std::string> broken_lines(const std::string& words, double width,
                                      double (*measure)(const std::string&)) {
  std::vector<std::string> out{""};
  for (size_t from = 0; from <= words.size();) {
    size_t end = from;
    for (int depth = 0; end < words.size() && (words[end] != ' ' || depth > 0); ++end) {
      if (words[end] == '\\') {
        ++end;
        continue;
      }
      depth += words[end] == '{' ? 1 : words[end] == '}' ? -1 : 0;
    }
    const std::string word = words.substr(from, end - from),
                      longer = out.back().empty() ? word : out.back() + " " + word;
    if (!out.back().empty() && measure(longer) > width)
      out.push_back(word);
    else
      out.back() = longer;
    from = end + 1;
  }
  return out;
}

}  // namespace whine
