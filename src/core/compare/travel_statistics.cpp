#include "suspension_health_monitor/internal/compare/travel_statistics.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kBin = 0.5;        // rms: extremes are some four, which makes 16 bins
constexpr double kMostBins = 50.0;  // per direction: a strut that is hit now and then

TimeHistogram::Direction directionOf(const Eigen::VectorXd& values) {
  const Eigen::VectorXd sizes = values.cwiseMax(0.0);
  const double count = static_cast<double>((values.array() > 0.0).count());
  return {count / static_cast<double>(values.size()), count > 0.0 ? sizes.sum() / count : 0.0, sizes.maxCoeff()};
}

TimeHistogram histogramOf(const FreeMotion& motion, double StrutState::*which) {
  std::vector<double> all;
  for (const std::vector<StrutState>& segment : motion)
    for (const StrutState& state : segment) all.push_back(state.*which);
  const Eigen::Map<const Eigen::VectorXd> values(all.data(), all.size());
  TimeHistogram histogram;
  if (!(values.squaredNorm() > 0.0)) return histogram;
  const double rms = values.norm() / std::sqrt(static_cast<double>(values.size()));
  const double width = std::max(kBin * rms, values.cwiseAbs().maxCoeff() / kMostBins);
  const auto binOf = [&](double value) { return static_cast<int>(std::floor(value / width)); };
  const int first = std::min(0, binOf(values.minCoeff())), last = std::max(0, binOf(values.maxCoeff()) + 1);
  for (int i = first; i <= last; ++i) histogram.edges.push_back(i * width);
  histogram.shares.resize(last - first);
  for (const double value : all) histogram.shares[binOf(value) - first] += 1.0 / static_cast<double>(values.size());
  histogram.compression = directionOf(values);
  histogram.rebound = directionOf(-values);
  return histogram;
}

/// @param direction  1 of a stop in compression, -1 in rebound.
StopUse useOf(const FreeMotion& motion, const ActiveEffect& stop, double direction) {
  StopUse use{stop.effect.name, stop.shapes.front()};
  double count = 0.0;
  for (const std::vector<StrutState>& segment : motion) {
    bool may_hit = true;
    for (const StrutState& state : segment) {
      const double travel = direction * state.travel;
      const bool is_near = travel > (1.0 - kSmall) * use.gap, hits = may_hit && travel > use.gap;
      count += 1.0;
      use.near += is_near ? 1.0 : 0.0;
      use.hits += hits ? 1 : 0;
      may_hit = !is_near || (may_hit && !hits);
    }
  }
  use.near /= count;
  return use;
}

}  // namespace

TravelStatistics travelStatistics(const Records& records, const StrutModel& model) {
  const Segments segments = segmentsOf(records);
  const auto initial = segments.empty() ? std::nullopt : estimateInitialStates(records, model);
  if (!initial) return {};
  FreeMotion motion;
  if (!freeRunResiduals(model, segments, *initial, &motion)) return {};
  TravelStatistics statistics{
      histogramOf(motion, &StrutState::travel), histogramOf(motion, &StrutState::travel_rate), {}};
  for (const ActiveEffect& effect : model.effects)
    if (effect.effect.name == "bump_stop" || effect.effect.name == "rebound_stop")
      statistics.stops.push_back(useOf(motion, effect, effect.effect.name == "bump_stop" ? 1.0 : -1.0));
  return statistics;
}

}  // namespace suspension_health_monitor
