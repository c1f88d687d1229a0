// What stands in a file of TOML as keys of the table of keys: whole scenes and the stage parameters that are cut from them.
// Faults are errors with file:line.
//
// Private to the layer io/.
#pragma once
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
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

  [[noreturn]] void reject(const std::string& what) const { fail(Failure::input, path_, ": ", what); }
  // KeyError, about a key's value at this place.
  [[noreturn]] void reject_value(const std::string& key, const toml::node& at, const std::string& what) const;
  // Line 0 is of what has no place of its own: the name of a column.
  [[noreturn]] void reject_line(toml::source_index line, const std::string& what) const;
  [[noreturn]] void reject(const toml::node& at, const std::string& what) const;

  // A section [name] as a table, nullptr if it is not there.
  const toml::table* section(const std::string& name) const;

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

  // Rejects keys that no key of this section is called; `others` are section names allowed besides.
  void reject_unknown(const std::vector<std::string>& others = {}) const;

  // Fills these keys. Those left out keep what they hold if `inherit`, else take their default; required ones are rejected together,
  // but for `optional` ones, which then keep what they hold, too.
  void read(const KeyList& keys, bool inherit = false, const std::set<std::string>& optional = {}) const;

 private:
  [[noreturn]] void reject(const Key& key, const toml::node& node, const std::string& what) const;

  double finite_number(const Key& key, const toml::node& node, const std::string& item = "") const;

  // item: part of a value that the message is to name, with a blank after it.
  double checked_number(const Key& key, const toml::node& node, const std::string& item = "") const;

  std::string checked_word(const Key& key, const toml::node& node) const;

  void assign(const Key& key, const toml::node& node, const Slot& slot) const;

  void assign_list(const Key& key, const toml::node& node, std::vector<double>& list) const;

  void assign_points(const Key& key, const toml::node& node, Points& points) const;

  void assign_range(const Key& key, const toml::node& node, const RangeSlot& slot) const;

  void assign_fallback(const Key& key, const Slot& slot) const;

  const Source& source_;
  Dialect dialect_;
  const toml::table& table_;
  std::string section_, label_;
};

}  // namespace whine
