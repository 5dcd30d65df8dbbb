#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace quartet {

struct LaneSettings;  // lane_settings.h

enum class PolicyId { vote, two_level, batch, converge };

/// What of a Policy can be set, beside its kind: policy_parameter.h.
enum class PolicyParameterId { first, batch, multiplier, stochastic_rounding };

/// How errors become sample counts; which parameters matter, the row of its kind says.
struct Policy {
  PolicyId kind = PolicyId::vote;
  /// All but vote: samples that every pixel gets at first, and that a pixel gets at once later on;
  /// 0: what the policy's authors gave, or what the estimator asks for.
  std::uint16_t first = 0;
  std::uint16_t batch = 0;
  float multiplier = 0.5f;  ///< vote: extra samples a vote
  /// vote: round multiplier · votes up or down at random, so that its mean is kept, rather than
  /// down.
  bool stochastic_rounding = false;
  bool operator==(const Policy&) const = default;
};

/// What is planned by at the end of a pass.
struct PlanInput {
  int width;
  int height;
  std::span<const float> error;          ///< channels × pixels, as the estimator wrote it
  std::span<const std::uint32_t> taken;  ///< samples each pixel has used, rejected ones included
  std::uint32_t pass;                    ///< the last one finished, from 1; 0 before the first
};

/// Samples that each pixel gets in the next pass, and how it came to that.
struct Plan {
  std::vector<std::uint16_t> wanted;
  std::uint64_t total = 0;  ///< sum of `wanted`
  /// Pixels that are not done, whether they get samples or not; all of them before the first pass.
  std::uint64_t not_done = 0;
};

/// One row of a picture at the end of a pass, for a policy. Marks are 1 for a pixel that is not
/// done, else 0; to the left and to the right of each row is one of 0 more.
struct PlanRow {
  std::uint32_t pass;         ///< the last one finished, from 1
  std::uint32_t first_pixel;  ///< of the picture's
  std::size_t width;
  const std::uint8_t* above;  ///< marks; zeros beyond the border
  const std::uint8_t* here;
  const std::uint8_t* below;
  std::span<const std::uint32_t> taken;  ///< of the row, rejected ones included
};

/// One row of the table of policies.
struct PolicyRow {
  PolicyId key;
  std::string_view id;
  std::string_view label;
  std::string_view source;
  std::span<const PolicyParameterId> parameters;  ///< that it reads
  /// Samples of every pixel in the first pass.
  std::uint16_t (*first)(const Policy& policy);
  /// What the pixels of a row get next, without regard to their maximum.
  void (*plan)(const LaneSettings& settings, const PlanRow& row, std::uint16_t* wanted);
};

std::span<const PolicyRow> policies();
const PolicyRow& policy(PolicyId key);
/// Throws std::invalid_argument that lists the legal ids.
const PolicyRow& find_policy(std::string_view id);

/// Plans the next pass, from nothing but the arguments; `plan` is overwritten. An estimator
/// without an error gives every pixel one sample, whatever the policy. Runs on the threads of the
/// current TBB arena.
void plan_next(const LaneSettings& settings, const PlanInput& input, Plan& plan);

/// The same for one row after the first pass, of an estimator with an error; returns the sum of
/// `wanted`.
std::uint64_t plan_row(const LaneSettings& settings, const PlanRow& row,
                       std::span<std::uint16_t> wanted);

}  // namespace quartet
