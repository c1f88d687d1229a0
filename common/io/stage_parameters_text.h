// Stage parameters: what a stage depends on of a scene, as TOML in SI. One walk over what they hold writes and reads them:
//
//   void walk(StageParameters& s, StaticParameters& p) {
//     s(keys(p.mesh).append(keys(p.contact)));
//     s.word("body", "driver", p.body[0]);
//   }
//
// Private to the layer io/.
#pragma once
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "io/keys.h"
#include "io/section_reader.h"

namespace whine {

// First line of stage parameters, before and after the stage that it is for.
inline constexpr const char *kStageParametersStart = "# What ",
                            *kStageParametersEnd =
                                " depends on, in SI units; made from a scene by gear-scene.";

// A file of stage parameters below out/<scene>/, and the stage that it is for.
struct StageFile {
  const char *path, *stage;
};

// The file at `path`; rejects a whole scene and the parameters of another stage than these, which may hold the same keys with other
// values.
Source stage_source(const std::string& path, const StageFile& file, const StageFile& other = {"", ""});

class StageParameters {
 public:
  explicit StageParameters(const StageFile& file);                      // writes
  explicit StageParameters(const Source& source) : source_(&source) {}  // reads
  explicit StageParameters(Source&&) = delete;

  const Source* source() const { return source_; }  // nullptr of a writer
  // Whether a section is there: what `there` says to a writer.
  bool has(const std::string& section, bool there) const;

  // Keys that are held, section by section. A reader rejects what lacks, but for optional groups.
  void operator()(const KeyList& keys);
  // A word; "" to a reader if it is not there.
  void word(const std::string& section, const std::string& name, std::string& word);
  // Names and words of a section that must be there, in the order of the file.
  using Words = std::vector<std::pair<std::string, std::string>>;
  void words(const std::string& section, Words& words);
  // A section [[name]] of each item, all keys of it.
  template <class Item>
  void list(const char* name, std::vector<Item>& items) {
    for (const toml::table* row : rows(name)) read_row(*row, name, keys(items.emplace_back()));
    for (std::size_t i = 0; !source_ && i < items.size(); ++i) put_row(name, keys(items[i]));
  }

  std::string text() const { return out_.str(); }

 private:
  void begin(const std::string& section);
  void read(const KeyList& keys) const;
  std::vector<const toml::table*> rows(const char* name) const;  // none to a writer
  void read_row(const toml::table& row, const char* name, const KeyList& keys) const;
  void put_row(const char* name, const KeyList& keys);

  const Source* source_ = nullptr;
  std::ostringstream out_;
  std::string last_;
};

// Model level of the contact and its discretisation; moving: with what a motion needs in these sections, nullptr: without.
KeyList level_keys(Fidelity& fidelity, ContactDiscretisation& contact, TimeDiscretisation* moving);

}  // namespace whine
