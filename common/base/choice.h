// Choices: enumerators, counted from 0, and the one word that scenes, artifacts and messages have for each.
#pragma once
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace whine {

// The words of a choice in the order of its enumerators, one blank between.
template <class Choice>
inline constexpr const char* kWordsOf = nullptr;

template <class Choice>
concept WordedChoice = std::is_enum_v<Choice> && bool(kWordsOf<Choice>);

// The word at a place in a list of words, from 0; empty behind the last.
std::string word_at(const char* words, int place);

// The place of a word in a list of words; nothing if it is not in it.
std::optional<int> place_of(const char* words, const std::string& word);

template <WordedChoice Choice>
std::string name_of(Choice choice) {
  return word_at(kWordsOf<Choice>, static_cast<int>(choice));
}

template <WordedChoice Choice>
std::optional<Choice> choice_of(const std::string& word) {
  const std::optional<int> place = place_of(kWordsOf<Choice>, word);
  return place ? std::optional(static_cast<Choice>(*place)) : std::nullopt;
}

// A list of choices as one line of words with a blank between, and back; nothing if a word is none of the choice's.
template <WordedChoice Choice>
std::string names_of(const std::vector<Choice>& list) {
  std::string line;
  for (const Choice choice : list) line += (line.empty() ? "" : " ") + name_of(choice);
  return line;
}
template <WordedChoice Choice>
std::optional<std::vector<Choice>> choices_in(const std::string& line) {
  std::vector<Choice> list;
  std::istringstream words(line);
  for (std::string word; words >> word;) {
    const std::optional<Choice> choice = choice_of<Choice>(word);
    if (!choice) return std::nullopt;
    list.push_back(*choice);
  }
  return list;
}

// The enumerator after `choice`; nothing after the last.
template <WordedChoice Choice>
std::optional<Choice> next_of(Choice choice) {
  return choice_of<Choice>(word_at(kWordsOf<Choice>, static_cast<int>(choice) + 1));
}

template <WordedChoice Choice>
std::ostream& operator<<(std::ostream& out, Choice choice) {
  return out << name_of(choice);
}

}  // namespace whine
