#include "suspension_health_monitor/internal/vehicle/travel_observer.h"

#include <algorithm>

namespace suspension_health_monitor {
namespace {

// A washout of so many over the age of a series: what its start left is forgotten as fast as anything can be told.
constexpr double kStart = 2.0;

}  // namespace

void TravelObserver::push(double relative_acceleration) {
  if (input_.full()) {
    const WheelStep gain = step_(input_.data());
    age_ += period_;
    const double washout = std::max(washout_, kStart / age_);
    const double leaves = washout * (2.0 * kDamping * travel_rate_ + washout * travel_);
    travel_ += period_ * travel_rate_ + gain.end_position;
    travel_rate_ += gain.end_velocity - period_ * leaves;
  }
  input_.push(relative_acceleration);
}

void TravelObserver::startNewSeries() {
  input_.clear();
  age_ = travel_ = travel_rate_ = 0.0;
}

}  // namespace suspension_health_monitor
