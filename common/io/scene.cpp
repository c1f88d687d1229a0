#include "io/scene.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "io/keys.h"
#include "io/publish.h"
#include "io/slice_text.h"
#include "io/study.h"
#include "io/suggestion.h"
#include "io/toml.h"
#include "io/variant.h"

namespace whine {
namespace {

const char* const kExample = "data/scenes/first-pair.toml explains a whole scene line by line";

std::string joined(const std::vector<std::string>& words, const std::string& between = ", ") {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) out += (i ? between : "") + words[i];
  return out;
}

// One line, short: what stands in the file as the value of a key.
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

constexpr const char *kBodyStage = "the body of a gear", *kStaticStage = "the static stage",
                     *kImpactStage = "the ring-down", *kSweepStage = "a sweep", *kMapStage = "a map of jumps",
                     *kLumpedStage = "a sweep of a lumped model",
                     *kLumpedMapStage = "a map of a lumped model", *kVariantStage = "a variant of a study";

// The file under reading: turns nodes into values and faults into errors with file:line.
class Source {
 public:
  explicit Source(const std::string& path, const std::string& hint = "check the path of the scene")
      : Source(path, read_bytes(path, hint), true) {}

  // lines: whether those of the bytes are those of the file.
  Source(std::string path, const std::string& bytes, bool lines) : path_(std::move(path)), lines_(lines) {
    const std::string first = bytes.substr(0, bytes.find('\n')), start = kSliceStart;
    const auto end = first.find(kSliceEnd);
    is_slice_ = first.starts_with(start) && end != std::string::npos;
    if (is_slice_) slice_of_ = first.substr(start.size(), end - start.size());
    try {
      root_ = parse_toml(bytes);
    } catch (const toml::parse_error& error) {
      refuse_line(error.source().begin.line, text("is not valid TOML: ", error.description()));
    }
  }

  // Of measured teeth: a line of names, then a line of numbers for each tooth; names and numbers apart by commas.
  static Source table_of_teeth(const std::string& path) {
    Source source(path, toml::table{});
    std::istringstream lines(
        read_bytes(path, "check 'file' of the scene; it starts from the scene's folder"));
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
          source.refuse_line(number, "the first column must be called tooth");
        continue;
      }
      if (fields.size() != names.size())
        source.refuse_line(number,
                           text("holds ", fields.size(), " numbers, ", names.size(), " columns are named"));
      for (size_t i = 0; i < fields.size(); ++i) {
        char* end = nullptr;
        const double value = std::strtod(fields[i].c_str(), &end);
        if (end == fields[i].c_str() || *end)
          source.refuse_line(number, text("'", fields[i], "' is no number"));
        if (i == 0 && value != tooth)
          source.refuse_line(number, text("tooth ", fields[i], " stands where tooth ", tooth,
                                          " is due; teeth are in order from 0"));
        if (i > 0) columns[i].push_back(value);
      }
      source.row_line_.push_back(number);
      ++tooth;
    }
    if (names.empty()) source.refuse("is empty; name the columns in the first line, tooth first");
    for (size_t i = 1; i < names.size(); ++i) source.root_.insert_or_assign(names[i], columns[i]);
    return source;
  }

  const std::string& path() const { return path_; }
  const toml::table& root() const { return root_; }
  bool is_slice() const { return is_slice_; }
  const std::string& slice_of() const { return slice_of_; }  // the stage that its first line names

  [[noreturn]] void refuse(const std::string& what) const { fail(Failure::input, path_, ": ", what); }
  // Line 0 is of what has no place of its own: the name of a column.
  [[noreturn]] void refuse_line(toml::source_index line, const std::string& what) const {
    if (!lines_) refuse(what);
    fail(Failure::input, path_, ":", line ? line : names_line_, ": ", what);
  }
  [[noreturn]] void refuse(const toml::node& at, const std::string& what) const {
    refuse_line(at.source().begin ? at.source().begin.line : line_in_column(at), what);
  }

  // A section [name] as a table, nullptr if it is not there.
  const toml::table* section(const std::string& name) const {
    const toml::node* node = root_.get(name);
    if (!node) return nullptr;
    if (const auto* table = node->as_table()) return table;
    refuse(*node, text("'", name, "' must be a section: write [", name, "]"));
  }

 private:
  Source(std::string path, toml::table root) : path_(std::move(path)), root_(std::move(root)) {}

  // Of a number in a table of teeth; 0 if it is none.
  toml::source_index line_in_column(const toml::node& at) const {
    for (const auto& [name, column] : root_)
      if (const toml::array* numbers = column.as_array())
        for (std::size_t i = 0; i < numbers->size() && i < row_line_.size(); ++i)
          if (numbers->get(i) == &at) return row_line_[i];
    return 0;
  }

  std::string path_, slice_of_;
  toml::table root_;
  toml::source_index names_line_ = 0;         // of a table of teeth
  std::vector<toml::source_index> row_line_;  // of its rows
  bool is_slice_ = false, lines_ = true;
};

// Section of a slice with what is a variant's own: its torque, the directions of its sweeps.
constexpr const char* kVariant = "variant";

constexpr std::size_t kLongestWord = 500;  // of a title, a name or a path

// In a scene keys carry unit suffixes and ranges hold; slices are in SI, written by this program.
enum class Dialect { scene, slice };

std::string name_in(const Key& key, Dialect dialect) {
  return dialect == Dialect::scene ? std::string(key.name) : key.si_name();
}

std::string unit_of(const Key& key) {
  const std::string suffix(key.unit.suffix);
  return suffix.empty() ? "" : " " + suffix.substr(1);
}

// Reads the keys of one section, e.g. label "gear.pinion" for the keys of section "gear".
class SectionReader {
 public:
  SectionReader(const Source& source, Dialect dialect, const toml::table& table, std::string section,
                std::string label)
      : source_(source),
        dialect_(dialect),
        table_(table),
        section_(std::move(section)),
        label_(std::move(label)) {}

  // Refuses keys that no key of this section is called; `others` are section names allowed besides.
  void refuse_unknown(const std::vector<std::string>& others = {}) const {
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
      source_.refuse_line(name.source().begin.line,
                          text("unknown ", top && is_section ? "section" : "key", " '", word, "'",
                               top ? "" : text(" in [", label_, "]"), advice));
    }
  }

  // Fills the keys of this section that belong to one of `parts`. Keys left out keep what stands in `values`
  // if `inherit`, else take their default; required ones are refused together.
  void read(KeyValues& values, const std::set<Part>& parts, bool inherit) const {
    std::vector<std::string> missing;
    for (const Key& key : scene_keys()) {
      if (key.section != section_ || !parts.count(key.part)) continue;
      const std::string name = name_in(key, dialect_);
      const toml::node* node = table_.get(name);
      if (node) {
        assign(key, *node, key.slot(values));
      } else if (inherit && key.name != std::string("like")) {
        continue;
      } else if (key.fallback && dialect_ == Dialect::scene) {
        assign_fallback(key, key.slot(values));
      } else {
        missing.push_back("'" + name + "'");
      }
    }
    if (!missing.empty()) {
      const std::string what = text("[", label_, "] lacks ", joined(missing), " (no default)");
      if (table_.source().begin) source_.refuse(table_, what);
      source_.refuse(what);
    }
  }

 private:
  [[noreturn]] void refuse(const Key& key, const toml::node& node, const std::string& what) const {
    source_.refuse(
        node, text("'", name_in(key, dialect_), "'", label_.empty() ? "" : text(" in [", label_, "]"), " = ",
                   as_written(node), ": ", what));
  }

  double finite_number(const Key& key, const toml::node& node, const std::string& item = "") const {
    if (!node.is_number())
      refuse(key, node,
             item + "must be a number" + (unit_of(key).empty() ? "" : " (in" + unit_of(key) + ")") +
                 number_advice(node.value<std::string>().value_or("")));
    const double value = node.value<double>().value_or(0.0);
    if (!std::isfinite(value)) refuse(key, node, item + "must be a finite number");
    return value;
  }

  // item: part of a value that the message is to name, with a blank after it.
  double checked_number(const Key& key, const toml::node& node, const std::string& item = "") const {
    const double value = finite_number(key, node, item);
    if (dialect_ == Dialect::slice) return value;
    const std::string why = *key.reason ? text(": ", key.reason) : "";
    if (value < key.least || (key.open && value == key.least)) {
      refuse(key, node,
             text(item, "must be ", key.open ? "greater than " : "at least ", key.least, unit_of(key), why));
    }
    if (value > key.most) refuse(key, node, text(item, "must be at most ", key.most, unit_of(key)));
    return key.to_si(value);
  }

  std::string checked_word(const Key& key, const toml::node& node) const {
    if (!node.is_string()) refuse(key, node, "must be text in quotes");
    std::string word = node.value<std::string>().value_or("");
    if (*key.choices) {
      std::istringstream list(key.choices);
      std::vector<std::string> choices;
      for (std::string choice; list >> choice;) choices.push_back(choice);
      if (std::find(choices.begin(), choices.end(), word) == choices.end()) {
        refuse(key, node, "must be one of: " + joined(choices));
      }
    } else if (std::any_of(word.begin(), word.end(), [](unsigned char c) { return c < 32 || c == 127; })) {
      refuse(key, node, "must be one line of text");
    }
    if (word.size() > kLongestWord)
      refuse(key, node, text("has ", word.size(), " bytes; must be at most ", kLongestWord));
    return word;
  }

  void assign(const Key& key, const toml::node& node, const Slot& slot) const {
    if (const auto* number = std::get_if<double*>(&slot)) {
      **number = checked_number(key, node);
    } else if (const auto* whole = std::get_if<int*>(&slot)) {
      const double value = checked_number(key, node);
      if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
        refuse(key, node, "must be a whole number");
      **whole = static_cast<int>(value);
    } else if (const auto* word = std::get_if<std::string*>(&slot)) {
      **word = checked_word(key, node);
    } else if (const auto* plane = std::get_if<PlaneSlot>(&slot)) {
      *plane->stress = checked_word(key, node) == "stress";
    } else if (const auto* corner = std::get_if<CornerRule*>(&slot)) {
      **corner = CornerRule{};
      if (node.is_boolean()) {
        (*corner)->enabled = node.value<bool>().value_or(true);
      } else if (node.is_number()) {
        (*corner)->largest_angle = checked_number(key, node);
      } else {
        refuse(key, node, "must be true, false or a number of degrees");
      }
    } else if (const auto* list = std::get_if<std::vector<double>*>(&slot)) {
      assign_list(key, node, **list);
    } else if (const auto* points = std::get_if<Points*>(&slot)) {
      assign_points(key, node, **points);
    } else if (const auto* teeth = std::get_if<ToothList>(&slot)) {
      const toml::array* array = node.as_array();
      if (!array) refuse(key, node, "must be a list with a number for each tooth");
      teeth->values->clear();
      for (const toml::node& item : *array) teeth->values->push_back(checked_number(key, item));
    } else {
      assign_range(key, node, std::get<RangeSlot>(slot));
    }
  }

  void assign_list(const Key& key, const toml::node& node, std::vector<double>& list) const {
    list.clear();
    const toml::array* array = node.as_array();
    if (!array) {
      list.push_back(checked_number(key, node));
    } else {
      if (array->empty()) refuse(key, node, "must hold at least one number");
      for (const toml::node& item : *array) list.push_back(checked_number(key, item));
    }
    if (dialect_ == Dialect::slice) return;
    // Folders are called by the value with six digits; two values must not meet there, nor a name mean
    // another value.
    std::set<double> seen;
    for (double value : list) {
      char name[32];
      std::snprintf(name, sizeof name, "%g", value);
      if (std::strtod(name, nullptr) != value) {
        refuse(key, node, text("has more than 6 significant digits; its folder would be called T", name));
      }
      if (!seen.insert(value).second) refuse(key, node, text("holds ", value, " twice"));
    }
  }

  void assign_points(const Key& key, const toml::node& node, Points& points) const {
    points.clear();
    const toml::array* array = node.as_array();
    if (!array) refuse(key, node, "must be a list of points: [[22.0, 0.0], [27.0, 10.0]]");
    const char* const kCoordinate[2] = {"roll angle ", "deviation "};
    for (const toml::node& item : *array) {
      const toml::array* pair = item.as_array();
      if (!pair || pair->size() != 2)
        refuse(key, item, "a point is [roll angle in degrees, micrometres taken off]");
      std::array<double, 2> point;
      for (int i = 0; i < 2; ++i) {
        const double value = finite_number(key, *pair->get(i), kCoordinate[i]);
        point[i] = value;
        if (dialect_ == Dialect::slice) continue;
        const double least = i == 0 ? 0 : key.least, most = i == 0 ? 90 : key.most;
        if (value < least || value > most)
          refuse(key, item,
                 text(kCoordinate[i], "must be from ", least, " to ", most, i == 0 ? " deg" : " um"));
        point[i] = value * kPointUnits[i].multiply / kPointUnits[i].divide;
      }
      if (!points.empty() && !(point[0] > points.back()[0]))
        refuse(key, item, "points must ascend in the roll angle; sort them and give each angle once");
      points.push_back(point);
    }
    if (points.size() == 1) refuse(key, node, "must hold two points at least, or none");
  }

  void assign_range(const Key& key, const toml::node& node, const RangeSlot& slot) const {
    const toml::table* table = node.as_table();
    if (!table) refuse(key, node, "must be a table: { from = 600, to = 4000, step = 20 }");
    const std::vector<std::pair<std::string, double*>> names = {
        {"from", slot.from}, {"to", slot.to}, {"step", slot.step}};
    for (const auto& [name, value] : *table) {
      const std::string word(name.str());
      if (std::none_of(names.begin(), names.end(), [&](const auto& known) { return known.first == word; })) {
        refuse(key, value, text("unknown key '", word, "'; known are: from, to, step"));
      }
    }
    for (const auto& [name, target] : names) {
      const toml::node* item = table->get(name);
      if (!item) refuse(key, node, text("lacks '", name, "'"));
      // The range of the key is that of the speeds; a step may be smaller.
      const std::string label = "'" + name + "' ";
      *target = target == slot.step ? key.to_si(finite_number(key, *item, label))
                                    : checked_number(key, *item, label);
      if (target == slot.step && !(*slot.step > 0)) {
        refuse(key, *item, text(label, "must be greater than 0", unit_of(key)));
      }
    }
    if (*slot.to < *slot.from) refuse(key, node, text("'to' must be at least 'from', which is ", *slot.from));
    if ((*slot.to - *slot.from) / *slot.step > 1e5)
      refuse(key, node, "is more than 100000 speeds; a larger 'step' makes fewer");
  }

  void assign_fallback(const Key& key, const Slot& slot) const {
    const std::string word(key.fallback);
    if (const auto* number = std::get_if<double*>(&slot)) {
      **number = key.to_si(std::strtod(key.fallback, nullptr));
    } else if (const auto* whole = std::get_if<int*>(&slot)) {
      **whole = static_cast<int>(std::strtol(key.fallback, nullptr, 10));
    } else if (const auto* target = std::get_if<std::string*>(&slot)) {
      **target = word;
    } else if (const auto* corner = std::get_if<CornerRule*>(&slot)) {
      **corner = CornerRule{word == "true", std::numeric_limits<double>::infinity()};
    } else if (const auto* points = std::get_if<Points*>(&slot)) {
      (*points)->clear();
    } else if (const auto* teeth = std::get_if<ToothList>(&slot)) {
      teeth->values->clear();
    } else {
      fail(Failure::numerical, "the key table gives '", key.name, "' a default that its type cannot take");
    }
  }

  const Source& source_;
  Dialect dialect_;
  const toml::table& table_;
  std::string section_, label_;
};

// Named sections below [group]: [gear.pinion], [material.steel].
std::vector<std::pair<std::string, const toml::table*>> named_sections(const Source& source,
                                                                       const std::string& group) {
  std::vector<std::pair<std::string, const toml::table*>> out;
  const toml::table* table = source.section(group);
  if (!table) return out;
  for (const auto& [key, node] : *table) {
    const std::string name(key.str());
    const auto* section = node.as_table();
    if (!section) {
      source.refuse_line(key.source().begin.line, text("'", name, "' stands in [", group,
                                                       "] itself; keys belong into [", group, ".<name>]"));
    }
    if (!plain_name(name)) {
      source.refuse_line(key.source().begin.line,
                         text("[", group, ".", name, "]: a name holds letters, digits, '_' and '-' only"));
    }
    out.emplace_back(name, section);
  }
  // toml++ keeps keys in alphabetical order; scenes are read in the order in which they are written.
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
    return a.second->source().begin.line < b.second->source().begin.line;
  });
  return out;
}

std::vector<std::string> names_of(const std::vector<std::pair<std::string, const toml::table*>>& sections) {
  std::vector<std::string> names;
  names.reserve(sections.size());
  for (const auto& section : sections) names.push_back(section.first);
  return names;
}

std::string advice_for(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = nearest(word, known);
  return near.empty() ? text("; known are: ", joined(known)) : text("; did you mean '", near, "'?");
}

// Fills what stands in [gear.<name>.modification], if that is there.
void read_modification(const Source& source, const toml::table& gear, const std::string& label,
                       KeyValues& values) {
  const toml::node* node = gear.get("modification");
  if (!node) return;
  const toml::table* table = node->as_table();
  if (!table)
    source.refuse(
        *node, text("'modification' in [", label, "] must be a section: write [", label, ".modification]"));
  const std::string own = label + ".modification";
  const SectionReader reader(source, Dialect::scene, *table, "modification", own);
  reader.refuse_unknown();
  // A start given here takes the place of one taken over from another gear, in whatever form.
  const auto starts = [&](const char* end) {
    std::vector<const toml::node*> given;
    for (const char* form : {"_start_deg", "_start_radius_mm", "_length_mm"})
      if (const toml::node* start = table->get(text(end, "_relief", form))) given.push_back(start);
    if (given.size() > 1)
      source.refuse(*given[1], text("[", own, "] says the start of ", end, "_relief ", given.size(),
                                    " times; give one of ", end, "_relief_start_deg, ", end,
                                    "_relief_start_radius_mm, ", end, "_relief_length_mm"));
    return !given.empty();
  };
  for (const auto& [end, relief] :
       {std::pair{"tip", &values.modification.tip}, std::pair{"root", &values.modification.root}})
    if (starts(end)) relief->start_roll = relief->start_radius = relief->length = 0;
  reader.read(values, {Part::modification}, true);
  for (const auto& [end, relief] :
       {std::pair{"tip", values.modification.tip}, std::pair{"root", values.modification.root}})
    if (relief.amount > 0 && !(relief.start_roll > 0 || relief.start_radius > 0 || relief.length > 0))
      source.refuse(*table, text("[", own, "] lacks the start of ", end, "_relief_um = ", relief.amount * 1e6,
                                 "; give one of ", end, "_relief_start_deg, ", end,
                                 "_relief_start_radius_mm, ", end, "_relief_length_mm"));
}

// Fills what stands in [gear.<name>.error] and in the file that it names, if it is there. Errors are a gear's own: `like` does
// not take them over.
void read_errors(const Source& source, const toml::table& gear, const std::string& label, KeyValues& values) {
  values.errors = {};
  const toml::node* node = gear.get("error");
  if (!node) return;
  const toml::table* table = node->as_table();
  if (!table)
    source.refuse(*node, text("'error' in [", label, "] must be a section: write [", label, ".error]"));
  const SectionReader reader(source, Dialect::scene, *table, "error", label + ".error");
  reader.refuse_unknown();
  reader.read(values, {Part::error_file}, false);
  if (!values.error_file.empty()) {
    const std::filesystem::path name = std::filesystem::path(source.path()).parent_path() / values.error_file;
    if (name.extension() != ".toml" && name.extension() != ".csv")
      source.refuse(*table->get("file"), text("'file' in [", label, ".error] = '", values.error_file,
                                              "' is neither a .toml nor a .csv"));
    const Source measured =
        name.extension() == ".csv" ? Source::table_of_teeth(name.string()) : Source(name.string());
    if (const toml::node* another = measured.root().get("file"))
      measured.refuse(*another, "a file of measured errors cannot name another");
    const SectionReader lists(measured, Dialect::scene, measured.root(), "error", "");
    lists.refuse_unknown();
    lists.read(values, {Part::error}, false);
  }
  reader.read(values, {Part::error}, !values.error_file.empty());
  for (const auto& [key, list] : {std::pair{"single_pitch_um", &values.errors.single_pitch},
                                  std::pair{"cumulative_pitch_um", &values.errors.cumulative_pitch},
                                  std::pair{"profile_slope_um", &values.errors.profile_slope},
                                  std::pair{"profile_form_um", &values.errors.profile_form}})
    if (!list->empty() && static_cast<int>(list->size()) != values.design.teeth) {
      const toml::node* at = table->get(key);
      source.refuse(at ? *at : *table,
                    text("'", key, "' in [", label, ".error] holds ", list->size(), " numbers, the gear has ",
                         values.design.teeth, " teeth; give one for each"));
    }
}

// Fills what stands in [gear.<name>.crack]. A crack is damage, not design: a gear that is `like` another has none of it.
void read_crack(const Source& source, const toml::table& gear, const std::string& label, GearDesign& design) {
  design.crack = Crack{};
  const toml::node* node = gear.get("crack");
  if (!node) return;
  const toml::table* table = node->as_table();
  if (!table)
    source.refuse(*node, text("'crack' in [", label, "] must be a section: write [", label, ".crack]"));
  const SectionReader reader(source, Dialect::scene, *table, "crack", label + ".crack");
  reader.refuse_unknown();
  KeyValues values;
  reader.read(values, {Part::crack}, false);
  if (values.design.crack.tooth >= design.teeth)
    source.refuse(*table->get("tooth"), text("'tooth' in [", label, ".crack] = ", values.design.crack.tooth,
                                             ": the gear has the teeth 0 to ", design.teeth - 1));
  if (values.design.crack.depth > 0) design.crack = values.design.crack;
}

const std::set<Part> kGearParts = {Part::reference, Part::design, Part::diameter, Part::inertia};

// Turns the diameters of tip and root into addendum and dedendum. `like`: the gear whose keys `values` began with, nullptr: none.
void take_diameters(const Source& source, const toml::table& table, const std::string& label,
                    const GearDesign* like, KeyValues& values) {
  GearDesign& d = values.design;
  // Of one end, in modules beyond the reference circle, outwards +1.
  const auto take = [&](const char* diameter_key, const char* height_key, double& diameter, double& height,
                        int outwards) {
    const toml::node *own = table.get(diameter_key), *own_height = table.get(height_key);
    if (own && own_height)
      source.refuse(*own, text("[", label, "] gives '", diameter_key, "' and '", height_key,
                               "', which say the same; give one of them"));
    if (own_height) diameter = 0;
    if (diameter == 0) return;
    const toml::node& at = own ? *own : static_cast<const toml::node&>(table);
    if (!own && like &&
        (like->teeth != d.teeth || like->module != d.module || like->profile_shift != d.profile_shift))
      source.refuse(at, text("[", label, "] takes '", diameter_key, "' = ", diameter * 1e3,
                             " over from a gear of other teeth, module or profile_shift; give '",
                             diameter_key, "' or '", height_key, "' here"));
    const double exact = outwards * (diameter / (2 * d.module) - d.teeth / 2.0 - d.profile_shift);
    // A drawing has fewer digits than round-off leaves: 1, not 1 + 4e-15, makes the body of addendum = 1.
    constexpr double kDigits = 1e12;
    height = std::round(exact * kDigits) / kDigits;
    constexpr double kMost = 3;  // the range of addendum and dedendum
    if (height > 0 && height <= kMost) return;
    const double pitch = d.module * (d.teeth + 2 * d.profile_shift),
                 limit = pitch + outwards * 2 * kMost * d.module;
    source.refuse(at, text("'", diameter_key, "' in [", label, "] = ", diameter * 1e3, ": with ", d.teeth,
                           " teeth, module_mm = ", d.module * 1e3, " and profile_shift = ", d.profile_shift,
                           " it must be between ", std::min(pitch, limit) * 1e3, " and ",
                           std::max(pitch, limit) * 1e3, " mm (", height_key, " above 0, at most 3)"));
  };
  take("tip_diameter_mm", "addendum", values.tip_diameter, d.addendum, 1);
  take("root_diameter_mm", "dedendum", values.root_diameter, d.dedendum, -1);
}

void read_gears(const Source& source, Scene& scene) {
  const auto materials = named_sections(source, "material");
  std::map<std::string, Material> material;
  for (const auto& [name, table] : materials) {
    KeyValues values;
    const SectionReader reader(source, Dialect::scene, *table, "material", "material." + name);
    reader.refuse_unknown();
    reader.read(values, {Part::material}, false);
    material[name] = values.material;
  }

  const auto gears = named_sections(source, "gear");
  const auto table_of = [&](const std::string& name) -> const toml::table* {
    for (const auto& gear : gears) {
      if (gear.first == name) return gear.second;
    }
    return nullptr;
  };
  const auto names = names_of(gears);
  for (const auto& [name, table] : gears) {
    // These would be mixed up with the folders of parameters, reports and torques beside the gear's own.
    const bool torque_like =
        name.size() > 1 && name[0] == 'T' && std::isdigit(static_cast<unsigned char>(name[1]));
    if (name == "params" || name == "report" || name == "variants" || torque_like) {
      source.refuse(*table, text("[gear.", name, "]: a gear cannot be called '", name,
                                 "', a folder of results is; choose another name"));
    }
    const SectionReader reader(source, Dialect::scene, *table, "gear", "gear." + name);
    reader.refuse_unknown({"crack", "modification", "error"});
    KeyValues values;
    GearDesign base_design;
    const toml::node* like = table->get("like");
    if (like && like->is_string()) {
      const std::string base = like->value<std::string>().value_or("");
      const toml::table* model = table_of(base);
      if (base == name) source.refuse(*like, text("[gear.", name, "] is like itself"));
      if (!model)
        source.refuse(
            *like, text("'like' in [gear.", name, "] names no gear: '", base, "'", advice_for(base, names)));
      if (const toml::node* chain = model->get("like")) {
        source.refuse(*like, text("[gear.", name, "] is like [gear.", base, "], which is like ",
                                  as_written(*chain), " itself; name the first gear"));
      }
      SectionReader(source, Dialect::scene, *model, "gear", "gear." + base).read(values, kGearParts, false);
      take_diameters(source, *model, "gear." + base, nullptr, values);
      base_design = values.design;
      read_modification(source, *model, "gear." + base, values);
    }
    reader.read(values, kGearParts, like != nullptr);
    take_diameters(source, *table, "gear." + name, like ? &base_design : nullptr, values);
    read_modification(source, *table, "gear." + name, values);
    read_errors(source, *table, "gear." + name, values);
    read_crack(source, *table, "gear." + name, values.design);
    if (!material.count(values.material_name)) {
      const toml::node* key = table->get("material");
      source.refuse(key ? *key : static_cast<const toml::node&>(*table),
                    text("'material' in [gear.", name, "] = '", values.material_name,
                         "' names no [material.<name>] section",
                         advice_for(values.material_name, names_of(materials))));
    }
    scene.gears.push_back({name, values.design, material.at(values.material_name), values.total_inertia,
                           values.modification, values.errors});
  }
}

void read_bearings(const Source& source, Scene& scene) {
  const toml::node* node = source.root().get("bearing");
  if (!node) return;
  const toml::array* list = node->as_array();
  if (!list || !list->is_array_of_tables())
    source.refuse(*node, "'bearing' must be a list of sections: write [[bearing]]");
  std::vector<std::string> names;
  for (const SceneGear& gear : scene.gears) names.push_back(gear.name);
  for (const toml::node& item : *list) {
    const toml::table& table = *item.as_table();
    KeyValues values;
    const SectionReader reader(source, Dialect::scene, table, "bearing", "bearing");
    reader.refuse_unknown();
    reader.read(values, {Part::bearing, Part::bearing_gear}, false);
    const auto gear = std::find(names.begin(), names.end(), values.bearing_gear);
    if (gear == names.end())
      source.refuse(*table.get("gear"),
                    text("'gear' in [bearing] = '", values.bearing_gear, "' names no [gear.<name>] section",
                         advice_for(values.bearing_gear, names)));
    Bearing& own = scene.gears[static_cast<std::size_t>(gear - names.begin())].bearing;
    if (own.elastic())
      source.refuse(*table.get("gear"),
                    text("'gear' in [bearing] = '", values.bearing_gear,
                         "' has a bearing already; give one section with what carries it in all"));
    own = values.bearing;
  }
}

void read_mesh_section(const Source& source, Scene& scene) {
  const toml::node* node = source.root().get("mesh");
  const toml::array* list = node->as_array();
  if (!list || !list->is_array_of_tables())
    source.refuse(*node, "'mesh' must be a list of sections: write [[mesh]]");
  if (list->size() != 1) {
    source.refuse(*list->get(1),
                  text("there are ", list->size(), " [[mesh]] sections; this version solves exactly one"));
  }
  const toml::table& table = *list->get(0)->as_table();
  KeyValues values;
  const SectionReader reader(source, Dialect::scene, table, "mesh", "mesh");
  reader.refuse_unknown();
  reader.read(values, {Part::mesh, Part::contact_plane}, false);
  std::vector<std::string> names;
  for (const SceneGear& gear : scene.gears) names.push_back(gear.name);
  for (const char* role : {"driver", "driven"}) {
    const std::string name = role == std::string("driver") ? values.mesh.driver : values.mesh.driven;
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      source.refuse(*table.get(role), text("'", role, "' in [mesh] = '", name,
                                           "' names no [gear.<name>] section", advice_for(name, names)));
    }
  }
  if (values.mesh.driver == values.mesh.driven) {
    source.refuse(*table.get("driven"), text("'driven' in [mesh] = '", values.mesh.driven,
                                             "' is the driver, too; a gear cannot mesh with itself"));
  }
  scene.mesh = values.mesh;
  scene.mesh.modification = {scene.gear(values.mesh.driver).modification,
                             scene.gear(values.mesh.driven).modification};
  scene.mesh.errors = {scene.gear(values.mesh.driver).errors, scene.gear(values.mesh.driven).errors};
  scene.mesh.bearing = {scene.gear(values.mesh.driver).bearing, scene.gear(values.mesh.driven).bearing};
}

// A slice of a stage, whose file gear-scene calls `name`; refuses a whole scene and the slice of another stage than these, which
// may hold the same keys with other values.
Source slice_source(const std::string& path, const std::string& name, const std::string& stage,
                    const std::string& other = "") {
  Source source(path, "a slice is out/<scene>/" + name + ", made with: make out/<scene>/" + name);
  if (!source.is_slice() && source.root().contains("gear") && source.root().contains("operation")) {
    const std::string stem = std::filesystem::path(path).stem().string(), slice = "out/" + stem + "/" + name;
    source.refuse(text("is a whole scene; this stage reads the slice of it that gear-scene cuts: give ",
                       slice, " (make SCENE=", path, " ", slice, ")"));
  }
  if (source.is_slice() && source.slice_of() != stage && source.slice_of() != other)
    source.refuse(text("is what ", source.slice_of(), " depends on, and this stage reads what ", stage,
                       " depends on: give out/<scene>/", name));
  return source;
}

// Reads one section of a slice; all its keys must be there.
void read_slice_section(const Source& source, const std::string& section, const std::string& label,
                        const std::set<Part>& parts, KeyValues& values) {
  const toml::table* table = source.section(label);
  if (!table)
    source.refuse(
        text("lacks the section [", label, "]: ",
             source.is_slice()
                 ? "it is the slice for another stage, or an old one; give out/<scene>/params/<stage>.toml"
                 : "it is no slice; gear-scene cuts them from a scene, out/<scene>/params/<stage>.toml"));
  SectionReader(source, Dialect::slice, *table, section, label).read(values, parts, false);
}

}  // namespace

bool plain_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
}

namespace {

Scene scene_of(const Source& source) {
  if (source.is_slice())
    source.refuse("is a slice, which gear-scene cut from a scene for one stage; give the scene itself");
  const SectionReader top(source, Dialect::scene, source.root(), "", "");
  top.refuse_unknown(
      {"gear", "material", "bearing", "mesh", "damping", "operation", "fidelity", "discretisation"});
  std::vector<std::string> missing;
  for (const char* name : {"gear", "material", "mesh", "operation"}) {
    if (source.root().get(name)) continue;
    const std::string word(name);
    missing.push_back(word == "mesh"        ? "[[mesh]]"
                      : word == "operation" ? "[operation]"
                                            : "[" + word + ".<name>]");
  }
  if (!missing.empty()) source.refuse(text("the scene lacks ", joined(missing), "; ", kExample));

  Scene scene;
  KeyValues values;
  top.read(values, {Part::title}, false);
  scene.title = values.title.empty() ? std::filesystem::path(source.path()).stem().string() : values.title;
  read_gears(source, scene);
  read_bearings(source, scene);
  read_mesh_section(source, scene);
  const std::set<Part> rest = {Part::damping,    Part::load,         Part::operation,
                               Part::rung,       Part::contact_rung, Part::body,
                               Part::near_field, Part::contact,      Part::time};
  static const toml::table kNothing;
  for (const char* name : {"damping", "operation", "fidelity", "discretisation"}) {
    const toml::table* table = source.section(name);
    const SectionReader reader(source, Dialect::scene, table ? *table : kNothing, name, name);
    reader.refuse_unknown();
    reader.read(values, rest, false);
    const toml::node* depth = table ? table->get("matching_depth_mm") : nullptr;
    if (depth && values.body.near_field != "matching")
      source.refuse(*depth, text("'matching_depth_mm' in [", name, "] = ", as_written(*depth),
                                 ": near_field is \"", values.body.near_field,
                                 "\", which has no depth; set near_field = \"matching\" or take it out"));
  }
  scene.damping = values.damping;
  scene.operation = values.operation;
  scene.fidelity = values.fidelity;
  scene.body = values.body;
  if (scene.fidelity.body == "full") scene.body.modes = kAllModes;
  scene.contact = values.contact;
  scene.time = values.time;
  return scene;
}

}  // namespace

Scene read_scene(const std::string& path) {
  return scene_of(Source(path));
}

Scene read_variant_of(const std::string& path, const std::string& variant) {
  return scene_of(Source(path, variant, false));
}

std::string body_slice(const Scene& scene, const std::string& gear) {
  const SceneGear& chosen = scene.gear(gear);
  return body_slice({chosen.design, chosen.material, scene.body});
}

std::string body_slice(const BodySlice& chosen) {
  KeyValues values;
  values.design = chosen.design;
  values.material = chosen.material;
  values.body = chosen.discretisation;
  SliceText out(kBodyStage);
  out.add("gear", "gear", values, {Part::design});
  if (values.design.crack.depth > 0) out.add("crack", "crack", values, {Part::crack});
  out.add("material", "material", values, {Part::material});
  out.add("fidelity", "fidelity", values, {Part::body});
  out.add("discretisation", "discretisation", values, {Part::body});
  if (values.body.near_field != BodyDiscretisation{}.near_field)
    out.add("discretisation", "discretisation", values, {Part::near_field});
  return out.text();
}

namespace {

KeyValues static_values(const Scene& scene) {
  KeyValues values;
  values.mesh = scene.mesh;
  values.fidelity = scene.fidelity;
  values.contact = scene.contact;
  if (values.contact.positions == 0) {
    values.contact.positions = std::max(128, scene.time.steps_per_period);
    int periods = 1;  // after which the same teeth meet
    for (const std::string& name : {scene.mesh.driver, scene.mesh.driven})
      if (!scene.gear(name).errors.none()) periods = std::lcm(periods, scene.gear(name).design.teeth);
    constexpr int kMostInAll = 16384, kLeast = 16;
    if (periods > 1)
      values.contact.positions = std::clamp(kMostInAll / periods, kLeast, values.contact.positions);
  }
  return values;
}

// moving: with what a motion needs in the same sections.
void add_static(SliceText& out, const Scene& scene, KeyValues& values, bool moving) {
  out.add("mesh", "mesh", values, {Part::mesh});
  // Left out where contact has the bodies' plane state, as every slice had before there was a choice.
  if (values.mesh.contact_plane != GearMeshSpec{}.contact_plane)
    out.add("mesh", "mesh", values, {Part::contact_plane});
  // Left out for flanks as they are designed, whose slices are what they were before flanks could be others.
  for (int g = 0; g < 2; ++g) {
    values.modification = scene.mesh.modification[g];
    if (values.modification != FlankModification{})
      out.add("modification", kModificationOf[g], values, {Part::modification});
  }
  for (int g = 0; g < 2; ++g) {
    values.errors = scene.mesh.errors[g];
    if (!values.errors.none()) out.add("error", kErrorOf[g], values, {Part::error});
  }
  for (int g = 0; g < 2; ++g) {
    values.bearing = scene.mesh.bearing[g];
    if (values.bearing.elastic()) out.add("bearing", kBearingOf[g], values, {Part::bearing});
  }
  using Parts = std::set<Part>;
  out.add("fidelity", "fidelity", values,
          moving ? Parts{Part::rung, Part::contact_rung} : Parts{Part::contact_rung});
  out.add("discretisation", "discretisation", values,
          moving ? Parts{Part::contact, Part::time} : Parts{Part::contact});
  // Going back to an earlier design finds its old body.h5, older than the static result of the design
  // between: only this text can tell make that the result is stale.
  out.add_line("body", "driver", body_hash(body_slice(scene, scene.mesh.driver)));
  out.add_line("body", "driven", body_hash(body_slice(scene, scene.mesh.driven)));
}

}  // namespace

std::string static_slice(const Scene& scene) {
  KeyValues values = static_values(scene);
  SliceText out(kStaticStage);
  add_static(out, scene, values, false);
  return out.text();
}

namespace {

KeyValues motion_values(const Scene& scene) {
  KeyValues values;
  values.damping = scene.damping;
  values.operation = scene.operation;
  if (scene.operation.torques.empty()) fail(Failure::input, "the scene lists no torque");
  values.operation.torques = {scene.operation.torques.front()};
  values.fidelity = scene.fidelity;
  values.time = scene.time;
  return values;
}

void add_inertia(SliceText& out, const Scene& scene, KeyValues& values) {
  for (const auto& [label, name] :
       {std::pair{"driver", scene.mesh.driver}, std::pair{"driven", scene.mesh.driven}}) {
    values.total_inertia = scene.gear(name).total_inertia;
    out.add("gear", label, values, {Part::inertia});
  }
}

void add_inertia_and_damping(SliceText& out, const Scene& scene, KeyValues& values) {
  add_inertia(out, scene, values);
  out.add("damping", "damping", values, {Part::damping});
}

}  // namespace

std::string impact_slice(const Scene& scene) {
  KeyValues values = motion_values(scene);
  SliceText out(kImpactStage);
  add_inertia_and_damping(out, scene, values);
  out.add("operation", "operation", values, {Part::load});
  out.add("fidelity", "fidelity", values, {Part::rung, Part::contact_rung});
  return out.text();
}

std::string sweep_slice(const Scene& scene) {
  KeyValues values = motion_values(scene);
  SliceText out(kSweepStage);
  add_inertia_and_damping(out, scene, values);
  out.add("operation", "operation", values, {Part::load, Part::operation});
  out.add("fidelity", "fidelity", values, {Part::rung, Part::contact_rung});
  out.add("discretisation", "discretisation", values, {Part::time});
  return out.text();
}

std::string map_slice(const Scene& scene) {
  KeyValues values = motion_values(scene);
  values.damping.rayleigh_stiffness = 0;
  SliceText out(kMapStage);
  add_inertia_and_damping(out, scene, values);
  out.add("operation", "operation", values, {Part::load});
  out.add("fidelity", "fidelity", values, {Part::rung, Part::contact_rung});
  out.add("discretisation", "discretisation", values, {Part::time});
  return out.text();
}

std::string lumped_slice(const Scene& scene, bool speeds) {
  KeyValues values = motion_values(scene);
  SliceText out(speeds ? kLumpedStage : kLumpedMapStage);
  add_inertia(out, scene, values);
  out.add("operation", "operation", values,
          speeds ? std::set<Part>{Part::load, Part::operation} : std::set<Part>{Part::load});
  out.add("fidelity", "fidelity", values, {Part::contact_rung});
  out.add("discretisation", "discretisation", values, {Part::time});
  return out.text();
}

std::string variant_slice(const Scene& scene, double torque, const std::vector<std::string>& directions) {
  KeyValues values = static_values(scene);
  const KeyValues moving = motion_values(scene);
  values.damping = moving.damping;
  values.time = moving.time;
  SliceText out(kVariantStage);
  add_static(out, scene, values, !directions.empty());
  if (!directions.empty()) {
    add_inertia_and_damping(out, scene, values);
    values.operation = moving.operation;
    out.add("operation", "operation", values, {Part::load, Part::operation});
  }
  values.operation.torques = {torque};
  out.add("operation", kVariant, values, {Part::load});
  out.add_line(kVariant, "directions", joined(directions, " "));
  return out.text();
}

std::string body_hash(const std::string& slice) {
  return sha256(slice).substr(0, 16);
}

BodySlice read_body_slice(const std::string& path) {
  const Source source = slice_source(path, "<gear>/body.toml", kBodyStage);
  KeyValues values;
  read_slice_section(source, "gear", "gear", {Part::design}, values);
  if (source.section("crack")) read_slice_section(source, "crack", "crack", {Part::crack}, values);
  read_slice_section(source, "material", "material", {Part::material}, values);
  read_slice_section(source, "fidelity", "fidelity", {Part::body}, values);
  read_slice_section(source, "discretisation", "discretisation", {Part::body}, values);
  if (source.section("discretisation")->contains("near_field"))
    read_slice_section(source, "discretisation", "discretisation", {Part::near_field}, values);
  return {values.design, values.material, values.body};
}

namespace {

StaticSlice read_static(const Source& source) {
  KeyValues values;
  read_slice_section(source, "mesh", "mesh", {Part::mesh}, values);
  if (source.section("mesh")->contains("contact_plane"))
    read_slice_section(source, "mesh", "mesh", {Part::contact_plane}, values);
  read_slice_section(source, "fidelity", "fidelity", {Part::contact_rung}, values);
  read_slice_section(source, "discretisation", "discretisation", {Part::contact}, values);
  for (int g = 0; g < 2; ++g) {
    if (!source.section(kModificationOf[g])) continue;
    read_slice_section(source, "modification", kModificationOf[g], {Part::modification}, values);
    values.mesh.modification[g] = values.modification;
  }
  for (int g = 0; g < 2; ++g) {
    if (!source.section(kErrorOf[g])) continue;
    read_slice_section(source, "error", kErrorOf[g], {Part::error}, values);
    values.mesh.errors[g] = values.errors;
  }
  for (int g = 0; g < 2; ++g) {
    if (!source.section(kBearingOf[g])) continue;
    read_slice_section(source, "bearing", kBearingOf[g], {Part::bearing}, values);
    values.mesh.bearing[g] = values.bearing;
  }
  StaticSlice out{values.mesh, values.fidelity, values.contact, "", ""};
  if (const toml::table* bodies = source.section("body")) {
    out.driver_body = (*bodies)["driver"].value_or(std::string());
    out.driven_body = (*bodies)["driven"].value_or(std::string());
  }
  return out;
}

void read_inertia(const Source& source, ImpactSlice& out) {
  KeyValues values;
  read_slice_section(source, "gear", "driver", {Part::inertia}, values);
  out.driver_inertia = values.total_inertia;
  read_slice_section(source, "gear", "driven", {Part::inertia}, values);
  out.driven_inertia = values.total_inertia;
}

ImpactSlice read_impact(const Source& source) {
  KeyValues values;
  ImpactSlice out;
  read_inertia(source, out);
  read_slice_section(source, "damping", "damping", {Part::damping}, values);
  read_slice_section(source, "operation", "operation", {Part::load}, values);
  read_slice_section(source, "fidelity", "fidelity", {Part::rung, Part::contact_rung}, values);
  out.damping = values.damping;
  out.reference_torque = values.operation.torques.front();
  out.fidelity = values.fidelity;
  return out;
}

void read_speeds(const Source& source, SweepSlice& out) {
  KeyValues values;
  read_slice_section(source, "operation", "operation", {Part::operation}, values);
  out.frequency_from = values.operation.frequency_from;
  out.frequency_to = values.operation.frequency_to;
  out.frequency_step = values.operation.frequency_step;
}

SweepSlice read_motion(const Source& source) {
  SweepSlice out;
  static_cast<ImpactSlice&>(out) = read_impact(source);
  KeyValues values;
  read_slice_section(source, "discretisation", "discretisation", {Part::time}, values);
  out.time = values.time;
  return out;
}

}  // namespace

StaticSlice read_static_slice(const std::string& path) {
  return read_static(slice_source(path, "params/static.toml", kStaticStage));
}

VariantSlice read_variant_slice(const std::string& path) {
  const Source source(path, "a variant's slice is written by: make study STUDY=<name>");
  KeyValues values;
  read_slice_section(source, "operation", kVariant, {Part::load}, values);
  VariantSlice out;
  out.statics = read_static(source);
  out.torque = values.operation.torques.front();
  std::istringstream words((*source.section(kVariant))["directions"].value_or(std::string()));
  for (std::string word; words >> word;) {
    if (word != "up" && word != "down")
      source.refuse(text("names the direction '", word, "'; there are up and down"));
    out.directions.push_back(word);
  }
  if (out.directions.empty()) return out;
  out.motion = read_motion(source);
  read_speeds(source, out.motion);
  return out;
}

ImpactSlice read_impact_slice(const std::string& path) {
  return read_impact(slice_source(path, "params/impact.toml", kImpactStage));
}

SweepSlice read_map_slice(const std::string& path) {
  return read_motion(slice_source(path, "params/map.toml", kMapStage));
}

SweepSlice read_sweep_slice(const std::string& path) {
  const Source source = slice_source(path, "params/sweep.toml", kSweepStage);
  SweepSlice out = read_motion(source);
  read_speeds(source, out);
  return out;
}

SweepSlice read_lumped_slice(const std::string& path, bool speeds) {
  const Source source = slice_source(path, speeds ? "params/lumped.toml" : "params/lumped_map.toml",
                                     speeds ? kLumpedStage : kLumpedMapStage,
                                     speeds ? kSweepStage : "");  // a sweep's holds all of it
  SweepSlice out;
  read_inertia(source, out);
  KeyValues values;
  read_slice_section(source, "operation", "operation", {Part::load}, values);
  read_slice_section(source, "fidelity", "fidelity", {Part::contact_rung}, values);
  read_slice_section(source, "discretisation", "discretisation", {Part::time}, values);
  out.reference_torque = values.operation.torques.front();
  out.fidelity.contact = values.fidelity.contact;
  out.time = values.time;
  if (speeds) read_speeds(source, out);
  return out;
}

}  // namespace whine
