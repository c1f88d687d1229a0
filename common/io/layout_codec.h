// The bodies and meshes of a system, as the artifacts of systems hold them.
//
// Private to the layer io/.
#pragma once
#include <optional>
#include <string>

#include "model/system_stages.h"

namespace whine {

class Codec;

// /body/... and /mesh/...; of drives what is held. A reader rejects names, senses, teeth and places that no system has, and meshes
// of what is not two gears. Flanks and tooth numbers of the sides are left out.
void describe_layout(Codec& codec, System& layout);

// [gear.<name>.error] of the bodies that have some, as parameters, and then the tooth numbers of the sides, by which each pair in
// contact is one of two teeth.
void describe_errors(Codec& codec, SystemStaticParameters& settings);

// What no system can be, whoever wrote it: in an item of a list ("body", "mesh", "drive"), from 0, by one of its keys.
struct LayoutFault {
  std::string list;
  size_t number;
  std::string key, value, allowed;
};
std::optional<LayoutFault> layout_fault(const System& layout);

}  // namespace whine
