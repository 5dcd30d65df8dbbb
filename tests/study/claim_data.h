#pragma once

#include "renderer/study/claims.h"

namespace quartet::test {

/// Every number another: of the region r, the criterion c and the seed k.
inline ClaimData numbered_claim_data() {
  ClaimData data;
  data.pixels.assign(regions().size(), 100);
  for (std::size_t k = 0; k < 2; ++k) {
    ClaimSeed seed;
    seed.lowest_correlation = k == 0 ? 0.25 : 0.75;
    seed.highest_with_contrast = k == 0 ? 0.5 : 0.125;
    for (std::size_t c = 0; c < report_criterion_count; ++c) {
      const double factor = (k == 0 ? 1.0 : 3.0) * double(c + 1);
      ClaimRun& run = seed.runs[c];
      for (std::size_t r = 0; r < regions().size(); ++r) {
        run.spp.push_back(factor * double(r * r + 10));
        run.share.push_back(0.01 * double(r + 1));
      }
      run.lit_spp = 8.0 * factor;
      run.mean_spp = (k == 0 ? 2.0 : 4.0) * double(10 - c);
      run.seconds = 1.0 + double(c);
      run.relmse = factor;
      run.uniform_relmse = 4.0;
      run.relmse_top = 0.05 * factor;
      run.flip = 2.0 * factor;
      run.energy = -0.01 * factor;
      run.uniform_flip = 32.0;
      run.firefly = {7, 5.0 * factor, 2.0 * factor};
    }
    data.seeds.push_back(seed);
  }
  return data;
}

}  // namespace quartet::test
