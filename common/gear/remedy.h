// What to change of a drawing whose gears cannot exist or cannot mesh: the smallest change of one or two of its numbers after which
// all checks pass. The remedy of a single check may be what another one forbids.
#pragma once
#include <string>
#include <vector>

#include "model/scene.h"

namespace whine {

struct DrawnGears {
  struct Mesh {
    size_t first = 0, second = 0;  // of `design`
    double centre_distance = 0;    // m
  };
  std::vector<std::string> name;   // [gear]
  std::vector<GearDesign> design;  // [gear]
  std::vector<Mesh> mesh;
};
DrawnGears drawn_gears(const Scene& scene);  // of a pair the driver first, without gears that do not mesh

// The first thing that ToothGeometry or GearPair rejects, in its words; "" if all gears exist and all meshes mesh.
std::string fault(const DrawnGears& gears);

struct Change {
  bool of_mesh = false;
  size_t number = 0;                     // of the gear or mesh
  const char* key = "";                  // in a scene
  double GearDesign::*member = nullptr;  // of a gear
  double value = 0;                      // SI
};

// Empty if there is no fault, or none of the changes that are tried mends it: profile shifts, addendum, dedendum, rack tip, bore or rim, each
// up to 1.5 modules, and the centre distance of a pair.
std::vector<Change> remedy(const DrawnGears& gears);
void change(DrawnGears& gears, const std::vector<Change>& changes);

// The words of an error with the remedy of all checks in place of its own, which follows the last "; "; as they are if
// there is none.
std::string with_remedy(const std::string& words, const DrawnGears& gears);

}  // namespace whine
