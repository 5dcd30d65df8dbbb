#pragma once

#include <string>
#include <vector>

#include "app/options/run_options.h"
#include "renderer/files/staged_files.h"
#include "renderer/study/needs/needs.h"

namespace quartet {

/// Everything that the measurement of what a picture needs is written with.
struct NeedsReport {
  const Run& run;
  const NeedsPlan& plan;
  const NeedsResult& result;
  std::string command_line;
};

/// The names of what write_needs_files writes in any case: the meshes of the smallest model have
/// names that begin as that of its scene.
inline std::vector<std::string> needs_file_names() {
  return {"needs.csv", "needs.json", "needs.png", "needs.pdf", "needs.svg", "smallest.xml"};
}

/// The smallest model in a sentence: what was taken out of the whole one, how far off its picture
/// is, and what that saves.
std::string needs_sentence(const NeedsReport& report);

/// A table with one row a smaller model, what is the same picture in the mean in words, and the
/// smallest model in a sentence.
std::string needs_text(const NeedsReport& report);
std::string needs_json(const NeedsReport& report);
/// Long form, one row a number: scene, sampler, spp, seeds, part, model, need, metric, value, low,
/// high. Of the whole model and, as the last, of the smallest one `part` and `need` are empty.
std::string needs_csv(const NeedsReport& report);

/// needs.csv, needs.json, the chart as needs.png, .pdf and .svg, and the smallest model as
/// smallest.xml with its meshes.
void write_needs_files(StagedFiles& files, const NeedsReport& report);

}  // namespace quartet
