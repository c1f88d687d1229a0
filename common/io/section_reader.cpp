#include "io/section_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <sstream>

#include "io/stage_parameters_text.h"
#include "io/suggestion.h"

namespace whine {
namespace {

constexpr std::size_t kLongestWord = 500;  // of a title, a name or a path

std::string name_in(const Key& key, Dialect dialect) {
  return dialect == Dialect::scene ? std::string(key.name) : key.si_name();
}

std::string unit_of(const Key& key) {
  const std::string unit = key.unit.in_words();
  return unit.empty() ? "" : " " + unit;
}

}  // namespace

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) out += (i ? between : "") + words[i];
  return out;
}

std::string as_written(const toml::node& node) {
  std::ostringstream out;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_floating_point<decltype(value)> || toml::is_integer<decltype(value)>) {
      // All digits that matter: a value beside its limit is not to look like it.
      char digits[40];
      const auto end = std::to_chars(digits, digits + sizeof digits, value.get());
      out << std::string(digits, end.ptr);
    } else {
      out << value;
    }
  });
  std::string word = out.str();
  std::replace(word.begin(), word.end(), '\n', ' ');
  return word.size() > 60 ? word.substr(0, 57) + "..." : word;
}

Source::Source(std::string path, const std::string& bytes, bool lines)
    : path_(std::move(path)), lines_(lines) {
  const std::string first = bytes.substr(0, bytes.find('\n')), start = kStageParametersStart;
  const auto end = first.find(kStageParametersEnd);
  is_stage_parameters_ = first.starts_with(start) && end != std::string::npos;
  if (is_stage_parameters_) stage_of_ = first.substr(start.size(), end - start.size());
  try {
    root_ = parse_toml(bytes);
  } catch (const toml::parse_error& error) {
    reject_line(error.source().begin.line, "is not valid TOML: ", error.description());
  }
}

Source Source::table_of_teeth(const std::string& path) {
  Source source(path, toml::table{});
  std::istringstream lines(read_bytes(path, "check 'file' of the scene; it starts from the scene's folder"));
  std::vector<std::string> names;
  std::vector<toml::array> columns;
  toml::source_index number = 0;
  double tooth = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.find_first_not_of(" \t") == std::string::npos || line[0] == '#') continue;
    std::vector<std::string> fields;
    std::istringstream rest(line);
    for (std::string field; std::getline(rest, field, ',');) {
      const auto first = field.find_first_not_of(" \t"), last = field.find_last_not_of(" \t");
      fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
    }
    if (names.empty()) {
      names = fields;
      source.names_line_ = number;
      columns.resize(names.size());
      if (names.empty() || names[0] != "tooth")
        source.reject_line(number, "the first column must be called tooth");
      continue;
    }
    if (fields.size() != names.size())
      source.reject_line(number, "holds ", fields.size(), " numbers, ", names.size(), " columns are named");
    for (size_t i = 0; i < fields.size(); ++i) {
      char* end = nullptr;
      const double value = std::strtod(fields[i].c_str(), &end);
      if (end == fields[i].c_str() || *end) source.reject_line(number, "'", fields[i], "' is no number");
      if (i == 0 && value != tooth)
        source.reject_line(number, "tooth ", fields[i], " stands where tooth ", tooth,
                           " is due; teeth are in order from 0");
      if (i > 0) columns[i].push_back(value);
    }
    source.row_line_.push_back(number);
    ++tooth;
  }
  if (names.empty()) source.reject("is empty; name the columns in the first line, tooth first");
  for (size_t i = 1; i < names.size(); ++i) source.root_.insert_or_assign(names[i], columns[i]);
  return source;
}

std::string Source::place(toml::source_index line) const {
  return lines_ ? text(path_, ":", line ? line : names_line_) : path_;
}

std::string Source::place(const toml::node& at) const {
  return place(at.source().begin ? at.source().begin.line : line_in_column(at));
}

const toml::table* Source::section(const std::string& name) const {
  const toml::node* node = root_.get(name);
  if (!node) return nullptr;
  if (const auto* table = node->as_table()) return table;
  reject(*node, "'", name, "' must be a section: write [", name, "]");
}

std::vector<const toml::table*> Source::list(const std::string& name) const {
  std::vector<const toml::table*> out;
  const toml::node* node = root_.get(name);
  if (!node) return out;
  const toml::array* list = node->as_array();
  if (!list || !list->is_array_of_tables())
    reject(*node, "'", name, "' must be a list of sections: write [[", name, "]]");
  for (const toml::node& item : *list) out.push_back(item.as_table());
  return out;
}

toml::source_index Source::line_in_column(const toml::node& at) const {
  for (const auto& [name, column] : root_)
    if (const toml::array* numbers = column.as_array())
      for (std::size_t i = 0; i < numbers->size() && i < row_line_.size(); ++i)
        if (numbers->get(i) == &at) return row_line_[i];
  return 0;
}

std::optional<SectionReader> SectionReader::below(const std::string& section) const {
  const toml::node* at = node(section);
  if (!at) return std::nullopt;
  if (!at->is_table())
    source_.reject(*at, "'", section, "' in [", label_, "] must be a section: write [", label_, ".", section,
                   "]");
  return SectionReader(source_, *at->as_table(), section, label_ + "." + section);
}

void SectionReader::reject_unknown(const std::vector<std::string>& others) const {
  std::vector<std::string> known = others;
  for (const Key& key : scene_keys()) {
    if (key.section == section_) known.push_back(name_in(key, dialect_));
  }
  for (const auto& [name, node] : table_) {
    const std::string word(name.str());
    if (std::find(known.begin(), known.end(), word) != known.end()) continue;
    std::string advice = dialect_ == Dialect::scene ? advice_on_key(word, section_, known) : "";
    if (advice.empty()) advice = text("; known are: ", joined(known));
    const bool is_section = node.is_table() || node.is_array_of_tables();
    const bool top = label_.empty();
    if (const toml::table* section = node.as_table();
        top && section && (section->contains("teeth") || section->contains("like")))
      advice = text("; a gear is [gear.", word, "]");
    else if (const std::string near = top && is_section ? nearest(word, others) : ""; !near.empty())
      advice = text("; did you mean '", near, "'?");
    source_.reject_line(name.source().begin.line, "unknown ", top && is_section ? "section" : "key", " '",
                        word, "'", top ? "" : text(" in [", label_, "]"), advice);
  }
}

void SectionReader::read(const KeyList& keys, bool inherit, const std::set<std::string>& optional) const {
  std::vector<std::string> missing;
  for (const Key& key : keys) {
    const std::string name = name_in(key, dialect_);
    const toml::node* node = table_.get(name);
    if (node) {
      assign(key, *node);
    } else if ((inherit && key.name != std::string("like")) || optional.count(name)) {
      continue;
    } else if (key.fallback && dialect_ == Dialect::scene) {
      key.take_fallback();
    } else {
      missing.push_back("'" + name + "'");
    }
  }
  if (!missing.empty()) {
    const std::string what = text("[", label_, "] lacks ", joined(missing), " (no default)");
    if (table_.source().begin) source_.reject(table_, what);
    source_.reject(what);
  }
}

std::string SectionReader::words_on(const Key& key, const toml::node& node) const {
  return text("'", name_in(key, dialect_), "'", label_.empty() ? "" : text(" in [", label_, "]"), " = ",
              as_written(node), ": ");
}

double SectionReader::finite_number(const Key& key, const toml::node& node, const std::string& item) const {
  if (!node.is_number())
    reject_value(key, node,
                 item + "must be a number" + (unit_of(key).empty() ? "" : " (in" + unit_of(key) + ")") +
                     number_advice(node.value<std::string>().value_or("")));
  const double value = node.value<double>().value_or(0.0);
  if (!std::isfinite(value)) reject_value(key, node, item + "must be a finite number");
  return value;
}

double SectionReader::checked_number(const Key& key, const toml::node& node, const std::string& item) const {
  const double value = finite_number(key, node, item);
  if (dialect_ == Dialect::settings) return value;
  if (key.limits.or_zero && value == 0) return value;
  const std::string why = *key.limits.reason ? text(": ", key.limits.reason) : "";
  if (value < key.limits.least || (key.limits.open && value == key.limits.least)) {
    reject_value(key, node, item, "must be ", key.limits.open ? "greater than " : "at least ",
                 key.limits.least, unit_of(key), why);
  }
  if (value > key.limits.most)
    reject_value(key, node, item, "must be at most ", key.limits.most, unit_of(key));
  return key.to_si(value);
}

std::string SectionReader::checked_word(const Key& key, const toml::node& node) const {
  if (!node.is_string()) reject_value(key, node, "must be text in quotes");
  std::string word = node.value<std::string>().value_or("");
  if (*key.choices) {
    std::istringstream list(key.choices);
    std::vector<std::string> choices;
    for (std::string choice; list >> choice;) choices.push_back(choice);
    if (std::find(choices.begin(), choices.end(), word) == choices.end()) {
      const std::string now = renamed(word);
      const bool known = std::find(choices.begin(), choices.end(), now) != choices.end();
      reject_value(
          key, node,
          "must be one of: " + joined(choices) + (known ? "; '" + word + "' is now '" + now + "'" : ""));
    }
  } else if (std::any_of(word.begin(), word.end(), [](unsigned char c) { return c < 32 || c == 127; })) {
    reject_value(key, node, "must be one line of text");
  }
  if (word.size() > kLongestWord)
    reject_value(key, node, "has ", word.size(), " bytes; must be at most ", kLongestWord);
  return word;
}

int SectionReader::whole_number(const Key& key, const toml::node& node) const {
  const double value = checked_number(key, node);
  if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
    reject_value(key, node, "must be a whole number");
  return static_cast<int>(value);
}

void SectionReader::assign(const Key& key, const toml::node& node) const {
  std::visit(Overloaded{[&](double* held) { *held = checked_number(key, node); },
                        [&](int* held) { *held = whole_number(key, node); },
                        [&](bool* held) {
                          if (!node.is_boolean()) reject_value(key, node, "must be true or false");
                          *held = node.value_or(false);
                        },
                        [&](std::string* held) { *held = checked_word(key, node); },
                        [&](const ChoiceSlot& choice) {
                          *key.choices ? key.assign(choice, checked_word(key, node))
                                       : choice.assign(choice.value, whole_number(key, node));
                        },
                        [&](CornerRule* rule) {
                          *rule = CornerRule{node.value_or(true)};
                          if (node.is_number())
                            *rule = {true, checked_number(key, node)};
                          else if (!node.is_boolean())
                            reject_value(key, node, "must be true, false or a number of degrees");
                        },
                        [&](std::vector<double>* list) { assign_list(key, node, *list); },
                        [&](Points* points) { assign_points(key, node, *points); },
                        [&](const RangeSlot& range) { assign_range(key, node, range); }},
             key.slot);
}

namespace {

// [1624,77, 800]: what to say of whole numbers that only a comma parts where others have a blank as well. "": there are none.
std::string decimal_comma_in(const toml::array& list) {
  const auto apart = [&](std::size_t i) -> long {
    const toml::source_position end = list[i].source().end, next = list[i + 1].source().begin;
    return end.line == next.line ? static_cast<long>(next.column) - static_cast<long>(end.column) : 0;
  };
  std::string words;
  bool blanks = false;
  for (std::size_t i = 0; i + 1 < list.size(); ++i) {
    blanks = blanks || apart(i) > 1;
    if (apart(i) != 1 || !list[i].is_integer() || !list[i + 1].is_integer() || !words.empty()) continue;
    const std::string whole = text(list[i].value_or(0)), parts = text(list[i + 1].value_or(0));
    words = text("holds ", whole, ",", parts,
                 " without a blank and others with one: numbers have a decimal point, ", whole, ".", parts,
                 "; two numbers are written ", whole, ", ", parts);
  }
  return blanks ? words : "";
}

}  // namespace

void SectionReader::assign_list(const Key& key, const toml::node& node, std::vector<double>& list) const {
  list.clear();
  const toml::array* array = node.as_array();
  if (*key.each) {
    if (!array) reject_value(key, node, "must be a list with a number for each ", key.each);
    for (const toml::node& item : *array) list.push_back(checked_number(key, item));
    return;
  }
  if (!array) {
    list.push_back(checked_number(key, node));
  } else {
    if (array->empty()) reject_value(key, node, "must hold at least one number");
    for (const toml::node& item : *array) list.push_back(checked_number(key, item));
    if (const std::string words = decimal_comma_in(*array); dialect_ == Dialect::scene && !words.empty())
      reject_value(key, node, words);
  }
  if (dialect_ == Dialect::settings) return;
  // Folders are called by the value with six digits; two values must not meet there, nor a name mean
  // another value.
  std::set<double> seen;
  for (double value : list) {
    char name[32];
    std::snprintf(name, sizeof name, "%g", value);
    if (std::strtod(name, nullptr) != value) {
      reject_value(key, node, "has more than 6 significant digits; its folder would be called T", name);
    }
    if (!seen.insert(value).second) reject_value(key, node, "holds ", value, " twice");
  }
}

void SectionReader::assign_points(const Key& key, const toml::node& node, Points& points) const {
  points.clear();
  const toml::array* array = node.as_array();
  if (!array) reject_value(key, node, "must be a list of points: [[22.0, 0.0], [27.0, 10.0]]");
  const char* const kCoordinate[2] = {"roll angle ", "deviation "};
  for (const toml::node& item : *array) {
    const toml::array* pair = item.as_array();
    if (!pair || pair->size() != 2)
      reject_value(key, item, "a point is [roll angle in degrees, micrometres taken off]");
    std::array<double, 2> point;
    for (int i = 0; i < 2; ++i) {
      const double value = finite_number(key, *pair->get(i), kCoordinate[i]);
      point[i] = value;
      if (dialect_ == Dialect::settings) continue;
      const double least = i == 0 ? 0 : key.limits.least, most = i == 0 ? 90 : key.limits.most;
      if (value < least || value > most)
        reject_value(key, item, kCoordinate[i], "must be from ", least, " to ", most,
                     i == 0 ? " deg" : " um");
      point[i] = value * kPointUnits[i].multiply / kPointUnits[i].divide;
    }
    if (!points.empty() && !(point[0] > points.back()[0]))
      reject_value(key, item, "points must ascend in the roll angle; sort them and give each angle once");
    points.push_back(point);
  }
  if (points.size() == 1) reject_value(key, node, "must hold two points at least, or none");
}

void SectionReader::assign_range(const Key& key, const toml::node& node, const RangeSlot& slot) const {
  const toml::table* table = node.as_table();
  if (!table) reject_value(key, node, "must be a table: { from = 600, to = 4000, step = 20 }");
  const std::vector<std::pair<std::string, double*>> names = {
      {"from", slot.from}, {"to", slot.to}, {"step", slot.step}};
  for (const auto& [name, value] : *table) {
    const std::string word(name.str());
    if (std::none_of(names.begin(), names.end(), [&](const auto& known) { return known.first == word; })) {
      reject_value(key, value, "unknown key '", word, "'; known are: from, to, step");
    }
  }
  for (const auto& [name, target] : names) {
    const toml::node* item = table->get(name);
    if (!item) reject_value(key, node, "lacks '", name, "'");
    // The range of the key is that of the speeds; a step may be smaller.
    const std::string label = "'" + name + "' ";
    *target =
        target == slot.step ? key.to_si(finite_number(key, *item, label)) : checked_number(key, *item, label);
    if (target == slot.step && !(*slot.step > 0)) {
      reject_value(key, *item, label, "must be greater than 0", unit_of(key));
    }
  }
  if (*slot.to < *slot.from) reject_value(key, node, "'to' must be at least 'from', which is ", *slot.from);
  if ((*slot.to - *slot.from) / *slot.step > 1e5)
    reject_value(key, node, "is more than 100000 speeds; a larger 'step' makes fewer");
}

}  // namespace whine
