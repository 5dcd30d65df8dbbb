#include "ui/paper/figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "renderer/files/png.h"
#include "tests/files/temp_folder.h"
#include "ui/paper/figure_layout.h"

namespace quartet {
namespace {

DisplayImage gradient(int width, int height, int seed) {
  DisplayImage image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y) = {std::uint8_t(x * 255 / width), std::uint8_t(y * 255 / height),
                        std::uint8_t(60 * seed), 255};
    }
  }
  return image;
}

Figure four_panels(int width, int height) {
  Figure figure;
  figure.title = "cornell-checker · 15 passes";
  const char* titles[] = {"Mitchell contrast", "Kullback–Leibler (√KL)", "√χ²",
                          "Hellinger ≤ σ → ×"};
  for (int i = 0; i < 4; ++i) {
    figure.panels.push_back({gradient(width, height, i),
                             titles[i],
                             {"threshold 0.005 · mean 31.0 spp · max 71 spp · 4.7 s"},
                             {}});
  }
  figure.footer = "quartet figure scenes/cornell-checker.xml --passes 15 --out out";
  return figure;
}

Figure with_long_texts() {
  Figure figure = four_panels(480, 270);
  for (FigurePanel& panel : figure.panels) {
    for (int i = 0; i < 4; ++i) {
      panel.title += " and a title far too long for its panel";
    }
    panel.lines.emplace_back(300, 'W');
    panel.bar = ColorBar{{8, 71, ColorMapId::report}, std::string(200, 'W'), std::string(200, 'M')};
  }
  figure.title = std::string(500, 'M') + " \xff broken \xe2\x82 bytes\nand a new line";
  for (int i = 0; i < 9; ++i) {
    figure.footer += figure.footer.substr(0, 300);
  }
  return figure;
}

std::vector<Figure> lab_figures() {
  std::vector<Figure> all{four_panels(480, 270), four_panels(64, 36), four_panels(500, 40),
                          with_long_texts()};
  all.push_back(four_panels(480, 270));
  all.back().columns = 4;
  all.back().shared_bar =
      ColorBar{{0, 71, ColorMapId::turbo}, "samples per pixel", "at the maximum"};
  Figure mixed;  // different sizes, an incomplete row, no text at all
  mixed.panels = {{gradient(40, 300, 1), "", {}, {}},
                  {gradient(100, 100, 2), "", {}, ColorBar{{5, 5, ColorMapId::viridis}, "", ""}},
                  {gradient(1, 1, 3), "", {}, {}}};
  all.push_back(mixed);
  return all;
}

bool panels_overlap(const Rect& a, const Rect& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

std::vector<Rect> text_boxes(const FigureLayout& layout) {
  std::vector<Rect> boxes;
  for (const auto* texts : {&layout.titles, &layout.texts}) {
    for (const PlacedText& text : *texts) {
      boxes.push_back(text.box);
    }
  }
  return boxes;
}

TEST(FigureLayout, NothingOverlapsNorLeavesThePage) {
  for (const Figure& figure : lab_figures()) {
    const FigureLayout layout = lay_out(figure);
    std::vector<Rect> boxes = text_boxes(layout);
    for (const PlacedImage& image : layout.images) {
      boxes.push_back(image.box);
    }
    for (const PlacedColors& bar : layout.bars) {
      boxes.push_back(bar.box);
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      EXPECT_GE(boxes[i].x, 10);
      EXPECT_GE(boxes[i].y, 10);
      EXPECT_LE(boxes[i].right(), layout.width - 10);
      EXPECT_LE(boxes[i].bottom(), layout.height - 10);
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(panels_overlap(boxes[i], boxes[j])) << i << ' ' << j;
      }
    }
  }
}

TEST(FigureLayout, SmallPicturesAreEnlargedByAWholeFactor) {
  for (const auto& [width, factor] : {std::pair{64, 8}, {480, 1}, {300, 2}, {960, 1}, {479, 2}}) {
    const Figure figure = four_panels(width, width / 2);
    EXPECT_EQ(lay_out(figure).images.at(0).box.width, width * factor);
  }
}

TEST(FigureLayout, ShortTextsStayWhole) {
  const Figure figure = four_panels(64, 36);
  const FigureLayout layout = lay_out(figure);
  ASSERT_EQ(layout.titles.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(layout.titles[i].text, figure.panels[i].title);
    EXPECT_EQ(std::ranges::count(layout.texts, figure.panels[i].lines[0], &PlacedText::text), 4);
  }
  EXPECT_EQ(layout.titles[0].style.size, layout.titles[3].style.size);
}

TEST(FigureLayout, TextsTooLongEndInAnEllipsis) {
  const Figure figure = with_long_texts();
  const FigureLayout layout = lay_out(figure);
  const auto cut = [](const PlacedText& text) { return text.text.ends_with("…"); };
  EXPECT_GE(std::ranges::count_if(layout.texts, cut), 4);
  for (const PlacedText& text : layout.texts) {
    EXPECT_EQ(text.text.find('\n'), std::string::npos);
    EXPECT_EQ(text.text.find('\xff'), std::string::npos);
  }
}

TEST(FigurePng, HoldsEachPictureUnchangedAndInkOnlyInsideTheBoxes) {
  const TempFolder folder;
  for (const Figure& figure : lab_figures()) {
    write_figure_png(figure, folder / "a.png");
    const DisplayImage page = read_png(folder / "a.png");
    const FigureLayout layout = lay_out(figure);
    ASSERT_EQ(page.width(), layout.width);
    ASSERT_EQ(page.height(), layout.height);

    for (const PlacedImage& placed : layout.images) {
      const int factor = int(placed.box.width) / placed.image->width();
      int different = 0;
      for (int y = 0; y < placed.box.height; ++y) {
        for (int x = 0; x < placed.box.width; ++x) {
          different += page.at(int(placed.box.x) + x, int(placed.box.y) + y) !=
                       placed.image->at(x / factor, y / factor);
        }
      }
      EXPECT_EQ(different, 0);
    }

    // Whatever is neither picture, bar, mark nor text is paper; 2 pixels for hairlines and for
    // letters that hang over their advance.
    Image<std::uint8_t> allowed(page.width(), page.height(), 0);
    const auto allow = [&](const Rect& box) {
      for (int y = std::max(0, int(box.y) - 2); y < std::min(page.height(), int(box.bottom()) + 3);
           ++y) {
        for (int x = std::max(0, int(box.x) - 2); x < std::min(page.width(), int(box.right()) + 3);
             ++x) {
          allowed.at(x, y) = 1;
        }
      }
    };
    std::ranges::for_each(text_boxes(layout), allow);
    for (const PlacedImage& image : layout.images) allow(image.box);
    for (const PlacedColors& bar : layout.bars) allow(bar.box);
    for (const PlacedFill& fill : layout.fills) allow(fill.box);
    int stray = 0;
    for (std::size_t i = 0; i < page.size(); ++i) {
      stray += allowed.pixels()[i] == 0 && page.pixels()[i] != Rgba8{255, 255, 255, 255};
    }
    EXPECT_EQ(stray, 0);
  }
}

TEST(FigurePng, TitlesAreInk) {
  const TempFolder folder;
  const Figure figure = four_panels(480, 270);
  write_figure_png(figure, folder / "a.png");
  const DisplayImage page = read_png(folder / "a.png");
  const FigureLayout layout = lay_out(figure);
  ASSERT_EQ(layout.titles.size(), 4u);
  for (const PlacedText& title : layout.titles) {
    int dark = 0;
    for (int y = int(title.box.y); y < int(title.box.bottom()); ++y) {
      for (int x = int(title.box.x); x < int(title.box.right()); ++x) {
        dark += page.at(x, y).g < 100;
      }
    }
    EXPECT_GT(dark, 0.04 * title.box.width * title.box.height) << title.text;
  }
}

TEST(FigurePng, TheBarRunsFromTheColourOfMinToThatOfMax) {
  const TempFolder folder;
  Figure figure = four_panels(480, 270);
  figure.shared_bar = ColorBar{{0, 71, ColorMapId::turbo}, "samples per pixel", "at the maximum"};
  write_figure_png(figure, folder / "a.png");
  const DisplayImage page = read_png(folder / "a.png");
  const FigureLayout layout = lay_out(figure);
  ASSERT_EQ(layout.bars.size(), 1u);
  const Rect bar = layout.bars[0].box;
  const int y = int(bar.y + bar.height / 2);
  EXPECT_EQ(page.at(int(bar.x), y), sample(ColorMapId::turbo, 0.0f));
  EXPECT_EQ(page.at(int(bar.right()) - 1, y), sample(ColorMapId::turbo, 1.0f));
  for (const char* text : {"samples per pixel", "at the maximum", "0", "71"}) {
    EXPECT_EQ(std::ranges::count(layout.texts, text, &PlacedText::text), 1) << text;
  }
}

TEST(FigureFiles, AreTheSameBytesTwice) {
  const TempFolder folder;
  const Figure figure = four_panels(64, 36);
  for (const auto write : {write_figure_png, write_figure_pdf}) {
    write(figure, folder / "a");
    write(figure, folder / "b");
    EXPECT_EQ(bytes_of(folder / "a"), bytes_of(folder / "b"));
  }
}

TEST(FigurePdf, EmbedsPicturesWithoutLossAndFonts) {
  const TempFolder folder;
  write_figure_pdf(four_panels(480, 270), folder / "a.pdf");
  const std::string pdf = bytes_of(folder / "a.pdf");
  EXPECT_TRUE(pdf.starts_with("%PDF-"));
  EXPECT_NE(pdf.find("%%EOF"), std::string::npos);
  EXPECT_NE(pdf.find("/Width 480"), std::string::npos);
  EXPECT_NE(pdf.find("/Height 270"), std::string::npos);
  EXPECT_EQ(pdf.find("DCTDecode"), std::string::npos);  // no JPEG
  EXPECT_EQ(pdf.find("/Interpolate true"), std::string::npos);
  EXPECT_NE(pdf.find("/FontFile"), std::string::npos);
  // Not the time of writing; newer versions of Cairo may compress the entry.
  EXPECT_EQ(pdf.find("/CreationDate") == std::string::npos,
            pdf.find("20000101000000Z") == std::string::npos);
}

TEST(FigureSvg, IsSvg) {
  const TempFolder folder;
  write_figure_svg(four_panels(64, 36), folder / "a.svg");
  const std::string svg = bytes_of(folder / "a.svg");
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(FigureFiles, AFullDiskAndAMissingFolderAreErrors) {
  const Figure figure = four_panels(64, 36);
  for (const auto write : {write_figure_png, write_figure_pdf, write_figure_svg}) {
    EXPECT_EQ(error_of([&] { write(figure, "/dev/full"); }),
              "cannot write /dev/full: No space left on device");
    EXPECT_EQ(error_of([&] { write(figure, "/nowhere/a"); }),
              "cannot write /nowhere/a: No such file or directory");
  }
}

TEST(FigurePng, RefusesWhatCairoCannotHold) {
  Figure figure = four_panels(20000, 2);
  const std::string error = error_of([&] { write_figure_png(figure, "/nowhere/a.png"); });
  EXPECT_NE(error.find("/nowhere/a.png"), std::string::npos) << error;
  EXPECT_NE(error.find("too large"), std::string::npos) << error;
}

}  // namespace
}  // namespace quartet
