#include "signal/no_root_stress.h"

#include "base/error.h"

namespace whine {

std::string why_no_root_stress(const StaticResult& s) {
  if (s.root_stress_max.size() == kSides && s.root_stress[0].size() > 0 && s.root_stress[1].size() > 0)
    return "";
  return "static.h5 holds no root stress, for its bodies have no tables of it; make the bodies anew";
}

}  // namespace whine
