#pragma once

#include <fmt/format.h>

#include <string>

namespace quartet {

/// A scene file of a ball under a sky, with a film of this size in pixels: done in a moment, also
/// on a machine that has other things to do.
inline std::string ball_scene(int width, int height) {
  return fmt::format(R"(<scene version="3.0.0">
  <integrator type="path"><integer name="max_depth" value="2"/></integrator>
  <sensor type="perspective">
    <transform name="to_world"><lookat origin="0, 0, 4" target="0, 0, 0" up="0, 1, 0"/></transform>
    <film type="hdrfilm"><integer name="width" value="{}"/><integer name="height" value="{}"/>
      <rfilter type="box"/></film>
  </sensor>
  <shape type="sphere"><bsdf type="diffuse"/></shape>
  <emitter type="constant"/>
</scene>
)",
                     width, height);
}

}  // namespace quartet
