#include "suspension_health_monitor/internal/signal/regular_times.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr double kLossShare = 1e-4, kLossesKnown = 1000.0;  // beforehand, as if of so many readings
constexpr double kLongestLoss = 5.0;                        // periods; no longer one is bridged
constexpr int kOtherRate = 50;  // readings more that do not follow by a period than do: the period is another one

}  // namespace

double RegularTimes::next(double stamp) {
  if (out_of_step_ > kOtherRate) readings_ = out_of_step_ = 0;
  if (readings_ < kFewest) return begin(stamp);
  const double taken = periodsTo(stamp);
  in_row_ = taken == 1.0 ? in_row_ + 1 : 1;
  out_of_step_ = std::max(0, out_of_step_ + (taken == expected_ ? -1 : 1));
  readings_ = std::min(readings_ + 1, static_cast<int>(kMemory));
  const double count = readings_, sum = count * (count + 1.0), off = stamp - time_ - taken * spacing_;
  time_ += taken * spacing_ + 2.0 * (2.0 * count - 1.0) / sum * off;
  spacing_ += 6.0 / sum * off / std::max(1.0, taken);
  means_.add(
      {(stamp - time_) * (stamp - time_), taken < expected_ ? 1.0 : 0.0, taken <= kLongestLoss ? taken - 1.0 : 0.0});
  expected_ = 1.0;
  return time_;
}

double RegularTimes::begin(double stamp) {
  first_[static_cast<std::size_t>(readings_)] = time_ = stamp;
  expected_ = 1.0;
  if (++readings_ == kFewest) drawLine();
  return stamp;
}

void RegularTimes::drawLine() {
  std::array<double, kFewest - 1> spacings;
  for (std::size_t i = 0; i < spacings.size(); ++i) spacings[i] = first_[i + 1] - first_[i];
  std::array<double, kFewest - 1> sorted = spacings;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  Eigen::Matrix<double, kFewest, 2> periods;  // to the newest reading, negative; 1
  periods.col(1).setOnes();
  periods(kFewest - 1, 0) = 0.0;
  for (int i = kFewest - 2; i >= 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    periods(i, 0) = periods(i + 1, 0) - std::round(spacings[k] / sorted[sorted.size() / 2]);
  }
  const Eigen::Map<const Eigen::Matrix<double, kFewest, 1>> stamps(first_.data());
  const Eigen::Vector2d line = (periods.transpose() * periods).ldlt().solve(periods.transpose() * stamps);
  spacing_ = line[0];
  time_ = line[1];
  out_of_step_ = in_row_ = 0;
  means_ = RunningMeans<kNumMeans>(StreamTiming::kMemory);
  losses_ = followed_ = 0.0;
  means_.add({(stamps - periods * line).squaredNorm() / (kFewest - 2), 0.0, 0.0});
}

double RegularTimes::periodsTo(double stamp) {
  const double share = (kLossesKnown * kLossShare + std::max(0.0, losses_)) / (kLossesKnown + followed_);
  const double tolerated = -variance() / (spacing_ * spacing_) * std::log(share);
  const double beyond = (stamp - time_) / spacing_ - expected_;
  const double lost = std::copysign(std::max(0.0, std::round(std::abs(beyond) - tolerated)), beyond);
  const double taken = std::max(0.0, expected_ + lost);
  losses_ += taken > expected_ ? 1.0 : taken < expected_ ? -1.0 : 0.0;
  followed_ += 1.0;
  return taken;
}

}  // namespace suspension_health_monitor
