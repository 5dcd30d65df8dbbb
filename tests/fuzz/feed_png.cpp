#include "tests/fuzz/feed.h"
#include "tests/fuzz/picture_promises.h"

namespace quartet {

/// The input is a PNG file.
void feed_png(std::string_view input) {
  promise_picture(scratch_file("picture.png", input), "picture.png");
}

}  // namespace quartet

QUARTET_FUZZ_ENTRY(quartet::feed_png)
