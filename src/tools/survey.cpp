#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "../ros/conversions.h"
#include "bag_options.h"
#include "command.h"
#include "recorded_drives.h"
#include "suspension_health_monitor/internal/fit/rough_strut.h"
#include "suspension_health_monitor/internal/signal/continuity.h"
#include "suspension_health_monitor/internal/signal/period_measurement.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

// Of each topic: the mean of n spacings has 1/n of a stamp's jitter.
constexpr std::size_t kMessagesForPeriod = 10000, kCheckedMessages = 1000;

// Relative standard deviation of b1 and b0 that proposes a horizon: that is off by half as much.
constexpr double kEnough = 0.15;

constexpr std::size_t kLookedAt = 40000;  // samples, where blocks show no strut at once

// Two bounces of the slowest body, whose springs a weight presses down by a metre [s]: 2 * 2 pi sqrt(1 m / g).
constexpr double kTwoBounces = 4.0;

// Of the topics that are needed.  @param count  messages of each to look at; becomes those that there were of all.
std::optional<double> stampSpacing(const ImuBags& bags, std::size_t& count) {
  std::vector<bool> is_required(bags.topics.size() - bags.not_needed, true);
  is_required.resize(bags.topics.size(), false);
  is_required.resize(bags.topics.size() + bags.wrench_topics.size(), true);
  PeriodMeasurement measurement(PeriodMeasurement::kFewestOfRecording, is_required);
  const std::size_t most = std::exchange(count, 0) * is_required.size();
  const auto take = [&](std::size_t topic, const auto& message, Stamp) {
    measurement.add(topic, toStamp(message.header.stamp));
    return ++count < most;
  };
  readTopics(bags, {take, take});
  return measurement.period();
}

/// What was read until the blocks knew the strut, or to the end.
struct Surveyed {
  std::optional<RoughStrut> rough;
  bool clocks_differ;  // so that blocks show no strut before they are set right
  Drive drive;         // its beginning
  StreamGrid grid;
  std::size_t samples, gaps;
  std::size_t longest;  // samples in one piece
  RejectCounts rejected;
};

Surveyed survey(const BagOptions& options) {
  const double period = options.period();
  StrutBlocks blocks({}, period);
  std::optional<RoughStrut> rough;
  std::optional<Stamp> last;
  std::size_t count = 0, gaps = 0, piece = 0, longest = 0;
  RejectCounts rejected;
  Drive drive;
  const auto take = [&](const VehicleSample& of_vehicle) {
    const CornerSample sample = of_vehicle.ofStrut(0);
    const Continuity follows = last ? continuity(sample.stamp - *last, fromSeconds(period)) : Continuity::kContinues;
    last = sample.stamp;
    ++count;
    if (follows == Continuity::kTooSoon) {
      rejected.add(RejectReason::kTooSoon);
      return true;
    }
    if (follows != Continuity::kContinues) {
      ++gaps;
      piece = 0;
    }
    longest = std::max(longest, ++piece);
    if (count < kLookedAt) drive.samples.push_back(sample);
    const BlockEstimate* estimate = blocks.push(sample);
    if (estimate != nullptr && estimate->worst() < kEnough) rough.emplace(*estimate);
    return !rough;
  };
  const ReadSamples read = readSamples(options.bags, options.settings.common, options.vehicle.layout, {take});
  if (const auto all = blocks.overTheDrive(); all && !rough) rough.emplace(*all);
  const bool is_seen = rough.has_value();
  if (!is_seen) rough = roughStrut({drive}, period);
  const bool clocks_differ = !is_seen && rough && rough->clocksDiffer(period);
  for (const RejectCounts& of_sensor : read.rejected) rejected += of_sensor;
  return {rough, clocks_differ, std::move(drive), read.grid.streams(), count, gaps, longest, rejected};
}

[[noreturn]] void refuse(const Surveyed& surveyed, double period) {
  const bool is_short = static_cast<double>(surveyed.longest) * period < kTwoBounces;
  throw TooLittleError(
      "no horizon can be proposed: " +
      std::string(surveyed.samples == 0 ? "no pair of readings can be used" : "the data show no damped spring") +
      " (samples " + std::to_string(surveyed.samples) +
      formatted(" in %.3g s", static_cast<double>(surveyed.samples) * period) + ", gaps " +
      std::to_string(surveyed.gaps) + (is_short ? "; two bounces of the body in one piece are enough" : "") +
      describeRejected(surveyed.rejected) + ")" +
      (surveyed.rough ? formatted("; the clocks of the IMUs seem to differ by about %.0f ms: diagnose tells",
                                  1e3 * std::abs(surveyed.rough->clock_offset))
                      : describeSuspicions(surveyed.grid, {surveyed.drive}, period)) +
      "; give integration_horizon (--set integration_horizon=0.6) to look at them all the same");
}

int proposeHorizonSamples(const BagOptions& options, bool clocks_may_differ) {
  const double period = options.period();
  const Surveyed surveyed = survey(options);
  if (!surveyed.rough || (surveyed.clocks_differ && !clocks_may_differ)) refuse(surveyed, period);
  return surveyed.rough->horizonSamples(period);
}

}  // namespace

double measurePeriod(const ImuBags& bags) {
  std::size_t count = kMessagesForPeriod;
  const std::optional<double> period = stampSpacing(bags, count);
  if (!period) throw TooLittleError(describeNoPeriod("on one of the topics", count));
  try {
    MonitorOptions options;
    options.sample_period = period;
    validate(options, kMonitorFields);
  } catch (const std::invalid_argument& error) {
    throw InputError(std::string("measured from the stamps: ") + error.what());
  }
  return *period;
}

BagOptions readBagOptions(const boost::program_options::variables_map& values, bool clocks_may_differ) {
  BagOptions options = readLiveOptions(values);
  MonitorOptions& common = options.settings.common.monitor;
  if (options.period_measured) common.sample_period = measurePeriod(options.bags);
  for (PipelineOptions& strut : options.settings.struts) strut.monitor.sample_period = common.sample_period;
  options.horizon_measured = options.vehicle.isStrutAlone() && !common.integration_horizon;
  if (!options.horizon_measured) return options;
  common.integration_horizon = proposeHorizonSamples(options, clocks_may_differ) * options.period();
  options.settings.struts.front().monitor.integration_horizon = common.integration_horizon;
  return options;
}

void requireFittingPeriod(const ImuBags& bags, double sample_period) {
  std::size_t count = kCheckedMessages;
  const std::string short_period = describeShortPeriod(sample_period, stampSpacing(bags, count));
  if (!short_period.empty()) throw std::invalid_argument(short_period);
}

}  // namespace suspension_health_monitor
