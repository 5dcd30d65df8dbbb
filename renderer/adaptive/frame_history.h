#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace quartet {

/// A lane at the end of one frame.
struct FrameRecord {
  std::uint32_t frame = 0;  ///< from 1
  /// Taken so far, rejected ones and those of a pilot run included: what the lane is charged for.
  std::uint64_t samples = 0;
  std::uint64_t pilot_samples = 0;  ///< of these, the ones of a pilot, which are not shown
  std::uint32_t max_spp = 0;        ///< of the pixel with most, without those of a pilot
  std::uint64_t not_done = 0;       ///< pixels: Plan::not_done
  /// What the lane would have taken alone on all threads, in wall-clock seconds: its samples,
  /// whoever traced them, its share of reading them, and its own estimates and plans.
  double seconds = 0.0;
};

/// The frames of a lane in bounded memory: all of them up to `most_records`, then every second one,
/// every fourth and so on, and always the last. Which are kept is a function of how many there
/// were.
class FrameHistory {
 public:
  static constexpr std::size_t most_records = 4096;

  /// `record.frame` must be the one after the last.
  void push(const FrameRecord& record) {
    if (!records_.empty() && records_.back().frame % stride_ != 0) {
      records_.pop_back();  // kept only for being the last
    }
    if (records_.size() == most_records) {
      stride_ *= 2;
      std::erase_if(records_,
                    [this](const FrameRecord& each) { return each.frame % stride_ != 0; });
    }
    records_.push_back(record);
  }
  void clear() {
    records_.clear();
    stride_ = 1;
  }

  std::uint32_t frames() const { return records_.empty() ? 0 : records_.back().frame; }
  FrameRecord& back() { return records_.back(); }
  std::span<const FrameRecord> records() const { return records_; }

 private:
  std::vector<FrameRecord> records_;
  std::uint32_t stride_ = 1;
};

}  // namespace quartet
