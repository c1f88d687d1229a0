// The bodies and meshes of a system, as the artifacts of systems hold them.
//
// Private to the layer io/.
#pragma once
#include <optional>
#include <string>

#include "model/system_stages.h"

namespace whine {

class Codec;

// Where a layout stands in a file, and how its axes are called: body_number, mesh_number.
struct LayoutPlace {
  std::string group;                 // "" or "/layout"
  std::string axis_end = "_number";  // "" where the file has the names as /body and /mesh
};

// /body/... and /mesh/...; of drives what is held, and whether one torque, a parameter of the file, loads the gears of a pair. A reader
// rejects names, senses, teeth and places that no system has, and meshes of what is not two gears. Flanks and tooth numbers of the sides
// are left out.
void describe_layout(Codec& codec, System& layout, const LayoutPlace& place = {});
// (mesh) number of its [[mesh]], from 0.
void describe_sections(Codec& codec, std::vector<int>& section, const LayoutPlace& place = {});

// [gear.<name>.error] of the bodies that have some, as parameters, and then the tooth numbers of the sides, by which each pair in
// contact is one of two teeth.
void describe_errors(Codec& codec, System& layout, std::vector<ToothErrors>& errors,
                     const LayoutPlace& place = {});

// What no system can be, whoever wrote it: in an item of a list ("body", "mesh", "drive"), from 0, by one of its keys.
struct LayoutFault {
  std::string list;
  size_t number;
  std::string key, value, allowed;
};
std::optional<LayoutFault> layout_fault(const System& layout);

}  // namespace whine
