#include "suspension_health_monitor/signal/uniform_grid.h"

#include <algorithm>
#include <sstream>
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
      judge_(period_, options.fill_samples),
      resamples_(options.alignment == Alignment::kResampled),
      gates_{StreamGate(period_), StreamGate(period_), StreamGate(period_)} {
  if (options.alignment != Alignment::kPaired) resampled_.emplace(period_, options.has_road);
}

std::optional<CornerSample> UniformGrid::push(Side side, Stamp stamp, double acceleration) {
  if (!admit(side, stamp, acceleration)) return std::nullopt;
  const auto index = static_cast<std::size_t>(side);
  const Reading reading{stamp, acceleration, gates_[index].isStill()};
  if (resamples_) {
    resample(side, reading);
    return resampled_->next();
  }
  if (waiting_[index].full()) drop(waiting_[index]);
  waiting_[index].push(reading);
  if (side == Side::kRoad) road_is_silent_ = false;
  return next();
}

std::optional<CornerSample> UniformGrid::next() {
  if (!resamples_)
    if (const std::optional<CornerSample> sample = match()) return sample;
  return resamples_ ? resampled_->next() : std::nullopt;
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
  while (!sprung.empty() && !unsprung.empty() && !resamples_) {
    const Reading body = sprung.front();
    const Reading wheel = unsprung.front();
    if (2 * std::chrono::abs(body.stamp - wheel.stamp) <= period_) {
      if (options_.has_road && !findRoad(body.stamp)) return std::nullopt;
      sprung.pop();
      unsprung.pop();
      if (resampled_) judge_.addPair(body.stamp, wheel.stamp);
      if (judge_.verdict() != AlignmentJudge::Verdict::kDoesWell) startResampling();
      if (body.still != wheel.still) {
        rejected_.add(RejectReason::kStuck);
        continue;
      }
      return CornerSample{body.stamp, body.acceleration, wheel.acceleration};
    }
    drop(body.stamp < wheel.stamp ? sprung : unsprung);
    if (resampled_) judge_.addLone();
    if (judge_.verdict() != AlignmentJudge::Verdict::kDoesWell) startResampling();
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

void UniformGrid::resample(Side side, const Reading& reading) {
  const double own_period = gates_[static_cast<std::size_t>(side)].timing().period();
  resampled_->push(side, reading.stamp, reading.acceleration, reading.still, own_period);
}

void UniformGrid::startResampling() {
  resamples_ = true;
  for (std::size_t i = 0; i < waiting_.size(); ++i)
    for (; !waiting_[i].empty(); waiting_[i].pop()) resample(static_cast<Side>(i), waiting_[i].front());
}

// @param first  the stream whose clock went back before those of the others.
void UniformGrid::startNewSeries(std::size_t first) {
  judge_.startNewSeries();
  if (resampled_) resampled_->startNewSeries();
  for (Queue& queue : waiting_)
    while (!queue.empty()) drop(queue);
  for (std::size_t i = 0; i < gates_.size(); ++i)
    if (i != first) gates_[i].startNewSeries();
}

std::string UniformGrid::whatIsTooSlow() const {
  const double spacing = std::max(gate(Side::kSprung).timing().period(), gate(Side::kUnsprung).timing().period());
  if (spacing < 1.5 * toSeconds(period_)) return "";
  std::ostringstream text;
  text.precision(4);
  text << "readings come every " << spacing << " s (" << 1.0 / spacing
       << " Hz), but sample_period = " << toSeconds(period_) << " [s]";
  return text.str();
}

std::string UniformGrid::why() const {
  const std::string slow = judge_.verdict() == AlignmentJudge::Verdict::kInterrupted ? whatIsTooSlow() : "";
  return slow.empty() ? describe(judge_.verdict()) : slow;
}

std::string UniformGrid::describeAlignment() const {
  if (!resamples_) return "paired";
  return why().empty() ? "resampled" : "resampled because " + why();
}

RejectCounts UniformGrid::rejected() const {
  RejectCounts all = rejected_;
  if (resampled_) all += resampled_->rejected();
  for (const StreamGate& gate : gates_) all += gate.rejected();
  return all;
}

}  // namespace suspension_health_monitor
