// What stands in a file of TOML as keys of the table of keys: whole scenes and the stage parameters that are cut from them.
// Faults are errors with file:line.
//
// Private to the layer io/.
#pragma once
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/key_error.h"
#include "io/keys.h"
#include "io/publish.h"
#include "io/toml.h"

namespace whine {

std::string joined(const std::vector<std::string>& words, const std::string& between = ", ");

// One line, short: what stands in the file as the value of a key.
std::string as_written(const toml::node& node);

// The file under reading: turns nodes into values and faults into errors with file:line.
class Source {
 public:
  explicit Source(const std::string& path, const std::string& hint = "check the path of the scene")
      : Source(path, read_bytes(path, hint), true) {}

  // lines: whether those of the bytes are those of the file.
  Source(std::string path, const std::string& bytes, bool lines);

  // Of measured teeth: a line of names, then a line of numbers for each tooth; names and numbers apart by commas.
  static Source table_of_teeth(const std::string& path);

  const std::string& path() const { return path_; }
  const toml::table& root() const { return root_; }
  bool is_stage_parameters() const { return is_stage_parameters_; }
  const std::string& stage_of() const { return stage_of_; }  // the stage that its first line names

  // What is wrong in words and values, as text() joins them.
  template <class First, class... What>
  requires(!std::is_base_of_v<toml::node, First>)
      [[noreturn]] void reject(const First& first, const What&... what) const {
    fail(Failure::input, path_, ": ", first, what...);
  }
  template <class... What>
  [[noreturn]] void reject(const toml::node& at, const What&... what) const {
    fail(Failure::input, place(at), ": ", what...);
  }
  // KeyError, about a key's value at this place.
  template <class... What>
  [[noreturn]] void reject_value(const std::string& key, const toml::node& at, const What&... what) const {
    throw KeyError(Failure::input, key, text(place(at), ": ", what...));
  }
  // Line 0 is of what has no place of its own: the name of a column.
  template <class... What>
  [[noreturn]] void reject_line(toml::source_index line, const What&... what) const {
    fail(Failure::input, place(line), ": ", what...);
  }

  // A section [name] as a table, nullptr if it is not there.
  const toml::table* section(const std::string& name) const;
  // The tables of [[name]]; none if there is no such section.
  std::vector<const toml::table*> list(const std::string& name) const;

 private:
  Source(std::string path, toml::table root) : path_(std::move(path)), root_(std::move(root)) {}
  std::string place(toml::source_index line) const;  // "scene.toml:12", or the path alone
  std::string place(const toml::node& at) const;

  // Of a number in a table of teeth; 0 if it is none.
  toml::source_index line_in_column(const toml::node& at) const;

  std::string path_, stage_of_;
  toml::table root_;
  toml::source_index names_line_ = 0;         // of a table of teeth
  std::vector<toml::source_index> row_line_;  // of its rows
  bool is_stage_parameters_ = false, lines_ = true;
};

// In a scene keys carry unit suffixes and ranges hold; stage parameters are in SI, written by this program.
enum class Dialect { scene, settings };

// One section of a file: label "gear.pinion.crack", its keys those of the section "crack"; name: "pinion".
class SectionReader {
 public:
  SectionReader(const Source& source, const toml::table& table, std::string section, std::string label,
                std::string name = "", Dialect dialect = Dialect::scene)
      : source_(source),
        table_(table),
        section_(std::move(section)),
        label_(std::move(label)),
        name_(std::move(name)),
        dialect_(dialect) {}

  const Source& source() const { return source_; }
  const toml::table& table() const { return table_; }
  const std::string& label() const { return label_; }
  const std::string& name() const { return name_; }
  const toml::node* node(const std::string& key) const { return table_.get(key); }  // nullptr: not given
  // The section [<label>.<section>]; nothing if it is not there.
  std::optional<SectionReader> below(const std::string& section) const;

  // Rejects keys that no key of this section is called; `others` are section names allowed besides.
  void reject_unknown(const std::vector<std::string>& others = {}) const;

  // Fills these keys. Those left out keep what they hold if `inherit`, else take their default; required ones are rejected together,
  // but for `optional` ones, which then keep what they hold, too.
  void read(const KeyList& keys, bool inherit = false, const std::set<std::string>& optional = {}) const;
  void read_all(const KeyList& keys) const {
    reject_unknown();
    read(keys);
  }

  // "[gear.pinion] <what>", at a place in it; at the section.
  template <class... What>
  [[noreturn]] void reject_at(const toml::node& at, const What&... what) const {
    source_.reject(at, "[", label_, "]", what...);
  }
  template <class... What>
  [[noreturn]] void reject(const What&... what) const {
    reject_at(table_, what...);
  }
  // "[gear.pinion] gives 'key'<what>", if it does.
  template <class... What>
  void reject_given(const std::string& key, const What&... what) const {
    if (const toml::node* at = node(key)) reject_at(*at, " gives '", key, "'", what...);
  }
  // "'key' in [gear.pinion]<what>", at the key or, if it is not given, at the section.
  template <class... What>
  [[noreturn]] void reject_key(const std::string& key, const What&... what) const {
    const toml::node* at = node(key);
    source_.reject(at ? *at : table_, "'", key, "' in [", label_, "]", what...);
  }

 private:
  // At a key's value: what it is, and what it must be.
  template <class... What>
  [[noreturn]] void reject_value(const Key& key, const toml::node& node, const What&... what) const {
    source_.reject_value(key.name, node, words_on(key, node), what...);
  }
  std::string words_on(const Key& key, const toml::node& node) const;

  double finite_number(const Key& key, const toml::node& node, const std::string& item = "") const;
  // item: part of a value that the message is to name, with a blank after it.
  double checked_number(const Key& key, const toml::node& node, const std::string& item = "") const;
  int whole_number(const Key& key, const toml::node& node) const;
  std::string checked_word(const Key& key, const toml::node& node) const;

  void assign(const Key& key, const toml::node& node) const;
  void assign_list(const Key& key, const toml::node& node, std::vector<double>& list) const;
  void assign_points(const Key& key, const toml::node& node, Points& points) const;
  void assign_range(const Key& key, const toml::node& node, const RangeSlot& slot) const;

  const Source& source_;
  const toml::table& table_;
  std::string section_, label_, name_;
  Dialect dialect_;
};

}  // namespace whine
