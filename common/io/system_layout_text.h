// The layout of a system in stage parameters: [[body]], [[mesh]], [[drive]].
//
// Private to the layer io/.
#pragma once
#include <string>

#include "io/section_reader.h"
#include "model/system.h"

namespace whine {

std::string layout_text(const System& layout);
// Errors name file and line.
System layout_from(const Source& source);

}  // namespace whine
