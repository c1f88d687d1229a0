// Files that a program is given one for each gear of a system: --body pinion=out/x/pinion/body.h5 --body wheel=...,
// in any order.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "io/scene.h"

namespace whine {

class NamedFiles {
 public:
  // option: "--body"; words: its values. Throws Error(usage) for a word that is not <gear>=<path> and for a gear that stands
  // twice.
  NamedFiles(std::string option, const std::vector<std::string>& words);

  // Paths of the gears of a mesh, the driver's first. Throws Error(usage) for a gear without a file and a file of no gear.
  std::vector<std::string> of(const GearMeshSpec& mesh) const;
  // The same of gears by their names; whole: what they are the gears of, in a message: "mesh" or "system".
  std::vector<std::string> of(const std::vector<std::string>& gears, const std::string& whole) const;
  // "body pinion": as what a file's history knows it.
  std::string role(const std::string& gear) const;
  // For made_by: the inputs given, and these.
  std::vector<std::string> and_inputs(std::vector<std::string> inputs) const;

 private:
  std::string option_;
  std::vector<std::pair<std::string, std::string>> files_;  // gear and path
};

}  // namespace whine
