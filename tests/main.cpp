// The test program: every tests/test_<module>.cpp is linked into it.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include "memory.h"

// Eigen takes memory by malloc, the standard library by operator new, which calls malloc: counted here for the
// whole test program. A sanitizer brings its own malloc; cases that count then count nothing and say so.
#ifdef WHINE_COUNTS_MEMORY
std::atomic<long> memory_requests{0};
extern "C" void* __libc_malloc(size_t);
extern "C" void* malloc(size_t size) noexcept {
  memory_requests.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
#endif
