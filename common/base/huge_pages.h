// Memory in pages of 2 MB, where the system gives them on advice: what a loop streams from it is then not slowed down by
// the look-up of its pages, which on a simulated machine takes as long as the data.
#pragma once
#include <sys/mman.h>

#include <cstddef>
#include <cstdint>

namespace whine {

// For memory that has not been written yet. Nothing but speed depends on it.
inline void advise_huge_pages(const void* memory, size_t bytes) {
  constexpr std::uintptr_t kPage = 2u << 20;  // bytes
  const auto at = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (at + kPage - 1) / kPage * kPage, end = (at + bytes) / kPage * kPage;
  if (first < end) madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
}

}  // namespace whine
