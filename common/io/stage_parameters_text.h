// The text of stage parameters: TOML in SI, keys in the order of the table, one section after the other.
//
// Private to the layer io/.
#pragma once
#include <sstream>
#include <string>

#include "io/keys.h"
#include "io/section_reader.h"

namespace whine {

// First line of stage parameters, before and after the stage that it is for.
inline constexpr const char *kStageParametersStart = "# What ",
                            *kStageParametersEnd =
                                " depends on, in SI units; made from a scene by gear-scene.";

// Section of stage parameters that holds a key.
std::string stage_label(const Key& key);

class StageParametersText {
 public:
  explicit StageParametersText(const std::string& stage);

  void add(const KeyList& keys);  // those that are held
  void add_line(const std::string& label, const std::string& name, const std::string& word);
  std::string text() const { return out_.str(); }

 private:
  void begin(const std::string& label);

  std::ostringstream out_;
  std::string last_;
};

// Reads the keys of a list; those that are no optional ones must be there.
void read_stage(const Source& source, const KeyList& keys);

}  // namespace whine
