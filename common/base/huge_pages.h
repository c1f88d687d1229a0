// Memory for tables of megabytes that are read again and again: in pages of 2 MB where the system has them. A mesh period of
// steps touches more small pages than a processor keeps addresses of: on strips at 256 steps a period a step takes a tenth less
// time on large ones.
#pragma once
#include <memory_resource>

namespace whine {

// Blocks on whole large pages. Meant for few large blocks: as what a std::pmr::monotonic_buffer_resource draws on,
// or of a vector that stays. Throws std::bad_alloc.
std::pmr::memory_resource& huge_pages();

}  // namespace whine
