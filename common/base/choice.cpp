#include "base/choice.h"

#include <sstream>

namespace whine {

std::string word_at(const char* words, int place) {
  std::istringstream list(words);
  std::string word;
  for (int i = 0; i <= place; ++i)
    if (!(list >> word)) return "";
  return word;
}

std::optional<int> place_of(const char* words, const std::string& word) {
  std::istringstream list(words);
  int place = 0;
  for (std::string candidate; list >> candidate; ++place)
    if (candidate == word) return place;
  return std::nullopt;
}

}  // namespace whine
