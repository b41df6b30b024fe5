#include "suspension_health_monitor/signal/uniform_grid.h"

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace suspension_health_monitor {
namespace {

// A reading that is older than its predecessor by more than this is a clock that jumped or a bag that loops, not a
// message that was overtaken.
constexpr int kReorderedPeriods = 50;

// Before the conversion to whole nanoseconds, which is undefined for NaN and what does not fit.
Stamp checked(double period) {
  if (!(period >= 1e-9 && period <= 1e9))
    throw std::invalid_argument("sample_period = " + std::to_string(period) + " [s], must be in [1e-9, 1e9]");
  return fromSeconds(period);
}

}  // namespace

std::uint64_t RejectCounts::total() const { return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0}); }

RejectCounts& RejectCounts::operator+=(const RejectCounts& other) {
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
  return *this;
}

UniformGrid::UniformGrid(double period) : period_(checked(period)) {}

std::optional<CornerSample> UniformGrid::push(Side side, Stamp stamp, double acceleration) {
  if (!admit(side, stamp, acceleration)) return std::nullopt;
  Queue& queue = waiting_[static_cast<std::size_t>(side)];
  if (queue.full()) drop(queue);
  queue.push({stamp, acceleration});
  return match();
}

bool UniformGrid::admit(Side side, Stamp stamp, double acceleration) {
  std::optional<Stamp>& last = last_[static_cast<std::size_t>(side)];
  const auto reject = [this](RejectReason reason) {
    rejected_.add(reason);
    return false;
  };
  if (!isUsable(acceleration)) return reject(RejectReason::kNotFinite);
  if (last && stamp.count() == 0) return reject(RejectReason::kZeroStamp);
  if (last && stamp == *last) return reject(RejectReason::kRepeatedStamp);
  if (last && stamp < *last) {
    rejected_.add(RejectReason::kTimeWentBack);
    if (*last - stamp <= kReorderedPeriods * period_) return false;
    startNewSeries();
  }
  last = stamp;
  return true;
}

std::optional<CornerSample> UniformGrid::match() {
  Queue& sprung = waiting_[static_cast<std::size_t>(Side::kSprung)];
  Queue& unsprung = waiting_[static_cast<std::size_t>(Side::kUnsprung)];
  while (!sprung.empty() && !unsprung.empty()) {
    const Reading body = sprung.front();
    const Reading wheel = unsprung.front();
    if (2 * std::chrono::abs(body.stamp - wheel.stamp) <= period_) {
      sprung.pop();
      unsprung.pop();
      return CornerSample{body.stamp, body.acceleration, wheel.acceleration};
    }
    drop(body.stamp < wheel.stamp ? sprung : unsprung);
  }
  return std::nullopt;
}

void UniformGrid::drop(Queue& queue) {
  rejected_.add(RejectReason::kMissingPartner);
  queue.pop();
}

void UniformGrid::startNewSeries() {
  for (Queue& queue : waiting_)
    while (!queue.empty()) drop(queue);
  last_ = {};
}

}  // namespace suspension_health_monitor
