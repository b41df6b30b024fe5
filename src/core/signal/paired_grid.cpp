#include "suspension_health_monitor/internal/signal/paired_grid.h"

namespace suspension_health_monitor {

std::optional<CornerSample> PairedGrid::next(WaitingReadings& waiting) {
  ReadingQueue& sprung = waiting[Side::kSprung];
  ReadingQueue& unsprung = waiting[Side::kUnsprung];
  const bool is_judged = options_.alignment == Alignment::kAuto;
  while (!sprung.empty() && !unsprung.empty() && judge_.verdict() == AlignmentJudge::Verdict::kDoesWell) {
    const SensorReading body = sprung.front(), wheel = unsprung.front();
    if (2 * std::chrono::abs(body.stamp - wheel.stamp) > period_) {
      drop(body.stamp < wheel.stamp ? sprung : unsprung);
      if (is_judged) judge_.addLone();
      continue;
    }
    if (options_.has_road && !findRoad(body.stamp, waiting)) return std::nullopt;
    sprung.pop_front();
    unsprung.pop_front();
    if (is_judged) judge_.addPair(body.stamp, wheel.stamp);
    if (body.still == wheel.still) return CornerSample{body.stamp, body.acceleration, wheel.acceleration};
    rejected_.add(RejectReason::kStuck);
  }
  return std::nullopt;
}

// @return false: the road's reading of this instant may still come.
bool PairedGrid::findRoad(Stamp stamp, WaitingReadings& waiting) {
  ReadingQueue& road = waiting[Side::kRoad];
  road_acceleration_.reset();
  if (!road.empty()) road_is_silent_ = false;
  while (!road.empty() && 2 * (stamp - road.front().stamp) > period_) drop(road);
  if (road.empty()) {
    road_is_silent_ = road_is_silent_ || waiting[Side::kSprung].size() > kMostRoadLag;
    return road_is_silent_;
  }
  if (2 * (road.front().stamp - stamp) > period_) return true;
  road_acceleration_ = road.front().acceleration;
  road.pop_front();
  return true;
}

void PairedGrid::drop(ReadingQueue& queue) {
  rejected_.add(RejectReason::kMissingPartner);
  queue.pop_front();
}

void PairedGrid::startNewSeries(WaitingReadings& waiting) {
  judge_.startNewSeries();
  for (const Side side : {Side::kSprung, Side::kUnsprung, Side::kRoad})
    while (!waiting[side].empty()) drop(waiting[side]);
}

}  // namespace suspension_health_monitor
