#include "app/options/view_options.h"

#include <fmt/format.h>

#include "app/options/number_option.h"
#include "app/options/usage_error.h"

namespace quartet {

void add_view_options(CLI::App& command, ViewOptions& options) {
  command.add_option("--heat", options.heat,
                     "Heatmap scale: linked (0 to the highest of all; the default) or report (each "
                     "its own)");
  command.add_option("--tone-map", options.tone_map, "clamp (the default), reinhard or filmic");
  add_number(command, "--exposure", options.exposure, {-100.0f, 100.0f},
             "In stops; 0 if not given");
}

std::string heat_id(HeatRange range) {
  return range == HeatRange::linked ? "linked" : "report";
}

ViewSettings view_settings(const ViewOptions& options) {
  ViewSettings view;
  view.exposure = options.exposure.value_or(view.exposure);
  if (!options.tone_map.empty()) {
    view.tone_map = find_tone_map(options.tone_map).key;
  }
  if (!options.heat.empty() && options.heat != "linked" && options.heat != "report") {
    throw UsageError(
        fmt::format("--heat: unknown scale '{}'; there are: linked, report", options.heat));
  }
  view.heat = options.heat == "report" ? HeatRange::report : HeatRange::linked;
  return view;
}

}  // namespace quartet
