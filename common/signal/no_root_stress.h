// Why a static result holds no root stress.
#pragma once
#include <string>

#include "results/static.h"

namespace whine {

// "" where it holds root stress; else the reason, with what to do, as a message or a line of a page says it.
std::string why_no_root_stress(const StaticResult& statics);

}  // namespace whine
