#pragma once

#include "renderer/measure/metrics.h"

namespace quartet {

// Each is what its file ends in; row_of_metric() in metrics.cpp knows which is whose.
extern const Metric mse_metric;
extern const Metric rmse_metric;
extern const Metric relmse_metric;
extern const Metric relmse_trimmed_metric;
extern const Metric relmse_regions_metric;
extern const Metric mape_metric;
extern const Metric smape_metric;
extern const Metric psnr_metric;
extern const Metric flip_metric;

}  // namespace quartet
