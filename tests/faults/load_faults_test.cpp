// Whatever fails while files are read: an error, or what is in them.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/window/config_file.h"
#include "renderer/files/exr.h"
#include "renderer/files/picture.h"
#include "renderer/files/png.h"
#include "renderer/measure/reference/reference_render.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/scene_hash.h"
#include "tests/faults/fault_cases.h"

namespace quartet {
namespace {

constexpr const char* mesh_scene = R"(<scene version="3.0.0">
  <sensor type="perspective"><float name="fov" value="40"/></sensor>
  <emitter type="constant"/>
  <shape type="obj"><string name="filename" value="mesh.obj"/><bsdf type="diffuse"/></shape>
</scene>
)";
constexpr const char* mesh = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

std::string digest(const ExrImage& image) {
  std::string text;
  for (const ExrChannel& channel : image.channels) {
    text += channel.name;
    if (const auto* floats = std::get_if<std::vector<float>>(&channel.pixels)) {
      for (const float value : *floats) {
        text += fmt::format(" {}", value);
      }
    }
  }
  return text;
}

std::string digest(const Picture& picture) {
  std::string text = picture.layer;
  for (const glm::vec3 c : picture.image.pixels()) {
    text += fmt::format(" {} {} {}", c.r, c.g, c.b);
  }
  for (const std::string& note : picture.notes) {
    text += " " + note;
  }
  return text;
}

/// A kind of file: how it is made, and how it is read into words.
struct LoadKind {
  const char* name;
  std::function<void(const TempFolder&)> make;
  std::function<std::string(const TempFolder&)> read;
};

std::vector<LoadKind> loads() {
  return {
      {"EXR",
       [](const TempFolder& folder) {
         ExrImage image(30, 20);
         image.add("Y", std::vector<float>(600, 0.5f));
         image.add("Z", std::vector<float>(600, 1.5f));
         write_exr(folder / "a.exr", image);
       },
       [](const TempFolder& folder) { return digest(read_exr(folder / "a.exr")); }},
      {"PNG", [](const TempFolder& folder) { write_png(folder / "a", DisplayImage(5, 4)); },
       [](const TempFolder& folder) { return digest(read_picture(folder / "a")); }},
      {"PFM",
       [](const TempFolder& folder) {
         write_bytes_to(folder / "a", "Pf\n2 1\n-2\n" + std::string(8, '?'));
       },
       [](const TempFolder& folder) { return digest(read_picture(folder / "a")); }},
      {"HDR",
       [](const TempFolder& folder) {
         write_bytes_to(folder / "a",
                        "#?RADIANCE\nEXPOSURE=2\n\n-Y 1 +X 2\n" + std::string(8, '?'));
       },
       [](const TempFolder& folder) { return digest(read_picture(folder / "a")); }},
      {"layers",
       [](const TempFolder& folder) {
         ExrImage image(3, 2);
         for (const char* name : {"a.R", "a.G", "a.B", "b.Z"}) {
           image.add(name, std::vector<float>(6, 0.5f));
         }
         write_exr(folder / "a", image);
       },
       [](const TempFolder& folder) { return digest(read_picture(folder / "a")); }},
      {"scene",
       [](const TempFolder& folder) {
         write_bytes_to(folder / "scene.xml", mesh_scene);
         write_bytes_to(folder / "mesh.obj", mesh);
       },
       [](const TempFolder& folder) { return scene_hash(load_scene(folder / "scene.xml")); }},
      {"settings",
       [](const TempFolder& folder) {
         LabState state = initial_state();
         state.scene = "veach-plates";
         save_config(folder / "settings.json", state, {1000, 700});
       },
       [](const TempFolder& folder) {
         LabState state = initial_state();
         WindowMemory memory;
         const std::string complaint = load_config(folder / "settings.json", state, memory);
         if (!complaint.empty()) {
           EXPECT_EQ(state.scene, LabState().scene);
           throw std::runtime_error(complaint);
         }
         return fmt::format("{} {}", state.scene, memory.width);
       }},
      {"reference",
       [](const TempFolder& folder) {
         const auto scene =
             std::make_shared<const TraceScene>(load_scene(find_scene("cornell-box")));
         RenderSettings small = default_settings(scene->scene());
         small.width = 8;
         small.height = 6;
         ReferenceRender render(scene, small);
         render.add(2);
         write_exr(folder / "a.exr", exr_of(render.sums(), "quartet"));
       },
       [](const TempFolder& folder) {
         const auto reference = load_reference(folder / "a.exr");
         return fmt::format("{} {} {}", reference->spp, reference->scene_hash,
                            reference->image.at(3, 3).x);
       }},
  };
}

class LoadFaults : public testing::TestWithParam<std::size_t> {
 protected:
  LoadFaults() {
    kind_.make(folder_);
    right_ = kind_.read(folder_);
  }

  void work() { read_ = kind_.read(folder_); }
  void judge(const test::FaultOutcome& outcome) {
    if (outcome.error.empty() && !read_.empty()) {
      EXPECT_EQ(read_, right_);
    }
    read_.clear();
  }

  LoadKind kind_ = loads()[GetParam()];
  TempFolder folder_;
  std::string right_, read_;
};

TEST_P(LoadFaults, AnyCallThatFailsIsAnErrorOrChangesNothing) {
  test::fail_each_call([&] { work(); }, 1,
                       [&](const test::FaultOutcome& outcome) { judge(outcome); });
}

TEST_P(LoadFaults, AnyAllocationThatFailsIsAnErrorOrChangesNothing) {
  // A child's words are its own.
  test::fail_each_allocation([&] { work(); }, 1, std::string(kind_.name) == "settings",
                             [&](const test::FaultOutcome& outcome) { judge(outcome); });
}

INSTANTIATE_TEST_SUITE_P(All, LoadFaults, testing::Range(std::size_t(0), loads().size()),
                         [](const auto& test) { return std::string(loads()[test.param].name); });

}  // namespace
}  // namespace quartet
