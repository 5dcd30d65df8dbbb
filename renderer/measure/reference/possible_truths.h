#pragma once

#include <array>

#include "renderer/base/image.h"

namespace quartet {

/// Two pictures that the truth could be, for all that a picture of samples says: `image`, the mean
/// of two halves that know nothing of each other. Where no half saw a rare light, both agree on too
/// little, and only the neighbours tell of it.
///
/// Among the pixels around, weighted by a Gaussian of `sigma` pixels, let m be the mean of a
/// channel, s² its variance and n² that of the noise, half the halves' difference d. Then s² − n²
/// is what the scene varies by, and of a truth with these moments the best linear guess (Wiener
/// 1949; Lee 1980) is m + k (image − m) with k = 1 − n²/s², off by a variance of k n². The two
/// pictures are that guess ± √k d, at least 0: d where the scene varies more than the noise does,
/// the neighbours' mean where it is noise that varies.
///
/// Two corrections. n² is of the neighbours, and beside the edge of a bright light much more than
/// the pixel's own: 1 − k is taken to the power of 1.2, with as much more of d, which of 1 to 3
/// came nearest to what better references measure. Few pixels say little about s²: the distance
/// from `image` is scaled to be, in the mean over the picture, the noise that the halves have,
/// or twice what it was where that would take more.
///
/// A pixel that is not finite is no neighbour, and stays as it is in `image`. All have one size.
std::array<RadianceImage, 2> possible_truths(const RadianceImage& image,
                                             const std::array<RadianceImage, 2>& halves,
                                             double sigma);

}  // namespace quartet
