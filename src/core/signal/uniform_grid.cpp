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

UniformGrid::UniformGrid(double period)
    : period_(checked(period)), gates_{StreamGate(period_), StreamGate(period_)} {}

std::optional<CornerSample> UniformGrid::push(Side side, Stamp stamp, double acceleration) {
  if (!admit(side, stamp, acceleration)) return std::nullopt;
  Queue& queue = waiting_[static_cast<std::size_t>(side)];
  if (queue.full()) drop(queue);
  queue.push({stamp, acceleration, gates_[static_cast<std::size_t>(side)].isStill()});
  return match();
}

bool UniformGrid::admit(Side side, Stamp stamp, double acceleration) {
  const auto index = static_cast<std::size_t>(side);
  const StreamGate::Verdict verdict = gates_[index].judge(stamp, acceleration);
  if (verdict == StreamGate::Verdict::kBeginsAnew) startNewSeries(1 - index);
  return verdict != StreamGate::Verdict::kRejected;
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

void UniformGrid::drop(Queue& queue) {
  rejected_.add(RejectReason::kMissingPartner);
  queue.pop();
}

void UniformGrid::startNewSeries(std::size_t other) {
  for (Queue& queue : waiting_)
    while (!queue.empty()) drop(queue);
  gates_[other].startNewSeries();
}

RejectCounts UniformGrid::rejected() const {
  RejectCounts all = rejected_;
  for (const StreamGate& gate : gates_) all += gate.rejected();
  return all;
}

}  // namespace suspension_health_monitor
