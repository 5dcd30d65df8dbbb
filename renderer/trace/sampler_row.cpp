#include "renderer/trace/sampler_row.h"

#include <array>

#include "renderer/base/table.h"

namespace quartet {
namespace {

constexpr std::array sampler_table{
    SamplerRow{SamplerId::sobol, "sobol", "Sobol",
               "padded Sobol pairs, one Owen scrambling a pixel (Burley 2020): least noise", false,
               "s²/n, as if samples were independent: the variance of the mean lies below it, "
               "mostly far, and one scrambled sequence does not tell how far",
               "VarianceIfIndependent"},
    SamplerRow{SamplerId::independent, "independent", "independent",
               "plain random numbers, as in the papers and the 2021 report: most noise", true,
               "s²/n, an unbiased estimate of the variance of the pixel mean", "Variance"},
    SamplerRow{SamplerId::replicated, "replicated", "replicated",
               "samples dealt out in turn to 4 independently scrambled Sobol sequences (Owen 1997)",
               true,
               "from the means of the 4 sequences, an unbiased estimate of the variance of the "
               "pixel mean",
               "Variance"},
};
static_assert(sampler_replicates == 4, "the texts above say so");

}  // namespace

std::span<const SamplerRow> samplers() {
  return sampler_table;
}

const SamplerRow& sampler_row(SamplerId key) {
  return row_of(samplers(), key);
}

const SamplerRow& find_sampler(std::string_view id) {
  return find_row(samplers(), id, "sampler");
}

}  // namespace quartet
