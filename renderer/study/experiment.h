#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "renderer/adaptive/effort.h"
#include "renderer/adaptive/lab.h"
#include "renderer/measure/metrics.h"
#include "renderer/measure/stop_conditions.h"

namespace quartet {

/// A lane at the end of a pass, measured.
struct Measurement {
  PassRecord record;
  double mean_spp = 0.0;
  double mean_rays = 0.0;      ///< a pixel
  std::vector<double> values;  ///< of the metrics that were asked for, in their order
  double energy = 0.0;         ///< energy_error(), where any metric was asked for
  /// relmse_top_share(), where relMSE was asked for.
  double relmse_top = std::numeric_limits<double>::quiet_NaN();
};

/// What it took: a pixel, but for seconds.
double effort_of(Effort effort, const Measurement& run);

/// At which passes a run is measured; at its end it always is.
enum class MeasureAt { end, powers_of_two, every_pass };

/// How one lane is run.
struct RunPlan {
  LaneSettings settings;
  StopConditions stop;                 ///< the run ends after the first pass where one holds
  std::vector<MetricId> metrics = {};  ///< none: only what a run costs is measured
  /// Before the end it is measured in so many of them alone, the first ones.
  std::size_t metrics_on_the_way = std::numeric_limits<std::size_t>::max();
  MeasureAt measure_at = MeasureAt::end;
  std::vector<std::uint32_t> also_at = {};  ///< further passes where it is measured, rising
  /// Called with the picture whenever it is measured; may be empty.
  std::function<void(std::uint32_t pass, const RadianceImage& image)> each_picture = {};
};

/// Runs lanes one after the other over one store of samples, so that a run costs little but for the
/// samples that no earlier run took: sweeps, bisections and comparisons are replays. What a run
/// gives does not depend on the runs before it, but for the measured seconds.
class Experiment {
 public:
  /// `reference`, as large as the picture, may be null if no run is measured, stops at an error or
  /// has an estimator that looks at it.
  Experiment(SampleSource source, int width, int height, const LabOptions& options,
             std::shared_ptr<const RadianceImage> reference = nullptr);

  /// The measurements of a run, in the order of their passes; the last one is that of its end.
  /// Nothing if `stop` ended it early. `progress`, if any, is told after each pass how much of the
  /// run is done. Throws std::invalid_argument if it needs a reference and there is none, or if
  /// nothing would ever end it.
  std::optional<std::vector<Measurement>> run(const RunPlan& plan, std::stop_token stop = {},
                                              const std::function<void(double)>& progress = {});

  /// The first samples of every pixel with their variances, out of the store as far as it has them.
  Film first_samples(std::uint32_t spp) const;

  /// As the last run left it.
  const Lane& lane() const { return lab_.lanes().front(); }
  const SampleStore& store() const { return lab_.store(); }
  const RadianceImage* reference() const { return reference_.get(); }
  int width() const { return lab_.width(); }
  int height() const { return lab_.height(); }

  /// Samples that all runs together have used; that they were traced once is what saves time.
  std::uint64_t samples_used() const { return samples_used_; }
  /// Of those, pilots' included, the ones that were traced.
  std::uint64_t samples_traced() const {
    return lab_.store().traced() + (lab_.pilot_store() ? lab_.pilot_store()->traced() : 0);
  }
  /// Whether samples were forgotten, and some traced again.
  bool partial() const { return lab_.partial(); }

 private:
  Measurement measure(const RunPlan& plan, bool is_end) const;

  std::shared_ptr<const RadianceImage> reference_;
  SampleSource source_;
  Lab lab_;
  std::uint64_t samples_used_ = 0;
};

}  // namespace quartet
