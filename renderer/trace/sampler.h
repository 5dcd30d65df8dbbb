#pragma once

#include <array>
#include <cstdint>

#include "renderer/trace/sampler_row.h"

namespace quartet {

/// Random numbers of one sample: a pure function of (seed, pixel, index, vertex, dimension).
///
/// Every pair of dimensions is a (0,2)-sequence (Sobol's first two dimensions) with its indices
/// shuffled and its values scrambled in Owen's way by a hash: Burley, "Practical Hash-based Owen
/// Scrambling", JCGT 9(4), 2020, with Vegdahl's constants for the Laine-Karras hash. Each 2^k
/// aligned samples of a pixel are a (0, k, 2)-net in every pair; pairs, pixels and seeds are
/// independent.
///
/// That is SamplerId::sobol. The other samplers are the same sequences put to another use, told by
/// the constructor alone: replicated takes samples in turn from some that are scrambled apart, and
/// independent takes but the first point of as many as there are samples.
class Sampler {
 public:
  static constexpr int draws_per_call = 4;

  /// Four numbers in [0, 1). The first two are jointly stratified over the samples of a pixel, and
  /// so are the last two.
  using Draws = float[draws_per_call];

  Sampler(std::uint64_t seed, std::uint32_t pixel, std::uint32_t index,
          SamplerId id = SamplerId::sobol)
      : key_(sequence_key(id, child_key(seed_key(seed), pixel), index)),
        reversed_index_(reverse_bits(index_in_sequence(id, index))) {}

  /// The numbers of the next vertex; the first call is the camera's. Valid until the next call.
  const Draws& next() {
    if (++vertex_ % vertices_per_block == 0) {
      generate();
    }
    return block_[vertex_ % vertices_per_block];
  }

  /// A number of its own for the same vertex, not stratified: for decisions between going on and
  /// ending, which gain nothing from it.
  float independent() const {
    return to_float(mix(mix(key_ + vertex_ * 0x9e3779b9u) ^ reversed_index_));
  }

 private:
  friend class Sampler8;

  // Two vertices at a time fill a vector of eight.
  static constexpr std::uint32_t vertices_per_block = 2;
  static constexpr std::uint32_t lanes = vertices_per_block * draws_per_call;

  /// A bijection of 32 bits with every output bit depending on every input bit (Wellons' lowbias32,
  /// improved constants).
  template <class Word>
  static constexpr Word mix(Word x) {
    x ^= x >> 16;
    x *= 0x21f0aaadu;
    x ^= x >> 15;
    x *= 0x735a2d97u;
    x ^= x >> 15;
    return x;
  }

  static constexpr std::uint32_t seed_key(std::uint64_t seed) {
    return mix(std::uint32_t(seed) ^ mix(std::uint32_t(seed >> 32) + 0x68bc21ebu));
  }

  /// The key of a seed's pixel, or of a pixel's sequence; for one parent, no two children have the
  /// same. The parent enters twice: once alone, two seeds would now and then give the same picture
  /// of noise, some pixels apart.
  template <class Parent, class Word>
  static constexpr Word child_key(Parent parent, Word child) {
    return mix(mix(parent + child * 0x9e3779b9u) + parent);
  }

  /// The key of the sequence that a pixel's sample is taken from.
  template <class Word>
  static constexpr Word sequence_key(SamplerId id, Word pixel_key, Word index) {
    switch (id) {
      case SamplerId::sobol:
        break;
      case SamplerId::independent:
        return child_key(pixel_key, index);
      case SamplerId::replicated:
        // From the other end, or four samples would be the independent ones.
        return child_key(pixel_key, ~(index & (sampler_replicates - 1u)));
    }
    return pixel_key;
  }

  /// The point of that sequence that it is.
  template <class Word>
  static constexpr Word index_in_sequence(SamplerId id, Word index) {
    switch (id) {
      case SamplerId::sobol:
        break;
      case SamplerId::independent:
        return Word{};
      case SamplerId::replicated:
        return index >> replicate_bits;
    }
    return index;
  }

  /// Each bit flipped by a hash of the bits below it: Owen scrambling of a bit-reversed number.
  template <class Word>
  static constexpr Word laine_karras(Word x, Word key) {
    x ^= x * 0x3d20adeau;
    x += key;
    x *= (key >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
  }

  template <class Word>
  static constexpr Word reverse_bits(Word x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
  }

  /// Sobol's second generator matrix (Pascal's triangle modulo 2) times x, with the result bit
  /// reversed like x.
  template <class Word>
  static constexpr Word pascal(Word x) {
    x ^= (x & 0xaaaaaaaau) >> 1;
    x ^= (x & 0xccccccccu) >> 2;
    x ^= (x & 0xf0f0f0f0u) >> 4;
    x ^= (x & 0xff00ff00u) >> 8;
    x ^= x >> 16;
    return x;
  }

  static constexpr float to_float(std::uint32_t bits) {
    return float(std::int32_t(bits >> 8)) * 0x1p-24f;
  }

  /// Fills the block that begins with the current vertex.
  void generate() {
    const std::uint32_t base = key_ + vertex_ * draws_per_call * 0x9e3779b9u;
    std::uint32_t bits[lanes];
    for (std::uint32_t lane = 0; lane < lanes; ++lane) {
      const std::uint32_t pair_key = mix(base + (lane / 2) * 0x3c6ef372u + 0x5bd1e995u);
      const std::uint32_t lane_key = mix(base + lane * 0x9e3779b9u);
      const std::uint32_t shuffled = reverse_bits(laine_karras(reversed_index_, pair_key));
      const std::uint32_t sobol = (lane & 1u) ? pascal(shuffled) : shuffled;
      bits[lane] = reverse_bits(laine_karras(sobol, lane_key));
    }
    float* draws = &block_[0][0];
    for (std::uint32_t lane = 0; lane < lanes; ++lane) {
      draws[lane] = to_float(bits[lane]);
    }
  }

  std::uint32_t key_;
  std::uint32_t reversed_index_;
  std::uint32_t vertex_ = ~0u;
  alignas(32) Draws block_[vertices_per_block];
};

}  // namespace quartet
