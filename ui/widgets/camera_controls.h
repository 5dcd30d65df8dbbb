#pragma once

#include <glm/glm.hpp>

#include "renderer/trace/trace_scene.h"

namespace quartet {

/// Moves a camera around what it looks at. The scene's own camera is where it comes home to.
///
/// However often and in whatever order, the moves below lead to no camera that the tracer cannot
/// take (see camera_fault in limits.h): they stop at distances from the pivot of a ten thousandth
/// and of ten thousand times that of the scene's own camera, and where coordinates end.
struct CameraControls {
  Camera home;
  glm::vec3 pivot{0.0f};  ///< what the camera turns around
};

/// The pivot is as far ahead as the middle one of the surfaces that the camera sees.
CameraControls camera_controls(const TraceScene& scene);

/// Turns around the pivot by angles in radians: right around the home camera's upward direction,
/// then up. Stops short of looking straight up or down.
Camera orbit(const CameraControls& controls, const Camera& camera, float right, float up);

/// Goes nearer to the pivot (steps > 0) or away from it; ten steps are about a factor of three.
Camera dolly(const CameraControls& controls, const Camera& camera, float steps);

}  // namespace quartet
