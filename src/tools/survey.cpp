#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "../ros/conversions.h"
#include "bag_options.h"
#include "command.h"
#include "recorded_drives.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/blocks/tuning.h"
#include "suspension_health_monitor/internal/record/motion.h"
#include "suspension_health_monitor/internal/signal/period_measurement.h"
#include "suspension_health_monitor/internal/vehicle/rough_strut.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {
namespace {

// Of each topic: the mean of n spacings has 1/n of a stamp's jitter.
constexpr std::size_t kMessagesForPeriod = 10000, kCheckedMessages = 1000;

// Relative standard deviation of b1 and b0 that proposes a horizon: that is off by half as much.
constexpr double kEnough = 0.15;

constexpr std::size_t kLookedAt = 40000;  // samples, where blocks show no strut at once

// Of the topics that are needed.  @param count  messages of each to look at; becomes those that there were of all.
std::optional<double> stampSpacing(const ImuBags& bags, std::size_t& count) {
  PeriodMeasurement measurement(PeriodMeasurement::kFewestOfRecording, mapped(bags.topics, &BagTopic::is_needed));
  const std::size_t most = std::exchange(count, 0) * bags.topics.size();
  const auto take = [&](std::size_t topic, const auto& message, Stamp) {
    measurement.add(topic, toStamp(message.header.stamp));
    return ++count < most;
  };
  readTopics(bags, {take, take});
  return measurement.period();
}

/// @return what the bags tell of a strut alone: the strut, empty: they show no damped spring; and the range of the
/// motion that was read until it was known.
std::pair<std::optional<RoughStrut>, std::optional<MotionRange>> survey(const BagOptions& options) {
  VehicleBlocks blocks(VehicleChannels::ofAccelerometers(), options.period());
  std::optional<RoughStrut> rough;
  Drive drive;
  // A few blocks of a law with memory look as if the clocks differed, the whole drive does not.
  const auto isOpen = [&] { return !rough || rough->clocksDiffer(options.period()); };
  const auto take = [&](const VehicleSample& of_vehicle) {
    const CornerSample sample = of_vehicle.ofStrut(0);
    if (drive.samples.size() < kLookedAt) drive.samples.push_back(sample);
    const TopEstimate* estimate = blocks.push(sample);
    if (estimate != nullptr && estimate->worst() < kEnough) rough.emplace(*estimate);
    return isOpen();
  };
  readSamples(options.bags, options.settings.common, options.vehicle.layout, {take});
  if (const auto all = isOpen() ? blocks.overTheDrive() : std::nullopt) rough.emplace(*all);
  if (!rough) rough = roughStrut({drive}, options.period());
  return {rough, rangeOfMotion(pointersTo(makeRecords({drive}, options.period(), StrutModel())))};
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

BagOptions readBagOptions(const po::variables_map& values) {
  BagOptions options = readLiveOptions(values);
  MonitorOptions& common = options.settings.common.monitor;
  if (options.period_measured) common.sample_period = measurePeriod(options.bags);
  for (PipelineOptions& strut : options.settings.struts) strut.monitor.sample_period = common.sample_period;
  if (!options.vehicle.isStrutAlone() || common.integration_horizon) return options;
  const auto [rough, range] = survey(options);
  if (range && range->isOneFrequency()) options.one_frequency = range;
  if (rough) {
    options.horizon_measured = true;
    common.integration_horizon = rough->horizonSamples(options.period()) * options.period();
    options.settings.struts.front().monitor.integration_horizon = common.integration_horizon;
    // Laws with memory turn the phase as a delay does: of a strut that explains nearly all, on a wide band, it is one.
    if (range && range->isWide() && rough->explained > kBlockTuning.nearly_all && rough->clocksDiffer(options.period()))
      options.clock_offset = rough->clock_offset;
  }
  return options;
}

void requireFittingPeriod(const ImuBags& bags, double sample_period) {
  std::size_t count = kCheckedMessages;
  const std::string short_period = describeShortPeriod(sample_period, stampSpacing(bags, count));
  if (!short_period.empty()) throw std::invalid_argument(short_period);
}

}  // namespace suspension_health_monitor
