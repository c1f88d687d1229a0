// The test program: every tests/<layer>/test_<file>.cpp is linked into it.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include "memory.h"

// Eigen takes memory by malloc, the standard library by operator new, which calls malloc: counted here for the
// whole test program.
std::atomic<long> memory_requests{0};
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
const bool counts_memory = true;
extern "C" void* __libc_malloc(size_t);
extern "C" void* malloc(size_t size) noexcept {
  memory_requests.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
#else
const bool counts_memory = false;
#endif
