#include "app/records/stop_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "app/terminal/messages.h"
#include "renderer/adaptive/effort.h"
#include "renderer/view/views.h"

namespace quartet {
namespace {

/// "--passes 30 or --spp 64".
std::string conditions_text(const StopConditions& stop) {
  std::vector<std::string> texts;
  if (stop.passes) {
    texts.push_back(fmt::format("--passes {}", *stop.passes));
  }
  if (stop.spp) {
    texts.push_back(fmt::format("--spp {:g}", *stop.spp));
  }
  if (stop.rays) {
    texts.push_back(fmt::format("--rays {:g}", *stop.rays));
  }
  if (stop.seconds) {
    texts.push_back(fmt::format("--seconds {:g}", *stop.seconds));
  }
  if (stop.error) {
    texts.push_back(
        fmt::format("--error {}={:g}", metric(stop.error->metric).id, stop.error->value));
  }
  return fmt::format("{}", fmt::join(texts, " or "));
}

bool is_met(const StopConditions& stop, const Snapshot& snapshot, const LaneSnapshot& lane) {
  const double error =
      stop.error && snapshot.reference
          ? metric(stop.error->metric).compute(radiance_image(snapshot, lane), *snapshot.reference)
          : 0.0;
  return stop.progress(lane.history.back(), snapshot.pixels(), error) >= 1.0;
}

}  // namespace

void tell_if_capped(const CappedPixels& capped, CappedRun run) {
  if (capped.count > 0) {
    tell("{}{}: {} of {} pixels have the {} samples that --max-spp allows",
         estimator(capped.estimator).id,
         run == CappedRun::lane ? "" : ", of all runs the one with most", capped.count,
         capped.pixels, capped.most);
  }
}

void tell_if_short(const Snapshot& snapshot, const StopConditions& given) {
  for (const LaneSnapshot& lane : snapshot.lanes) {
    const CappedPixels capped = capped_pixels(lane.taken, lane.settings);
    if (lane.plan.total == 0 && given.any() && !is_met(given, snapshot, lane)) {
      const PassRecord& last = lane.history.back();
      tell("{} ended after {} passes, at {:.2f} mean spp, before {}: {}",
           estimator(lane.settings.estimator).id, last.pass, mean_spp(last, snapshot.pixels()),
           conditions_text(given),
           capped.count > 0 ? fmt::format("no pixel may have another sample; {} of {} have the {} "
                                          "that --max-spp allows",
                                          capped.count, capped.pixels, capped.most)
                            : "no pixel wants another sample");
    } else {
      tell_if_capped(capped);
    }
  }
}

}  // namespace quartet
