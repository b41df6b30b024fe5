#include "suspension_health_monitor/internal/identification/horizon_integral.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "suspension_health_monitor/internal/plain_text.h"

namespace suspension_health_monitor {
namespace {

[[noreturn]] void refuseIntervals(int intervals, const char* allowed) {
  throw std::invalid_argument("horizon_samples = " + std::to_string(intervals) + ", must be " + allowed);
}

}  // namespace

HorizonIntegral::HorizonIntegral(int intervals, double period, IntegrationRule rule)
    : intervals_(intervals),
      period_(period),
      until_refresh_(intervals + 1),
      leaves_other_parity_(intervals % 2 == 0 ? 1 : 0) {
  if (intervals < 1) refuseIntervals(intervals, "at least 1");
  if (!(std::isfinite(period) && period > 0.0))
    throw std::invalid_argument("sample_period = " + numberText(period) + " [s], must be above 0");
  switch (rule) {
    case IntegrationRule::kTrapezoid: end_corrections_ = {-1.0 / 2}; break;
    case IntegrationRule::kSimpson:
      if (intervals % 2 != 0) refuseIntervals(intervals, "even for Simpson's rule");
      same_weight_ = 2.0 / 3;
      other_weight_ = 4.0 / 3;
      end_corrections_ = {-1.0 / 3};
      break;
    case IntegrationRule::kCubic:
      if (intervals < 5) refuseIntervals(intervals, "at least 5 for the cubic rule");
      end_corrections_ = {-5.0 / 8, 1.0 / 6, -1.0 / 24};
      corrects_neighbours_ = true;
      break;
  }
}

double HorizonIntegral::update(const DelayLine& signal) {
  const double newest = signal.at(0);
  sums_[parity_] += newest;
  sums_[parity_ ^ leaves_other_parity_] -= signal.at(intervals_ + 1);
  fresh_[parity_] += newest;
  if (--until_refresh_ == 0) {
    sums_ = fresh_;
    fresh_ = {};
    until_refresh_ = intervals_ + 1;
  }
  double integral = same_weight_ * sums_[parity_] + other_weight_ * sums_[parity_ ^ 1];
  integral += end_corrections_[0] * (newest + signal.at(intervals_));
  if (corrects_neighbours_)
    integral += end_corrections_[1] * (signal.at(1) + signal.at(intervals_ - 1)) +
                end_corrections_[2] * (signal.at(2) + signal.at(intervals_ - 2));
  parity_ ^= 1;
  return period_ * integral;
}

void HorizonIntegral::reset() {
  sums_ = {};
  fresh_ = {};
  until_refresh_ = intervals_ + 1;
  parity_ = 0;
}

}  // namespace suspension_health_monitor
