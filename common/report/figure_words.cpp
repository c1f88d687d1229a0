#include "report/figure_words.h"

#include <algorithm>

#include "base/error.h"
#include "report/text_width.h"

namespace whine {

std::string quoted_labels(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += "'" + name + "' ";
  return out;
}

std::string short_name(const std::string& name) {
  constexpr double kMost = 11.2, kHead = 6;  // 194 and 104 pixels of letters of a legend
  const auto width = [](const std::string& part) { return text_width(without_markup(part)); };
  if (width(name) <= kMost) return name;
  size_t head = name.size(), tail = name.size();
  while (head > 0 && width(name.substr(0, head)) > kHead) --head;
  while (tail > 0 && width(name.substr(tail - 1)) <= kMost - 1 - kHead) --tail;
  while (tail < name.size() && (static_cast<unsigned char>(name[tail]) & 0xc0) == 0x80) ++tail;  // UTF-8
  return name.substr(0, head) + "…" + name.substr(tail);
}

std::vector<std::string> in_lines(const std::string& words) {
  return broken_lines(words, kNoteWidth);
}

void add_lines(size_t plain, Figure& figure) {
  for (size_t i = 0; i < figure.notes.size(); ++i)
    figure.words.emplace_back(text("line", i + 1),
                              i < plain ? without_markup(figure.notes[i]) : figure.notes[i]);
}

}  // namespace whine
