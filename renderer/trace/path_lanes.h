#pragma once

#include <span>

#include "renderer/trace/integrator.h"
#include "renderer/trace/store/sample_source.h"

namespace quartet {

/// Makes the samples that the jobs ask for, eight paths at a time, each to the bit what trace_path
/// makes of it; their work is in rays. A lane whose path has ended takes the next, so that all are
/// busy until the jobs run out. What is rare in a scene of diffuse triangles (other shapes,
/// materials and lights, textures) goes lane by lane through the functions that serve a single
/// path.
template <bool NextEvent>
void trace_lanes(const TraceScene& scene, const RenderSettings& settings, const CameraRays& camera,
                 std::span<SampleJob> jobs);

extern template void trace_lanes<false>(const TraceScene&, const RenderSettings&, const CameraRays&,
                                        std::span<SampleJob>);
extern template void trace_lanes<true>(const TraceScene&, const RenderSettings&, const CameraRays&,
                                       std::span<SampleJob>);

}  // namespace quartet
