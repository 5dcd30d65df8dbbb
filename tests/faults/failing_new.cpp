#include "tests/faults/failing_new.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace quartet {
namespace {

std::atomic<long> allocations_left = 0;  // the one that makes it 0 fails
std::atomic<bool> allocation_failed = false;

bool fails() {
  if (allocations_left.load(std::memory_order_relaxed) <= 0 || allocations_left.fetch_sub(1) != 1) {
    return false;
  }
  allocation_failed = true;
  return true;
}

}  // namespace

FailingNew::FailingNew(long nth) {
  allocation_failed = false;
  allocations_left = nth;
}

FailingNew::~FailingNew() {
  allocations_left = 0;
}

bool FailingNew::happened() const {
  return allocation_failed;
}

}  // namespace quartet

// From malloc, so that a sanitizer sees them all the same.

void* operator new(std::size_t size) {
  void* const memory = quartet::fails() ? nullptr : std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}

void* operator new(std::size_t size, std::align_val_t alignment) {
  const std::size_t step = std::size_t(alignment);
  const std::size_t rounded = (size + step - 1) / step * step;
  void* const memory =
      quartet::fails() ? nullptr : std::aligned_alloc(step, rounded > 0 ? rounded : step);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

#ifdef __SANITIZE_ADDRESS__
/// OpenEXR's constructors lose what they have made when a later allocation fails, which only this
/// program makes happen; what the other tests leak is found.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOpenEXR\n";
}
#endif
