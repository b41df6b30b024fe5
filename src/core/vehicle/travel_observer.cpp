#include "suspension_health_monitor/internal/vehicle/travel_observer.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr double kMeanMemory = 10.0;     // [s]
constexpr double kWashout = 1.0 / 200.0;  // of the natural frequency
constexpr double kDamping = 0.7;
// A washout of so many over the age of a series: what its start left is forgotten as fast as anything can be told.
constexpr double kStart = 2.0;

}  // namespace

int TravelObserver::delayOf(int natural_period) {
  return BandlimitedInterpolator::kHalfWidth + SlowMean::delayOf(natural_period);
}

TravelObserver::TravelObserver(double period, double stiffness_to_mass, int natural_period)
    : period_(period),
      washout_(kWashout * std::sqrt(stiffness_to_mass)),
      step_(0.0, 1.0, period),
      offset_(std::exp(-period / kMeanMemory)),
      slow_(2, SlowMean(period, natural_period)),
      recent_(2, boost::circular_buffer<double>(static_cast<std::size_t>(SlowMean::delayOf(natural_period)) + 1)) {}

void TravelObserver::push(double relative_acceleration) {
  offset_.add(relative_acceleration);
  auto& [travel, rate] = now_;
  if (input_.full()) {
    const WheelStep gain = step_(input_.data());
    age_ += period_;
    const double washout = std::max(washout_, kStart / age_);
    const double leaves = washout * (2.0 * kDamping * rate + washout * travel);
    travel += period_ * rate + gain.end_position;
    rate += gain.end_velocity - period_ * leaves;
  }
  input_.push(relative_acceleration - offset_.mean());
  if (!input_.full()) return;
  for (std::size_t i = 0; i < now_.size(); ++i) {
    slow_[i].push(now_[i]);
    recent_[i].push_back(now_[i]);
  }
}

double TravelObserver::fast(std::size_t which) const { return recent_[which].front() - slow_[which].value(); }

void TravelObserver::startNewSeries() {
  input_.clear();
  age_ = 0.0;
  now_ = {};
  for (SlowMean& slow : slow_) slow.reset();
  for (auto& values : recent_) values.clear();
}

}  // namespace suspension_health_monitor
