#include "renderer/measure/stop_conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "renderer/adaptive/effort.h"
#include "renderer/base/table.h"

namespace quartet {

double ErrorTarget::progress(double error) const {
  const Metric& row = quartet::metric(metric);
  const double times = times_better(row, error, value);
  return row.scale == MetricScale::error ? times * times : times;
}

ErrorTarget parse_error_target(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) {
    throw std::invalid_argument(fmt::format(
        "'{}' is no error target; write METRIC=VALUE, such as relmse=0.01, with one of the metrics "
        "{}",
        text, row_ids(metrics())));
  }
  ErrorTarget target;
  target.metric = find_metric(text.substr(0, equals)).key;
  const std::string_view digits = text.substr(equals + 1);
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), target.value);
  if (error != std::errc() || end != digits.data() + digits.size() || !(target.value > 0.0) ||
      !std::isfinite(target.value)) {
    throw std::invalid_argument(
        fmt::format("'{}' is no number above 0; write METRIC=VALUE, such as relmse=0.01", digits));
  }
  return target;
}

double StopConditions::progress(const PassRecord& last, std::size_t pixels,
                                double measured_error) const {
  double done = 0.0;
  if (passes) {
    done = std::max(done, double(last.pass) / double(*passes));
  }
  if (spp) {
    done = std::max(done, mean_spp(last, pixels) / *spp);
  }
  if (rays) {
    done = std::max(done, mean_rays(last, pixels) / *rays);
  }
  if (seconds) {
    done = std::max(done, last.seconds / *seconds);
  }
  if (error) {
    done = std::max(done, error->progress(measured_error));
  }
  return done;
}

double StopConditions::progress(const Lane& lane, const RadianceImage* reference) const {
  if (lane.history().empty()) {
    return 0.0;
  }
  if (lane.plan().total == 0) {
    return 1.0;
  }
  double measured_error = 0.0;
  if (error) {
    if (reference == nullptr) {
      throw std::invalid_argument("an error target needs a reference to measure the error");
    }
    measured_error = metric(error->metric).compute(lane.film().image(), *reference);
  }
  return progress(lane.history().back(), lane.film().size(), measured_error);
}

double StopConditions::progress(const LaneSnapshot& lane) const {
  if (lane.history.empty()) {
    return 0.0;
  }
  return lane.plan.total == 0 ? 1.0 : progress_at(lane, lane.history.back());
}

double StopConditions::progress_at(const LaneSnapshot& lane, const PassRecord& record) const {
  StopConditions known = *this;
  if (std::isnan(record.truth.error)) {
    known.error.reset();
  }
  return known.progress(record, lane.taken.size(), record.truth.error);
}

std::optional<std::uint32_t> StopConditions::end_of(const LaneSnapshot& lane) const {
  for (const PassRecord& record : lane.history) {
    const bool nothing_more = lane.plan.total == 0 && record.samples == lane.history.back().samples;
    if (nothing_more || progress_at(lane, record) >= 1.0) {
      return record.pass;
    }
  }
  return std::nullopt;
}

}  // namespace quartet
