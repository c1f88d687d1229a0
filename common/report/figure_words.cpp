#include "report/figure_words.h"

#include <algorithm>

#include "base/error.h"

namespace whine {

std::string quoted_labels(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += "'" + name + "' ";
  return out;
}

std::string short_name(const std::string& name) {
  constexpr size_t kMost = 28, kHead = 17, kTail = 10;
  return name.size() <= kMost ? name : name.substr(0, kHead) + "…" + name.substr(name.size() - kTail);
}

std::vector<std::string> in_lines(const std::string& words) {
  constexpr size_t kWidth = 165;
  std::vector<std::string> out{""};
  for (size_t from = 0; from < words.size();) {
    const size_t blank = std::min(words.find(' ', from), words.size());
    const std::string word = words.substr(from, blank - from);
    if (!out.back().empty() && out.back().size() + 1 + word.size() > kWidth) out.emplace_back();
    out.back() += (out.back().empty() ? "" : " ") + word;
    from = blank + 1;
  }
  return out;
}

void add_lines(size_t plain, Figure& figure) {
  for (size_t i = 0; i < figure.notes.size(); ++i)
    figure.words.emplace_back(text("line", i + 1),
                              i < plain ? without_markup(figure.notes[i]) : figure.notes[i]);
}

}  // namespace whine
