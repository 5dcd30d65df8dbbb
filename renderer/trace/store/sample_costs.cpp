#include "renderer/trace/store/sample_costs.h"

namespace quartet {

SampleCosts::Work& SampleCosts::Work::operator+=(const Work& other) {
  for (std::size_t i = 0; i < units.size(); ++i) {
    units[i] += other.units[i];
  }
  return *this;
}

void SampleCosts::add(const SampleCosts& other) {
  work_ += other.work_;
  for (std::size_t i = 0; i < seconds_.size(); ++i) {
    seconds_[i] += other.seconds_[i];
  }
}

SampleCosts::Rates SampleCosts::rates() const {
  Rates rates;
  for (std::size_t i = 0; i < seconds_.size(); ++i) {
    rates.seconds[i] = work_.units[i] > 0 ? seconds_[i] / double(work_.units[i]) : 0.0;
  }
  return rates;
}

double SampleCosts::Rates::of(const Work& work) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    sum += double(work.units[i]) * seconds[i];
  }
  return sum;
}

}  // namespace quartet
