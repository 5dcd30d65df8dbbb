#include "ui/widgets/theme.h"

#include <gtest/gtest.h>

#include "ui/widgets/imgui_compat.h"

namespace quartet {
namespace {

/// Every sign that the window writes beyond ASCII.
constexpr const char16_t* signs = u"σχ√≤→×·²⁻¹³–…∞−";

class ThemeTest : public testing::Test {
 protected:
  ThemeTest() : context_(ImGui::CreateContext()) { ImGui::GetIO().IniFilename = nullptr; }
  ~ThemeTest() override { ImGui::DestroyContext(context_); }

  static void expect_signs(const Ui& ui) {
    for (ImFont* const font : {ui.body, ui.bold, ui.small}) {
      ASSERT_NE(font, nullptr);
      for (const char16_t* sign = signs; *sign; ++sign) {
        EXPECT_TRUE(has_glyph(font, ImWchar(*sign))) << "U+" << std::hex << unsigned(*sign);
      }
    }
  }

  static float width_of_text(const Ui& ui) {
    return ui.body->CalcTextSizeA(font_size(ui.body), FLT_MAX, 0.0f, "Kullback").x;
  }

  /// Fonts are laid out when their texture is; a frame without a display does it.
  static void bake() {
#if IMGUI_VERSION_NUM < 19200
    ImGui::GetIO().Fonts->Build();
#endif
  }

 private:
  ImGuiContext* context_;
};

TEST_F(ThemeTest, HasEverySignWithInterAndWithoutIt) {
  Ui with;
  set_theme(with, 1.0f);
  bake();
  expect_signs(with);
  const float width = width_of_text(with);
  FontFolders folders;
  folders.inter = "/nowhere";
  Ui without;
  set_theme(without, 1.0f, folders);
  bake();
  expect_signs(without);
  EXPECT_NE(width_of_text(without), width) << "DejaVu is another font";
}

TEST_F(ThemeTest, WithoutAnyFontOfTheSystemThereIsStillText) {
  Ui ui;
  set_theme(ui, 1.0f, {"/nowhere", "/nowhere"});
  bake();
  for (ImFont* const font : {ui.body, ui.bold, ui.small}) {
    ASSERT_NE(font, nullptr);
    EXPECT_TRUE(has_glyph(font, ImWchar('a')));
  }
}

}  // namespace
}  // namespace quartet
