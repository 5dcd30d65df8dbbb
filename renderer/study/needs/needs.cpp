#include "renderer/study/needs/needs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quartet {
namespace {

Need need_of(const Interval& interval, double limit) {
  return interval.low > limit     ? Need::needed
         : interval.high <= limit ? Need::not_needed
                                  : Need::undecided;
}

/// Pictures of smaller models, each compared with the whole one.
class NeedsStudy {
 public:
  NeedsStudy(const Model& whole, std::uint64_t first_seed, const NeedsPlan& plan,
             std::stop_token stop, const std::function<void(double, std::string_view)>& progress)
      : whole_(whole),
        first_seed_(first_seed),
        plan_(plan),
        stop_(std::move(stop)),
        progress_(progress),
        metric_(metric(plan.metric)) {
    for (const PartId id : plan.parts) {
      for (Simplification& each : part(id).of(whole)) {
        simplifications_.push_back(std::move(each));
      }
    }
    rate_ = sidak(1.0 - plan.confidence, double(simplifications_.size()) + 1.0);
    // How many combinations will be tried is not known before; most have few.
    models_ = 1.0 + 1.3 * double(simplifications_.size());
  }

  std::optional<NeedsResult> run() {
    auto pictures = render(whole_, "the whole model");
    if (!pictures) {
      return std::nullopt;
    }
    pictures_ = std::move(*pictures);
    result_.noise_floor = noise_of_mean(metric_, pictures_, rate_);
    result_.limit = plan_.error.value_or(result_.noise_floor.mean);
    result_.rays = pictures_.rays;
    result_.seconds = pictures_.seconds;
    result_.rejected = pictures_.rejected;
    result_.smallest_model = whole_;
    result_.can_be_met = !plan_.error || result_.noise_floor.mean <= result_.limit;
    if (result_.can_be_met && !(measure_rows() && reduce())) {
      return std::nullopt;
    }
    return std::move(result_);
  }

 private:
  std::optional<ModelPictures> render(const Model& model, std::string_view label) {
    auto pictures = render_model(model, plan_.spp, first_seed_, plan_.seeds, stop_,
                                 [&](double done) { tell(done, label); });
    done_ += 1.0;
    return pictures;
  }

  void tell(double done, std::string_view label) const {
    if (progress_) {
      progress_(std::min(0.99, (done_ + done) / models_), label);
    }
  }

  std::optional<NeedsRow> measure(const Model& model, std::string_view label) {
    const auto pictures = render(model, label);
    if (!pictures) {
      return std::nullopt;
    }
    NeedsRow row;
    row.measured = error_of_model(metric_, pictures_, *pictures, rate_);
    row.rays = pictures->rays;
    row.rays_ratio = pictures->rays / pictures_.rays;
    row.seconds_ratio = pictures->seconds / pictures_.seconds;
    return row;
  }

  /// Whether what comes after this one of its part, which takes less out, would tell nothing new.
  bool is_last(const NeedsRow& row) const {
    constexpr double far_below = 0.01;
    return part(row.simplification.part).exclusive &&
           row.measured.error.high <= far_below * result_.limit;
  }

  bool measure_rows() {
    for (const Simplification& each : simplifications_) {
      if (!result_.rows.empty() && result_.rows.back().simplification.part == each.part &&
          is_last(result_.rows.back())) {
        continue;
      }
      auto row = measure(simplified(whole_, std::span(&each, 1)), each.label);
      if (!row) {
        return false;
      }
      row->simplification = each;
      row->need = part(each.part).same_mean ? need_of(row->cost(), 1.0)
                                            : need_of(row->measured.error, result_.limit);
      result_.rows.push_back(std::move(*row));
    }
    return true;
  }

  /// Rows that are not needed, what is to be tried first before what is to be tried later.
  std::vector<std::size_t> candidates() const {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < result_.rows.size(); ++i) {
      const NeedsRow& row = result_.rows[i];
      if (row.need == Need::not_needed && part(row.simplification.part).can_be_left) {
        order.push_back(i);
      }
    }
    const std::vector<std::size_t> all = order;
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      return worth_in_turn(a, all) > worth_in_turn(b, all);
    });
    return order;
  }

  /// Those of an exclusive part are tried from the one that takes most out, in one go.
  double worth_in_turn(std::size_t row, std::span<const std::size_t> order) const {
    const PartId id = result_.rows[row].simplification.part;
    const auto first = std::ranges::find_if(order, [&](std::size_t other) {
      return part(id).exclusive && result_.rows[other].simplification.part == id;
    });
    return worth(result_.rows[first == order.end() ? row : *first]);
  }

  /// Rays saved per error. An error that is not above 0 counts as a millionth of the limit, or what
  /// has least noise would come before what saves most.
  double worth(const NeedsRow& row) const {
    if (part(row.simplification.part).same_mean) {
      return -std::numeric_limits<double>::max();
    }
    const double least = std::max(1e-6 * result_.limit, double(std::numeric_limits<float>::min()));
    return (1.0 - row.rays_ratio) / std::max(row.measured.error.mean, least);
  }

  bool is_taken(PartId id) const {
    return std::ranges::any_of(result_.taken_out, [&](std::size_t i) {
      return result_.rows[i].simplification.part == id;
    });
  }

  bool reduce() {
    std::vector<Simplification> taken;
    for (const std::size_t i : candidates()) {
      const NeedsRow& row = result_.rows[i];
      const Part& kind = part(row.simplification.part);
      if (kind.exclusive && is_taken(kind.key)) {
        continue;
      }
      taken.push_back(row.simplification);
      std::optional<NeedsRow> tried = row;
      if (taken.size() > 1) {
        if (!leaves_a_light(taken)) {
          taken.pop_back();
          continue;
        }
        tried = measure(simplified(whole_, taken), "without " + row.simplification.label + ", too");
        if (!tried) {
          return false;
        }
        tried->need = kind.same_mean ? need_of_same_mean(*tried)
                                     : need_of(tried->measured.error, result_.limit);
      }
      if (tried->need != Need::not_needed || tried->measured.error.high > result_.limit) {
        taken.pop_back();
        continue;
      }
      result_.taken_out.push_back(i);
      result_.smallest = std::move(tried);
      result_.smallest->simplification = combined(taken);
      result_.smallest_model = simplified(whole_, taken);
    }
    return true;
  }

  /// Whether it takes less work than what is smallest so far, for the same noise.
  Need need_of_same_mean(const NeedsRow& tried) const {
    const double before = result_.smallest ? result_.smallest->cost().mean : 1.0;
    return need_of(tried.cost(), before);
  }

  bool leaves_a_light(std::span<const Simplification> taken) const {
    const Scene scene = simplified(whole_, taken).scene;
    return shines(scene.environment) || !scene.delta_lights.empty() ||
           std::ranges::any_of(scene.shapes, [](const Shape& shape) { return shape.emits; });
  }

  static Simplification combined(std::span<const Simplification> taken) {
    Simplification all;
    for (const Simplification& each : taken) {
      all.label += (all.label.empty() ? "" : ", ") + each.label;
    }
    return all;
  }

  const Model& whole_;
  std::uint64_t first_seed_;
  const NeedsPlan& plan_;
  std::stop_token stop_;
  const std::function<void(double, std::string_view)>& progress_;
  const Metric& metric_;
  std::vector<Simplification> simplifications_;
  double rate_ = 0.0;
  double models_ = 1.0;
  double done_ = 0.0;
  ModelPictures pictures_;  // of the whole model
  NeedsResult result_;
};

}  // namespace

Interval NeedsRow::cost() const {
  const Interval& variance = measured.variance;
  return {rays_ratio * variance.mean, rays_ratio * variance.low, rays_ratio * variance.high};
}

std::optional<NeedsResult> run_needs(
    const Model& whole, std::uint64_t first_seed, const NeedsPlan& plan, std::stop_token stop,
    const std::function<void(double, std::string_view)>& progress) {
  return NeedsStudy(whole, first_seed, plan, std::move(stop), progress).run();
}

}  // namespace quartet
