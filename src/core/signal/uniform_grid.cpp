#include "suspension_health_monitor/internal/signal/uniform_grid.h"

#include <vector>

namespace suspension_health_monitor {
namespace {

// One sensor each, in the order of Side.
std::vector<StreamOptions> streamsOf(const GridOptions& options) {
  std::vector<StreamOptions> streams{{indexOf(Side::kSprung), true}, {indexOf(Side::kUnsprung), true}};
  if (options.has_road) streams.push_back({indexOf(Side::kRoad), false});
  return streams;
}

}  // namespace

UniformGrid::UniformGrid(double period, const GridOptions& options)
    : has_road_(options.has_road), streams_(period, streamsOf(options), options.alignment, options.fill_samples) {}

std::optional<CornerSample> UniformGrid::push(Side side, Stamp stamp, double acceleration) {
  if (side == Side::kRoad && !has_road_) return std::nullopt;
  return take(streams_.push(indexOf(side), stamp, acceleration));
}

std::optional<CornerSample> UniformGrid::take(const GridInstant* instant) {
  if (instant == nullptr) return std::nullopt;
  const std::vector<double>& values = instant->values;
  const bool has_road = has_road_ && instant->measured[indexOf(Side::kRoad)];
  road_acceleration_ = has_road ? std::optional<double>(values[indexOf(Side::kRoad)]) : std::nullopt;
  return CornerSample{instant->stamp, values[indexOf(Side::kSprung)], values[indexOf(Side::kUnsprung)]};
}

}  // namespace suspension_health_monitor
