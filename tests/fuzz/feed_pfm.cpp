#include "tests/fuzz/feed.h"
#include "tests/fuzz/picture_promises.h"

namespace quartet {

/// The input is a PFM file.
void feed_pfm(std::string_view input) {
  promise_picture(scratch_file("picture.pfm", input), "picture.pfm");
}

}  // namespace quartet

QUARTET_FUZZ_ENTRY(quartet::feed_pfm)
