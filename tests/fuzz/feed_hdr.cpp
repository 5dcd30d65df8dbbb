#include "tests/fuzz/feed.h"
#include "tests/fuzz/picture_promises.h"

namespace quartet {

/// The input is a Radiance HDR file.
void feed_hdr(std::string_view input) {
  promise_picture(scratch_file("picture.hdr", input), "picture.hdr");
}

}  // namespace quartet

QUARTET_FUZZ_ENTRY(quartet::feed_hdr)
