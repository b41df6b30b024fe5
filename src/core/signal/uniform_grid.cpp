#include "suspension_health_monitor/signal/uniform_grid.h"

#include <stdexcept>
#include <string>

namespace suspension_health_monitor {
namespace {

// Before the conversion to whole nanoseconds, which is undefined for NaN and what does not fit.
Stamp checked(double period) {
  if (!(period >= 1e-9 && period <= 1e9))
    throw std::invalid_argument("sample_period = " + std::to_string(period) + " [s], must be in [1e-9, 1e9]");
  return fromSeconds(period);
}

}  // namespace

UniformGrid::UniformGrid(double period, const GridOptions& options)
    : period_(checked(period)),
      options_(options),
      gates_{StreamGate(period_), StreamGate(period_), StreamGate(period_)} {}

std::optional<CornerSample> UniformGrid::push(Side side, Stamp stamp, double acceleration) {
  if (!admit(side, stamp, acceleration)) return std::nullopt;
  Queue& queue = waiting_[static_cast<std::size_t>(side)];
  if (queue.full()) drop(queue);
  queue.push({stamp, acceleration, gates_[static_cast<std::size_t>(side)].isStill()});
  if (side == Side::kRoad) road_is_silent_ = false;
  return match();
}

bool UniformGrid::admit(Side side, Stamp stamp, double acceleration) {
  const auto index = static_cast<std::size_t>(side);
  const StreamGate::Verdict verdict = gates_[index].judge(stamp, acceleration);
  if (verdict == StreamGate::Verdict::kBeginsAnew) startNewSeries(index);
  return verdict != StreamGate::Verdict::kRejected;
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
      if (body.still != wheel.still) {
        rejected_.add(RejectReason::kStuck);
        continue;
      }
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

// @param first  the stream whose clock went back before those of the others.
void UniformGrid::startNewSeries(std::size_t first) {
  for (Queue& queue : waiting_)
    while (!queue.empty()) drop(queue);
  for (std::size_t i = 0; i < gates_.size(); ++i)
    if (i != first) gates_[i].startNewSeries();
}

RejectCounts UniformGrid::rejected() const {
  RejectCounts all = rejected_;
  for (const StreamGate& gate : gates_) all += gate.rejected();
  return all;
}

}  // namespace suspension_health_monitor
