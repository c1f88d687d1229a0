// The text of stage parameters: TOML in SI, keys in the order of the table, one section after the other.
//
// Private to the layer io/.
#pragma once
#include <set>
#include <sstream>
#include <string>

#include "io/keys.h"

namespace whine {

// First line of stage parameters, before and after the stage that it is for.
inline constexpr const char *kStageParametersStart = "# What ",
                            *kStageParametersEnd =
                                " depends on, in SI units; made from a scene by gear-scene.";

class StageParametersText {
 public:
  explicit StageParametersText(const std::string& stage);

  // The keys of one section that belong to one of `parts`, under [label].
  void add(const std::string& section, const std::string& label, const SceneParameters& values,
           const std::set<KeyGroup>& parts);
  void add_line(const std::string& label, const std::string& name, const std::string& word);
  std::string text() const { return out_.str(); }

 private:
  void begin(const std::string& label);

  std::ostringstream out_;
  std::string last_;
};

}  // namespace whine
