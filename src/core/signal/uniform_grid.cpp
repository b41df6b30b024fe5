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

// A spike of this size takes an estimator with forgetting thousands of rows to forget; no road makes one.
constexpr double kAbsurdRatio = 1e6;
constexpr double kFewestForUsual = 100.0;
constexpr int kMostAbsurd = 3;  // in a row; after that it is how the sensor reads now

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

UniformGrid::UniformGrid(double period, const GridOptions& options)
    : period_(checked(period)), options_(options) {}

std::optional<CornerSample> UniformGrid::push(Side side, Stamp stamp, double acceleration) {
  if (!admit(side, stamp, acceleration)) return std::nullopt;
  Queue& queue = waiting_[static_cast<std::size_t>(side)];
  if (queue.full()) drop(queue);
  queue.push({stamp, acceleration});
  if (side == Side::kRoad) road_is_silent_ = false;
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
  if (isAbsurd(static_cast<std::size_t>(side), acceleration)) return reject(RejectReason::kAbsurd);
  last = stamp;
  return true;
}

bool UniformGrid::isAbsurd(std::size_t index, double acceleration) {
  const double size = std::abs(acceleration);
  RunningMean& usual = usual_[index];
  const bool absurd = usual.weight() >= kFewestForUsual && usual.mean() > 0.0 && size > kAbsurdRatio * usual.mean() &&
                      absurd_in_a_row_[index] < kMostAbsurd;
  absurd_in_a_row_[index] = absurd ? absurd_in_a_row_[index] + 1 : 0;
  if (!absurd) usual.add(size);
  return absurd;
}

std::optional<CornerSample> UniformGrid::match() {
  Queue& sprung = waiting_[static_cast<std::size_t>(Side::kSprung)];
  Queue& unsprung = waiting_[static_cast<std::size_t>(Side::kUnsprung)];
  while (!sprung.empty() && !unsprung.empty()) {
    const Reading body = sprung.front();
    const Reading wheel = unsprung.front();
    if (2 * std::chrono::abs(body.stamp - wheel.stamp) <= period_) {
      if (options_.has_road && !findRoad(body.stamp)) return std::nullopt;
      sprung.pop();
      unsprung.pop();
      return CornerSample{body.stamp, body.acceleration, wheel.acceleration};
    }
    drop(body.stamp < wheel.stamp ? sprung : unsprung);
  }
  return std::nullopt;
}

// @return false: the road's reading of this instant may still come.
bool UniformGrid::findRoad(Stamp stamp) {
  Queue& road = waiting_[static_cast<std::size_t>(Side::kRoad)];
  while (!road.empty() && 2 * (stamp - road.front().stamp) > period_) drop(road);
  road_acceleration_.reset();
  if (road.empty()) {
    road_is_silent_ = road_is_silent_ || waiting_[static_cast<std::size_t>(Side::kSprung)].size() > kMostRoadLag;
    return road_is_silent_;
  }
  if (2 * (road.front().stamp - stamp) > period_) return true;
  road_acceleration_ = road.front().acceleration;
  road.pop();
  return true;
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
