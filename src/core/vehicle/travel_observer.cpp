#include "suspension_health_monitor/internal/vehicle/travel_observer.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr int kMeans = 3;                 // of a mean of a mean
constexpr double kOffsetMemory = 40.0;    // [s]
constexpr double kWashout = 1.0 / 200.0;  // of the natural frequency
constexpr double kDamping = 0.7;
// A washout of so many over the age of a series: what its start left is forgotten as fast as anything can be told.
constexpr double kStart = 2.0;

}  // namespace

int TravelObserver::delayOf(int natural_period) {
  return BandlimitedInterpolator::kHalfWidth + kMeans * natural_period / 2;
}

TravelObserver::TravelObserver(double period, double stiffness_to_mass, int natural_period)
    : period_(period),
      washout_(kWashout * std::sqrt(stiffness_to_mass)),
      horizon_(std::pow(natural_period * period, kMeans)),
      step_(0.0, 1.0, period),
      offset_(std::exp(-period / kOffsetMemory)),
      slow_(now_.size(), LinearIntegralFilter(kMeans, {natural_period, period, IntegrationRule::kTrapezoid}, 0)),
      recent_(now_.size(), boost::circular_buffer<double>(static_cast<std::size_t>(kMeans * natural_period / 2) + 1)) {}

void TravelObserver::push(double relative_acceleration) {
  offset_.add(relative_acceleration);
  auto& [travel, rate, acceleration] = now_;
  double leaves = 0.0;
  if (input_.full()) {
    const WheelStep gain = step_(input_.window());
    age_ += period_;
    const double washout = std::max(washout_, kStart / age_);
    leaves = washout * (2.0 * kDamping * rate + washout * travel);
    travel += period_ * rate + gain.end_position;
    rate += gain.end_velocity - period_ * leaves;
  }
  input_.push(relative_acceleration - offset_.mean());
  if (!input_.full()) return;
  acceleration = input_.window()[WheelInterpolator::kWidth / 2 - 1] - leaves;
  for (std::size_t i = 0; i < now_.size(); ++i) {
    slow_[i].push(now_[i]);
    recent_[i].push_back(now_[i]);
  }
}

double TravelObserver::fast(std::size_t which) const {
  return recent_[which].front() - slow_[which].output(0) / horizon_;
}

void TravelObserver::startNewSeries() {
  input_.reset();
  age_ = 0.0;
  now_ = {};
  for (LinearIntegralFilter& slow : slow_) slow.reset();
  for (auto& values : recent_) values.clear();
}

}  // namespace suspension_health_monitor
