#include "suspension_health_monitor/internal/vehicle/rough_strut.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "suspension_health_monitor/internal/blocks/tuning.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

// The first blocks that are tried, over the length that is asked for, and by how much of it the body's clock is taken
// for late. A short drive has no three blocks of that length. Struts that bounce far slower or faster than it is for
// come last.
constexpr std::pair<double, double> kTrials[] = {{1.0, 0.0}, {1.0, 0.01}, {1.0, -0.01}, {1.0, 0.02},      {1.0, -0.02},
                                                 {0.5, 0.0}, {8.0, 0.0},  {0.125, 0.0}, {1.0 / 32.0, 0.0}};

std::optional<RoughStrut> find(const std::vector<Drive>& drives, double period, double length, double lag) {
  VehicleBlocks blocks(VehicleChannels::ofAccelerometers(), period, length);
  for (const Drive& drive : drives) {
    blocks.restart();
    for (const CornerSample& sample : drive.samples) blocks.push(sample, fromSeconds(lag));
  }
  if (const std::optional<TopEstimate> all = blocks.overTheDrive()) return RoughStrut(*all, lag);
  if (blocks.estimate() != nullptr) return RoughStrut(*blocks.estimate(), lag);  // by blocks of another length
  return std::nullopt;
}

}  // namespace

RoughStrut::RoughStrut(const WindowEstimate& estimate, double lag) {
  const double b1 = estimate.theta[kBlockDamping], b0 = estimate.theta[kBlockStiffness];
  const double friction = estimate.frictionGain() * estimate.theta[kNumBlockParameters];
  strut = {leastDamping(b1 + friction, b0), b0};
  explained = estimate.explained;
  clock_offset = lag - estimate.theta[kBlockDelay];
  clock_offset_stddev = std::sqrt(estimate.covariance(kBlockDelay, kBlockDelay));
}

bool RoughStrut::clocksDiffer(double period) const {
  return std::abs(clock_offset) > std::max({kBlockTuning.least_delay, period / 2.0, kCertain * clock_offset_stddev});
}

int RoughStrut::horizonSamples(double period) const {
  return suspension_health_monitor::horizonSamples(proposeHorizon(strut.damping_to_mass, strut.stiffness_to_mass),
                                                   period);
}

std::optional<RoughStrut> roughStrut(const std::vector<Drive>& drives, double period, double length) {
  std::optional<RoughStrut> best;
  for (const auto& [blocks, lag] : kTrials) {
    const auto found = find(drives, period, blocks * length, lag * length);
    if (found && (!best || found->explained > best->explained)) best = found;
    if (best && best->explained > kMajority) break;
  }
  return best;
}

}  // namespace suspension_health_monitor
