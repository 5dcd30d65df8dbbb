#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <string_view>

#include "app/commands/commands.h"
#include "app/options/number_option.h"
#include "app/options/run_options.h"
#include "app/options/usage_error.h"
#include "renderer/scene/synthetic.h"
#include "renderer/trace/path_log.h"
#include "renderer/trace/store/running_mean.h"

namespace quartet {
namespace {

struct TraceOptions {
  RunOptions run;
  std::vector<int> pixel;
  std::uint32_t index = 0;
};

std::string numbers_text(glm::vec3 v) {
  return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z);
}

std::string_view reason(PathEnd end) {
  constexpr std::array reasons{"it left the scene", "it has as many segments as it may have",
                               "the material sends nothing on",
                               "its direction would leak through the shading surface",
                               "Russian roulette"};
  return reasons[std::size_t(end)];
}

std::string surface_text(const Scene& scene, const Surface& surface) {
  const Shape& shape = scene.shapes[surface.shape];
  const Material& material = scene.materials[std::size_t(shape.material)];
  std::string text = fmt::format("shape {}", surface.shape);
  text +=
      shape.id.empty() ? fmt::format(" of line {}", shape.line) : fmt::format(" '{}'", shape.id);
  if (std::holds_alternative<Mesh>(shape.geometry)) {
    text += fmt::format(", triangle {}", surface.primitive);
  }
  text += fmt::format(", {}", material_name(material));
  return material.id.empty() ? text : fmt::format("{} '{}'", text, material.id);
}

void print_vertex(const Scene& scene, std::size_t number, const PathVertex& vertex) {
  if (vertex.surface) {
    const Surface& surface = *vertex.surface;
    fmt::print("{:>2}  {}\n", number, surface_text(scene, surface));
    fmt::print("    position   {}, {:.6g} from the vertex before\n", numbers_text(surface.position),
               vertex.distance);
    fmt::print("    normal     {}\n", numbers_text(surface.normal));
    if (surface.shading_normal != surface.normal) {
      fmt::print("    shading    {}\n", numbers_text(surface.shading_normal));
    }
  } else {
    fmt::print("{:>2}  nothing: the environment\n", number);
  }
  fmt::print("    throughput {}\n", numbers_text(vertex.throughput));
  if (vertex.emitted) {
    fmt::print("    shines     {}, weight {:.6g}: + {}\n", numbers_text(vertex.emitted->radiance),
               vertex.emitted->weight, numbers_text(vertex.emitted->contribution));
  }
  if (vertex.direct) {
    const DirectLight& direct = *vertex.direct;
    fmt::print("    light      {} towards {}\n", numbers_text(direct.light.radiance),
               numbers_text(direct.light.direction));
    fmt::print(
        "               {:.6g} away, density {:.6g}/sr, of the BSDF {:.6g}/sr, weight {:.6g}: + "
        "{}\n",
        direct.light.distance, direct.light.pdf, direct.bsdf.pdf, direct.weight,
        numbers_text(direct.contribution));
  } else if (vertex.light_sampled) {
    fmt::print("    light      hidden\n");
  }
  if (vertex.scattered) {
    const BsdfSample& scattered = *vertex.scattered;
    fmt::print("    goes on    {}, {}, weight {}\n", numbers_text(vertex.direction),
               scattered.specular ? std::string("specular")
                                  : fmt::format("density {:.6g}/sr", scattered.pdf),
               numbers_text(scattered.weight));
  }
  if (vertex.survival) {
    fmt::print("    roulette   survives with probability {:.6g}\n", *vertex.survival);
  }
}

void check_pixel(const TraceOptions& options, const RenderSettings& settings) {
  const int x = options.pixel[0];
  const int y = options.pixel[1];
  if (x < 0 || x >= settings.width || y < 0 || y >= settings.height) {
    throw UsageError(
        fmt::format("--pixel: {},{} is outside the picture; from 0,0 to {},{} there "
                    "are pixels",
                    x, y, settings.width - 1, settings.height - 1));
  }
}

void run_trace(const TraceOptions& options) {
  const Run run = prepare_run(options.run, 0);
  check_pixel(options, run.settings);
  const int x = options.pixel[0];
  const int y = options.pixel[1];
  glm::vec3 sample(0.0f);
  sample_source(run.scene, run.settings)(x, y, options.index, std::span(&sample, 1));
  const Scene& scene = run.scene->scene();
  fmt::print("sample {} of pixel {},{} of {}, seed {}, ", options.index, x, y, scene.name,
             run.settings.seed);
  if (synthetic_of(scene) == nullptr) {
    const PathLog log = log_path(*run.scene, run.settings, x, y, options.index);
    fmt::print("{}, {}\n", integrator(run.settings.integrator).id,
               sampler_row(run.settings.sampler).id);
    for (std::size_t i = 0; i < log.vertices.size(); ++i) {
      print_vertex(scene, i + 1, log.vertices[i]);
    }
    fmt::print("ends: {}\n", reason(log.end));
    // Bit by bit, because NaN is not equal to itself.
    using Bits = std::array<std::uint32_t, 3>;
    if (std::bit_cast<Bits>(log.radiance) != std::bit_cast<Bits>(sample)) {
      throw std::logic_error(fmt::format("the renderer's sample is {}, the path above gives {}",
                                         numbers_text(sample), numbers_text(log.radiance)));
    }
  } else {
    fmt::print("drawn, not traced\n");
  }
  fmt::print("radiance {:.9g} {:.9g} {:.9g}{}\n", sample.x, sample.y, sample.z,
             acceptable(sample) ? "" : ": rejected, no film takes it");
}

}  // namespace

void add_trace_command(CLI::App& app, const Program&) {
  CLI::App* command = app.add_subcommand("trace", "One sample, vertex by vertex");
  const auto options = std::make_shared<TraceOptions>();
  add_scene_options(*command, options->run);
  add_numbers(*command, "--pixel", options->pixel, {0, most_picture_side},
              "Column and row, X,Y, from 0,0 at the top left")
      ->expected(2)
      ->required();
  add_number(*command, "--index", options->index, {0, most_spp},
             "Which sample of the pixel, from 0");
  command->footer(
      "Examples:\n"
      "  quartet trace cornell-checker --pixel 480,270 --index 3\n"
      "  quartet trace failures/rare-light --pixel 48,32 --index 7 --integrator kajiya");
  command->callback([options] { run_trace(*options); });
}

}  // namespace quartet
