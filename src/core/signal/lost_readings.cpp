#include "suspension_health_monitor/internal/signal/lost_readings.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>

#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

void LostReadings::add(double value) {
  if (!first_) first_ = value;
  std::copy(newest_.data() + 1, newest_.data() + kWindow, newest_.data());
  newest_[kWindow - 1] = value - *first_;
  in_a_row_ = std::min(in_a_row_ + 1, kWindow);
  if (in_a_row_ < kWindow) return;
  // A window with a blow has so much power that it would outweigh all the others.
  const double power = newest_.squaredNorm();
  const bool is_far_out = power_.weight() > 0.0 && kSmall * power > power_.mean();
  power_.add(power);
  if (is_far_out) return;
  moments_ *= StreamClock::kMemory;
  moments_.noalias() += newest_ * newest_.transpose();
  windows_ = std::min(windows_ + 1, 2 * kWindow);
}

const std::vector<double>& LostReadings::predict(int lost, const std::vector<Known>& after) {
  const auto num_after = static_cast<int>(after.size()), num_known = kReach + num_after;
  std::array<int, kWindow> places;  // in the window
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kWindow, 1> readings(num_known);
  for (int i = 0; i < kReach; ++i) places[i] = i;
  readings.head<kReach>() = newest_.tail<kReach>();
  for (int i = 0; i < num_after; ++i) {
    places[kReach + i] = kReach - 1 + after[i].place;
    readings[kReach + i] = after[i].value - *first_;
  }
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kWindow, kWindow> known(num_known, num_known);
  for (int i = 0; i < num_known; ++i)
    for (int j = 0; j < num_known; ++j) known(i, j) = moments_(places[i], places[j]);
  known.diagonal().array() += kRounding * known.trace();
  const Eigen::LLT<decltype(known)> factor(known);
  predicted_.clear();
  if (factor.info() != Eigen::Success) return predicted_;
  factor.solveInPlace(readings);
  for (int k = 0; k < lost; ++k) {
    double sum = *first_;
    for (int i = 0; i < num_known; ++i) sum += moments_(places[i], kReach + k) * readings[i];
    predicted_.push_back(sum);
  }
  return predicted_;
}

}  // namespace suspension_health_monitor
