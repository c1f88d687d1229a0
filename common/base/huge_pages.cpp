#include "base/huge_pages.h"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace whine {

namespace {

class HugePages : public std::pmr::memory_resource {
  static constexpr size_t kPage = size_t{2} << 20;

  void* do_allocate(size_t bytes, size_t) override {
    const size_t whole = (bytes + kPage - 1) / kPage * kPage;
    void* block = std::aligned_alloc(kPage, whole);
    if (!block) throw std::bad_alloc();
    madvise(block, whole, MADV_HUGEPAGE);  // a wish: without it the same memory is slower
    return block;
  }
  void do_deallocate(void* block, size_t, size_t) override { std::free(block); }
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override { return this == &other; }
};

}  // namespace

std::pmr::memory_resource& huge_pages() {
  static HugePages pages;
  return pages;
}

}  // namespace whine
