#pragma once

#include "renderer/base/image.h"

namespace quartet {

/// The picture with fewer pixels, each the average of the part that it covers, in display values:
/// what a screen shows of a picture that is larger than its place. Width and height from 1 to those
/// of the image.
DisplayImage reduce(const DisplayImage& image, int width, int height);

}  // namespace quartet
