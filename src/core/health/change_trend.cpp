#include "suspension_health_monitor/internal/health/change_trend.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {

LogChange ChangeTrend::carryOn(const LogChange& change, double age, double now, double window, double certain) {
  if (now < last_) restart();
  const double spacing = count_ > 0 ? now - last_ : window;
  last_ = now;
  const double new_share = std::min(1.0, spacing / window);
  points_[count_++ % kChanges] = {now - age, change.size, new_share / (change.stddev * change.stddev)};
  double weight = 0.0, time = 0.0, size = 0.0;
  const std::size_t kept = std::min(count_, kChanges);
  for (std::size_t i = 0; i < kept; ++i) {
    weight += points_[i].weight;
    time += points_[i].weight * points_[i].time;
    size += points_[i].weight * points_[i].size;
  }
  time /= weight;
  size /= weight;
  double information = 0.0, product = 0.0;
  for (std::size_t i = 0; i < kept; ++i) {
    information += points_[i].weight * std::pow(points_[i].time - time, 2);
    product += points_[i].weight * (points_[i].time - time) * (points_[i].size - size);
  }
  if (!(product * product > certain * certain * information)) return change;
  const double slope = product / information;
  return {change.size + std::clamp(slope * age, -kMostCarried, kMostCarried),
          std::hypot(change.stddev, age / std::sqrt(information))};
}

}  // namespace suspension_health_monitor
