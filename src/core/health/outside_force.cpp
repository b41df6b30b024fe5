#include "suspension_health_monitor/health/outside_force.h"

#include <algorithm>

namespace suspension_health_monitor {
namespace {

constexpr double kLarger = 2.0, kMuchLarger = 9.0;  // variance over variance
constexpr double kLeastOfUsual = 0.01;              // of the wheel's variance
constexpr double kFewestLooked = 5.0;               // that have a variance

constexpr double kFewestUsual = 50.0;  // of which something is usual

}  // namespace

void OutsideForce::setMemory(double memory) {
  means_.setForgettingFactor(1.0 - 1.0 / std::max(memory / 2.0, kFewestLooked));
}

void OutsideForce::look(const CornerSample& sample, bool valid) {
  const double body = sample.sprung_acceleration, wheel_reading = sample.unsprung_acceleration;
  means_.add({body, body * body, wheel_reading, wheel_reading * wheel_reading});
  if (means_.weight() < kFewestLooked - 1.0) return;
  const double wheel = variance(kWheel, kSquareWheel);
  const double body_variance = variance(kBody, kSquareBody);
  const bool is_known = usual_wheel_.weight() >= kFewestUsual, is_much_larger = body_variance > kMuchLarger * wheel;
  suspected_ =
      is_known ? wheel < kLeastOfUsual * usual_wheel_.mean() && body_variance > kLarger * wheel : is_much_larger;
  if (valid && !suspected_ && !is_much_larger) usual_wheel_.add(wheel);
}

double OutsideForce::variance(Mean value, Mean square) const {
  return std::max(0.0, means_.mean(square) - means_.mean(value) * means_.mean(value));
}

}  // namespace suspension_health_monitor
