#include "renderer/study/stability/uniform_run.h"

#include <algorithm>
#include <array>
#include <limits>

#include "renderer/adaptive/effort.h"
#include "renderer/adaptive/lab.h"
#include "renderer/adaptive/run_lab.h"
#include "renderer/measure/metrics.h"
#include "renderer/study/stability/outcome.h"

namespace quartet {
namespace {

constexpr std::array point_numbers{&UniformRun::Point::mean_spp, &UniformRun::Point::mean_rays,
                                   &UniformRun::Point::regions, &UniformRun::Point::region_energy};

UniformRun::Point point_of(const Lane& lane, const Truth& truth, const PixelRegion& region) {
  const RadianceImage picture = lane.film().image();
  const PassRecord& record = lane.history().back();
  return {mean_spp(record, picture.size()), mean_rays(record, picture.size()),
          metric(MetricId::relmse_regions).compute(picture, *truth.image),
          energy_of(picture, *truth.image, region)};
}

}  // namespace

UniformRun::Point UniformRun::at(double Point::*cost, double value) const {
  const auto after = std::ranges::lower_bound(points_, value, {}, cost);
  Point result;
  const bool reached =
      value > 0.0 && after != points_.end() && (after != points_.begin() || *after.*cost == value);
  for (const auto number : point_numbers) {
    result.*number = std::numeric_limits<double>::quiet_NaN();
  }
  if (!reached) {
    return result;
  }
  if ((*after).*cost == value) {
    return *after;
  }
  const Point& before = *(after - 1);
  const double share = (value - before.*cost) / ((*after).*cost - before.*cost);
  for (const auto number : point_numbers) {
    result.*number = before.*number + share * ((*after).*number - before.*number);
  }
  return result;
}

std::optional<UniformRun> run_uniform(Lab& lab, std::uint32_t spp, const Truth& truth,
                                      const PixelRegion& region, const std::stop_token& stop) {
  LaneSettings settings = default_settings(EstimatorId::uniform);
  settings.max_spp = spp;
  lab.set_lanes(std::span(&settings, 1), {}, truth.image);
  const Lane& lane = lab.lanes().front();
  std::vector<UniformRun::Point> points;
  const bool ended = run_lab(lab, stop, [&] {
    points.push_back(point_of(lane, truth, region));
    return lane.plan().total > 0;
  });
  return ended ? std::optional(UniformRun(std::move(points))) : std::nullopt;
}

}  // namespace quartet
