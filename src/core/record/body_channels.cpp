#include "body_channels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "slope_filter.h"
#include "suspension_health_monitor/internal/corner_sample.h"

namespace suspension_health_monitor {
namespace {

constexpr double kConstant = 1e-9;  // change against size, below which a channel is taken to stand still

/// One number of every message, as a function of time.
class Channel {
 public:
  Channel(const std::vector<BodyMotion>& motion, std::array<double, 2> BodyMotion::*member, std::size_t axis)
      : motion_(motion) {
    for (const BodyMotion& m : motion) values_.push_back((m.*member)[axis]);
  }

  double operator()(Stamp stamp) const {
    const auto after = std::lower_bound(motion_.begin(), motion_.end(), stamp,
                                        [](const BodyMotion& m, Stamp s) { return m.stamp < s; });
    const auto i = static_cast<std::size_t>(after - motion_.begin());
    if (i == 0) return values_.front();
    if (after == motion_.end()) return values_.back();
    const double share = toSeconds(stamp - motion_[i - 1].stamp) / toSeconds(motion_[i].stamp - motion_[i - 1].stamp);
    return (1.0 - share) * values_[i - 1] + share * values_[i];
  }

  /// @return false where it is not measured, or does not change.
  bool tells() const {
    const auto [least, most] = std::minmax_element(values_.begin(), values_.end());
    return std::all_of(values_.begin(), values_.end(), isUsable) &&
           *most - *least > kConstant * std::max(std::abs(*least), std::abs(*most));
  }

  double mean() const {
    return std::accumulate(values_.begin(), values_.end(), 0.0) / static_cast<double>(values_.size());
  }

 private:
  const std::vector<BodyMotion>& motion_;
  std::vector<double> values_;
};

void addAcceleration(const Channel& channel, std::size_t axis, std::vector<DriveSegment>& segments) {
  const double mean = channel.mean();
  for (DriveSegment& segment : segments)
    for (const Stamp stamp : segment.stamps) segment.body[axis].push_back(channel(stamp) - mean);
}

void addAngularAcceleration(const Channel& rate, std::size_t axis, std::vector<DriveSegment>& segments) {
  const double period = segments.front().period;
  const int margin = SlopeFilter::kWidest;
  std::vector<std::vector<double>> series;  // with a margin on both sides, where messages are, too
  for (const DriveSegment& segment : segments) {
    series.emplace_back();
    const auto aside = [&](Stamp stamp, int k) { series.back().push_back(rate(stamp + k * fromSeconds(period))); };
    for (int k = -margin; k < 0; ++k) aside(segment.stamps.front(), k);
    for (const Stamp stamp : segment.stamps) aside(stamp, 0);
    for (int k = 1; k <= margin; ++k) aside(segment.stamps.back(), k);
  }
  const SlopeFilter slope = SlopeFilter::fitting(series, period);
  for (std::size_t s = 0; s < segments.size(); ++s)
    for (std::size_t k = 0; k < segments[s].size(); ++k)
      segments[s].body[2 + axis].push_back(slope(&series[s][k + static_cast<std::size_t>(margin)]));
}

}  // namespace

void addBodyChannels(const std::vector<BodyMotion>& motion, std::vector<DriveSegment>& segments) {
  if (motion.empty() || segments.empty()) return;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Channel acceleration(motion, &BodyMotion::acceleration, axis), rate(motion, &BodyMotion::angular_rate, axis);
    if (acceleration.tells()) addAcceleration(acceleration, axis, segments);
    if (rate.tells()) addAngularAcceleration(rate, axis, segments);
  }
}

}  // namespace suspension_health_monitor
