#pragma once

#include "renderer/base/image.h"

namespace quartet {

/// How visible a difference is when one flips between two pictures on a display: LDR-FLIP,
/// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator
/// for Alternating Images", Proc. ACM CGIT 3(2), 2020. The viewer sits 0.7 m before a display 0.7 m
/// and 3840 pixels wide. Linear radiance is cut to [0, 1], as the tone map `clamp` does.

/// In [0, 1] for each pixel. The pictures have the same size and finite pixels. Runs on the threads
/// of the current TBB arena, whose number changes nothing.
ScalarImage flip_map(const RadianceImage& test, const RadianceImage& reference);

/// The mean of flip_map.
double flip(const RadianceImage& test, const RadianceImage& reference);

}  // namespace quartet
