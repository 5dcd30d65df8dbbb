#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "renderer/trace/store/sample_store.h"

namespace quartet::test {

/// Wishes for samples [begin[p], end[p]) of each pixel p, nothing where begin ≥ end.
inline bool require(SampleStore& store, std::span<const std::uint32_t> begin,
                    std::span<const std::uint32_t> end, const SampleSource& source,
                    std::stop_token stop = {}) {
  std::vector<std::uint16_t> wanted;
  for (std::size_t i = 0; i < begin.size(); ++i) {
    wanted.push_back(std::uint16_t(begin[i] < end[i] ? end[i] - begin[i] : 0));
  }
  const SampleWish wish{begin, wanted};
  return store.require(std::span(&wish, 1), source, std::move(stop));
}

}  // namespace quartet::test
