#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "renderer/base/image.h"

namespace quartet {

enum class MetricId { mse, rmse, relmse, relmse_trimmed, relmse_regions, mape, smape, psnr, flip };

/// What a metric's numbers are. How they change with samples at random follows from it, and on
/// which axis they are read.
enum class MetricScale {
  error,          ///< falls as 1/√samples
  squared_error,  ///< falls as 1/samples
  /// −10 log10 of a squared error: grows by 10 with ten times the samples. It is a logarithm
  /// already, of which there are neither ratios nor a logarithm worth an axis.
  decibels,
};

/// One row of the table of metrics: how far a picture is from a reference, as one number. Chart
/// axes, command line, file columns and tests walk the table. x is the test, r the reference, both
/// linear radiance; each mean is over all pixels and channels.
struct Metric {
  MetricId key;
  std::string_view id;          ///< on the command line and in files
  std::string_view label;       ///< for people
  std::string_view unit;        ///< empty for pure numbers
  std::string_view definition;  ///< with its constants
  MetricScale scale;
  bool higher_is_better = false;
  /// A pixel's error also depends on its neighbours; the metric is the mean of its map.
  bool looks_around = false;
  /// Its noise floor is told by the halves of a reference alone, whatever the truth:
  /// Reference::noise_floor().
  bool floor_by_halves = false;
  /// The metric. Does not depend on the number of threads; runs on those of the current TBB arena.
  /// Throws std::invalid_argument if the sizes differ, a picture is empty, or a pixel that is not
  /// finite makes the metric meaningless (with its place).
  double (*compute)(const RadianceImage& test, const RadianceImage& reference);
  /// Where the error is: a number a pixel, whose mean is the metric, or from whose mean the metric
  /// is made (rmse: its root; psnr: its decibels; relmse_trimmed: without the largest). Throws as
  /// above.
  ScalarImage (*map)(const RadianceImage& test, const RadianceImage& reference);
  std::string_view map_quantity;  ///< what `map` holds, with its unit
  /// Of a mean of squares of what is linear in x: the numbers that are squared, as many of every
  /// picture of a size, so that the metric can be split into bias² and variance (ErrorSums). Null
  /// for others. Throws as above.
  std::vector<float> (*errors)(const RadianceImage& test, const RadianceImage& reference) = nullptr;
};

/// Where nobody chose one: neither a clamp nor stopping early wins in it, because what they lose in
/// noise is less than what they lose in light. In relMSE both win by far.
inline constexpr MetricId default_metric = MetricId::relmse_regions;

std::span<const Metric> metrics();
const Metric& metric(MetricId key);
/// Throws std::invalid_argument that lists the legal ids.
const Metric& find_metric(std::string_view id);

/// How many times better `value` is than `than`, both of this metric: the ratio of the errors; of
/// decibels that of the squared errors that they stand for.
double times_better(const Metric& row, double value, double than);

/// Error that a second buys: 1/(mse · seconds). Does not depend on how long a method ran, as long
/// as its error falls as 1/samples. Infinite where either is 0.
double efficiency(double mse, double seconds);

/// Throws std::invalid_argument unless both pictures have the same size, and some.
void require_same_size(const RadianceImage& test, const RadianceImage& reference);
/// Throws std::invalid_argument with the place of the first pixel that is NaN or infinite; `what`
/// names the picture.
void require_finite(const RadianceImage& image, std::string_view what);

}  // namespace quartet
