#pragma once

#include <cstddef>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace quartet {

/// Calls body(context, begin, end) for disjoint ranges that together cover [0, count), none split
/// once it is down to `grain`, on the threads of the current TBB arena; returns when all calls
/// have. An exception of a call is thrown here, after the others ended or were left out.
void parallel_ranges(std::size_t count, std::size_t grain,
                     void (*body)(void* context, std::size_t begin, std::size_t end),
                     void* context);

/// The same for any callable body(begin, end).
///
/// Debian's TBB is not built for ThreadSanitizer, which therefore cannot see that a call comes
/// after what its caller did before and ahead of what it does next. It is told so here. The calls
/// stay unordered among themselves, so that a race between two of them is found.
template <typename Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
  struct Context {
    const Body& body;
    char finished;
  } context{body, 0};
#if defined(__SANITIZE_THREAD__)
  // Of all of this also where a call throws.
  struct AcquireAtEnd {
    void* address;
    ~AcquireAtEnd() { __tsan_acquire(address); }
  };
  struct ReleaseAtEnd {
    void* address;
    ~ReleaseAtEnd() { __tsan_release(address); }
  };
  const AcquireAtEnd after{&context.finished};
  __tsan_release(&context);
#endif
  parallel_ranges(
      count, grain,
      [](void* pointer, std::size_t begin, std::size_t end) {
        auto& shared = *static_cast<Context*>(pointer);
#if defined(__SANITIZE_THREAD__)
        __tsan_acquire(pointer);
        const ReleaseAtEnd done{&shared.finished};
#endif
        shared.body(begin, end);
      },
      &context);
}

}  // namespace quartet
