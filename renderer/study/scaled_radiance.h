#pragma once

#include "renderer/base/image.h"
#include "renderer/trace/store/sample_source.h"

namespace quartet {

/// The same with each channel of all radiance times a factor.
SampleSource scaled(SampleSource source, const glm::vec3& factor);
RadianceImage scaled(RadianceImage image, const glm::vec3& factor);

}  // namespace quartet
