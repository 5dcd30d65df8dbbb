#pragma once

#include "renderer/base/math/wide.h"
#include "renderer/trace/sampler.h"

namespace quartet {

/// Eight samplers, one a lane, each giving the numbers of its Sampler. Their vertices may differ.
class Sampler8 {
 public:
  struct Draws {
    Float8 value[Sampler::draws_per_call];
    Float8 operator[](int i) const { return value[i]; }
  };

  Sampler8() = default;
  Sampler8(std::uint64_t seed, Word8 pixel, Word8 index, SamplerId id = SamplerId::sobol)
      : key_(Sampler::sequence_key(id, Sampler::child_key(Sampler::seed_key(seed), pixel), index)),
        reversed_index_(Sampler::reverse_bits(Sampler::index_in_sequence(id, index))) {}

  /// Lane `from` of another.
  void take(int lane, const Sampler8& other, int from) {
    key_[lane] = other.key_[from];
    reversed_index_[lane] = other.reversed_index_[from];
    vertex_[lane] = other.vertex_[from];
  }

  Draws next() {
    vertex_ += 1u;
    const Word8 base = key_ + vertex_ * (Sampler::draws_per_call * 0x9e3779b9u);
    Draws draws;
    for (std::uint32_t pair = 0; pair < 2; ++pair) {
      const std::size_t first = 2 * std::size_t(pair);
      const Word8 pair_key = Sampler::mix(base + (pair * 0x3c6ef372u + 0x5bd1e995u));
      const Word8 shuffled =
          Sampler::reverse_bits(Sampler::laine_karras(reversed_index_, pair_key));
      draws.value[first] = scrambled(shuffled, base + 2 * pair * 0x9e3779b9u);
      draws.value[first + 1] =
          scrambled(Sampler::pascal(shuffled), base + (2 * pair + 1) * 0x9e3779b9u);
    }
    return draws;
  }

  Float8 independent() const {
    return to_float(Sampler::mix(Sampler::mix(key_ + vertex_ * 0x9e3779b9u) ^ reversed_index_));
  }

 private:
  static Float8 scrambled(Word8 sobol, Word8 key) {
    return to_float(Sampler::reverse_bits(Sampler::laine_karras(sobol, Sampler::mix(key))));
  }
  static Float8 to_float(Word8 bits) {
    return __builtin_convertvector(Int8(bits >> 8), Float8) * 0x1p-24f;
  }

  Word8 key_{};
  Word8 reversed_index_{};
  Word8 vertex_ = ~Word8{};
};

}  // namespace quartet
