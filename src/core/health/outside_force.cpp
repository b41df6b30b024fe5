#include "suspension_health_monitor/health/outside_force.h"

#include <algorithm>

namespace suspension_health_monitor {
namespace {

constexpr double kLarger = 4.0;         // variance over variance
constexpr double kLeastOfUsual = 0.01;  // of the wheel's variance
constexpr double kFewestLooked = 5.0;   // that have a variance

constexpr double kFewestUsual = 50.0;  // of which something is usual

}  // namespace

void OutsideForce::setMemory(double memory) {
  means_.setForgettingFactor(1.0 - 1.0 / std::max(memory / 2.0, kFewestLooked));
}

void OutsideForce::look(const CornerSample& sample, bool valid) {
  const double body = sample.sprung_acceleration, wheel = sample.unsprung_acceleration;
  means_.add({body, body * body, wheel, wheel * wheel});
  if (means_.weight() < kFewestLooked - 1.0) return;
  const double wheel_variance = variance(kWheel, kSquareWheel);
  const bool is_larger = variance(kBody, kSquareBody) > kLarger * wheel_variance;
  if (valid && !is_larger) usual_wheel_.add(wheel_variance);
  const bool is_known = usual_wheel_.weight() >= kFewestUsual;
  suspected_ = is_larger && !(is_known && wheel_variance >= kLeastOfUsual * usual_wheel_.mean());
}

double OutsideForce::variance(Mean value, Mean square) const {
  return std::max(0.0, means_.mean(square) - means_.mean(value) * means_.mean(value));
}

}  // namespace suspension_health_monitor
