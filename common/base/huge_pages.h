// Memory for tables of megabytes that are read again and again: in pages of 2 MB where the system has them. A mesh period of
// steps touches more small pages than a processor keeps addresses of: on strips at 256 steps a period a step takes a tenth less
// time on large ones.
#pragma once
#include <cstddef>
#include <memory_resource>
#include <utility>

namespace whine {

// Blocks on whole large pages. Meant for few large blocks: as what a std::pmr::monotonic_buffer_resource draws on,
// or of a vector that stays. Throws std::bad_alloc.
std::pmr::memory_resource& huge_pages();

// Such a block without anything in it: only what is written takes memory of the machine.
class HugeBlock {
 public:
  HugeBlock() = default;
  explicit HugeBlock(size_t bytes) : bytes_(bytes), data_(huge_pages().allocate(bytes)) {}
  HugeBlock(HugeBlock&& other) noexcept { swap(other); }
  HugeBlock& operator=(HugeBlock&& other) noexcept {
    swap(other);
    return *this;
  }
  ~HugeBlock() {
    if (data_) huge_pages().deallocate(data_, bytes_);
  }
  void* data() const { return data_; }
  size_t bytes() const { return bytes_; }

 private:
  void swap(HugeBlock& other) {
    std::swap(bytes_, other.bytes_);
    std::swap(data_, other.data_);
  }
  size_t bytes_ = 0;
  void* data_ = nullptr;
};

}  // namespace whine
