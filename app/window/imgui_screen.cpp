#include "app/window/imgui_screen.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <array>
#include <stdexcept>

#include "ui/widgets/imgui_compat.h"
#include "ui/widgets/theme.h"

namespace quartet {
namespace {

constexpr const char* shading_language = "#version 330 core";

}  // namespace

ImguiScreen::ImguiScreen() : context_(ImGui::CreateContext()) {
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().LogFilename = nullptr;
  if (!ImGui_ImplOpenGL3_Init(shading_language)) {
    ImGui::DestroyContext(context_);
    throw std::runtime_error("Dear ImGui cannot draw with this OpenGL; 3.3 or newer is needed");
  }
}

ImguiScreen::~ImguiScreen() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(context_);
}

void ImguiScreen::forget_fonts() {
  // Every Dear ImGui from 1.86 on can do this. ImGui_ImplOpenGL3_DestroyDeviceObjects() would be
  // less, but 1.86 then fills its new buffers as if they had the size of the old ones, and nothing
  // is drawn until a frame has more vertices than all before. What worked once works again.
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplOpenGL3_Init(shading_language);
}

void ImguiScreen::begin_frame() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  give_tiny_corners_pieces();
}

void ImguiScreen::end_frame(const GlFunctions& gl, int width, int height) {
  ImGui::Render();
  gl.viewport(0, 0, width, height);
  const std::array<float, 4> color = clear_color();
  gl.clear_color(color[0], color[1], color[2], color[3]);
  gl.clear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace quartet
