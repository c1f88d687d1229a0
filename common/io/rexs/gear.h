// One gear of a REXS model as sections of a scene: every value with its origin in a comment.
//
// Private to the layer io/.
#pragma once
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/rexs/reader.h"
#include "io/rexs/scene.h"
#include "model/gear.h"

namespace whine {

// All digits, and no more.
std::string all_digits(double value);

// Lines of a scene; what is assumed goes to its list, too.
class RexsWriter {
 public:
  explicit RexsWriter(RexsScene& out) : out_(out) {}
  void line(const std::string& words) { out_.text += words + "\n"; }
  void section(const std::string& name) { line("\n" + name); }
  void value(const std::string& key, const std::string& value, const std::string& remark);
  // of: section, for the list of what is assumed.
  void value(const std::string& key, const std::string& of, const RexsNumber& n);
  void assumed(const std::string& key, const std::string& of, const std::string& word,
               const std::string& why);
  // What is assumed of a whole section.
  void assumed_of(const std::string& section, const std::string& why);

 private:
  RexsScene& out_;
};

// What a gear has, and how it is drawn from that.
struct RexsGear {
  int id = -1;
  bool internal = false;
  RexsNumber teeth, module, angle, shift;  // 1, mm, deg, modules
  RexsNumber helix;  // deg, at the reference circle, positive: right-hand; its hand may be assumed
  std::pair<std::string, RexsNumber> tip, root;   // key of a scene (diameter or height) and its value
  RexsNumber root_radius, thinning, width, held;  // modules, mm; held: radius of bore or rim
  double reference_radius() const;                // normal modules
  GearDesign design() const;
};

// shift: as profile_shifts. Throws Error(input) for what a gear cannot do without.
RexsGear read_gear(RexsReader& reader, int gear, const RexsNumber& shift);

// Assumed heights of the tips of a pair become the largest, in steps of 0.05 modules, at which it runs; those that the model says stay.
void fit_tips(RexsGear& one, RexsGear& two, double distance_mm);

// Which flanks of a gear carry load: what each of its stages says of it. Both: of a planet.
struct RexsFlanks {
  std::vector<const RexsComponent*> stage_data;  // entries may be nullptr
  bool both = false;
};
void write_gear(RexsReader& reader, const RexsGear& gear, const std::string& name,
                const std::string& material, const RexsFlanks& flanks, RexsWriter& out, RexsScene& scene);

// Sections [material.<name>], each material once for each plane state.
class RexsMaterials {
 public:
  explicit RexsMaterials(RexsReader& reader) : reader_(reader) {}
  // The name of the material of a gear, written to `out` where it is new.
  std::string of(const RexsGear& gear, RexsWriter& out);

 private:
  RexsReader& reader_;
  std::map<std::string, std::string> plane_;  // by name
};

}  // namespace whine
