#include "renderer/adaptive/pass_history.h"

#include <algorithm>

namespace quartet {

void PassHistory::push(const PassRecord& record, const SampleCosts::Work& work) {
  if (!records_.empty() && records_.back().pass % stride_ != 0) {
    records_.pop_back();  // kept only for being the last
    charges_.pop_back();
  }
  if (records_.size() == most_records) {
    stride_ *= 2;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < records_.size(); ++i) {
      if (records_[i].pass % stride_ == 0) {
        records_[kept] = records_[i];
        charges_[kept] = charges_[i];
        ++kept;
      }
    }
    records_.resize(kept);
    charges_.resize(kept);
  }
  records_.push_back(record);
  charges_.push_back({work, record.seconds});
}

void PassHistory::clear() {
  records_.clear();
  charges_.clear();
  stride_ = 1;
}

void PassHistory::charge(const SampleCosts& costs, bool last_only) {
  const std::size_t first = last_only && !records_.empty() ? records_.size() - 1 : 0;
  const SampleCosts::Rates rates = costs.rates();
  for (std::size_t i = first; i < records_.size(); ++i) {
    records_[i].tracing_seconds = rates.of(charges_[i].work);
    records_[i].seconds = records_[i].tracing_seconds + charges_[i].own_seconds;
  }
}

}  // namespace quartet
