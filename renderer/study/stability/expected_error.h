#pragma once

#include <functional>
#include <memory>

#include "renderer/base/image.h"
#include "renderer/trace/integrator.h"

namespace quartet {

class TraceScene;

/// In every channel of a pixel, the squared relative error, as squared_errors() has it, that one
/// sample has in expectation, as if samples were independent: `spp` times the mean over `runs`
/// pictures of so many samples, each with a seed that no trial has. An oracle that decides by it
/// knows nothing of the samples that it is tried on.
///
/// Runs on the threads of the current TBB arena. `go_on` is called after each picture; if it
/// returns false, null comes back.
std::shared_ptr<const RadianceImage> expected_errors(const std::shared_ptr<const TraceScene>& scene,
                                                     const RenderSettings& settings,
                                                     const RadianceImage& truth, std::uint32_t spp,
                                                     std::uint32_t runs,
                                                     const std::function<bool()>& go_on);

}  // namespace quartet
