#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace quartet {

/// What samples take to trace, by region of the picture: an 8 × 8 grid of cells, because a ray
/// into a dense mesh takes longer than one into the sky. Lanes are charged by it at any time, all
/// by the same: work, which is counted, times the cell's mean seconds a unit of it.
class SampleCosts {
 public:
  static constexpr std::size_t side = 8;  ///< cells

  /// Work by cell, in rows from the top left. A unit is a ray, or the rest of a sample: what a
  /// sample takes is as good as proportional to its rays plus 1, and a source that traces no rays
  /// is charged by its samples.
  struct Work {
    std::array<std::uint64_t, side * side> units{};

    Work& operator+=(const Work& other);
    bool operator==(const Work&) const = default;
  };

  /// The cell of a tile among `tiles` of a row or column.
  static std::size_t cell(std::size_t tile, std::size_t tiles) { return tile * side / tiles; }

  void add(std::size_t cell, std::uint64_t units, double seconds) {
    work_.units[cell] += units;
    seconds_[cell] += seconds;
  }
  void add(const SampleCosts& other);

  /// Mean wall-clock seconds a unit of work by cell, with the threads that traced all at work; 0
  /// where nothing was measured.
  struct Rates {
    std::array<double, side * side> seconds{};

    /// What this work takes.
    double of(const Work& work) const;
  };
  Rates rates() const;

  bool operator==(const SampleCosts&) const = default;

 private:
  Work work_;
  std::array<double, side * side> seconds_{};
};

}  // namespace quartet
