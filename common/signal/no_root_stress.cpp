#include "signal/no_root_stress.h"

#include "base/error.h"

namespace whine {

std::string why_no_root_stress(const StaticArtifact& s) {
  if (s.root_stress_max.size() == kSides && s.root_stress[0].size() > 0 && s.root_stress[1].size() > 0)
    return "";
  for (size_t g = 0; g < kSides; ++g)
    if (const Crack& crack = s.gear[g].design.crack; crack.depth > 0)
      return text(
          "static.h5 holds no root stress: tooth ", crack.tooth, " of ", s.mesh.gear[g], " has a crack of ",
          crack.depth * 1e3,
          " mm, and the stress of the roots about a crack is not computed (at its tip it is singular, and "
          "the tables of intact teeth do not hold beside it); take [gear.",
          s.mesh.gear[g], ".crack] out of the scene for that of the intact pair");
  return "static.h5 holds no root stress, for its bodies have no tables of it; make the bodies anew";
}

}  // namespace whine
