#include "survey.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "../ros/conversions.h"
#include "bag_samples.h"
#include "command.h"
#include "suspension_health_monitor/internal/identification/clock_lag.h"
#include "suspension_health_monitor/internal/identification/horizon_survey.h"
#include "suspension_health_monitor/internal/signal/continuity.h"
#include "suspension_health_monitor/internal/signal/period_measurement.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

// Of each topic: the mean of n spacings has 1/n of a stamp's jitter.
constexpr std::size_t kMessagesForPeriod = 10000, kCheckedMessages = 1000;

// A horizon is proposed from stretches that lie all over the drive: it may begin parked, or be rough for a short time
// only. What stands still weighs little beside what moves.
constexpr int kStretch = 2500;  // [samples]

constexpr std::size_t kLookedAt = 40000;  // samples, for an offset of the clocks

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

/// What a survey came across.
struct Surveyed {
  Drive drive;
  UniformGrid grid;
  double period;
  std::size_t samples, gaps;
  std::size_t longest;  // samples in one piece
  RejectCounts rejected;
};

Surveyed readInto(HorizonSurvey& survey, const ImuBags& bags, const PipelineOptions& options) {
  const Stamp period = fromSeconds(*options.monitor.sample_period);
  std::optional<Stamp> last;
  std::size_t count = 0, gaps = 0, piece = 0, longest = 0;
  RejectCounts too_soon;
  Drive drive;
  ReadSamples read = readSamples(bags, options, [&](const CornerSample& sample) {
    const Continuity follows = last ? continuity(sample.stamp - *last, period) : Continuity::kContinues;
    const bool is_extra = follows == Continuity::kTooSoon;
    if (follows == Continuity::kGap || follows == Continuity::kClockJumped) {
      ++gaps;
      piece = 0;
      survey.interrupt();
    }
    if (is_extra) too_soon.add(RejectReason::kTooSoon);
    if (!is_extra) {
      survey.push(sample);
      longest = std::max(longest, ++piece);
      if (count < kLookedAt) drive.samples.push_back(sample);
    }
    last = sample.stamp;
    ++count;
    return true;
  });
  read.rejected += too_soon;
  return {std::move(drive), std::move(read.grid), *options.monitor.sample_period, count, gaps, longest, read.rejected};
}

std::string describeClockLag(double lag) {
  char text[120];
  std::snprintf(text, sizeof text, "; the clocks of the IMUs seem to differ by about %.0f ms: diagnose tells",
                1e3 * std::abs(lag));
  return text;
}

[[noreturn]] void refuse(const Surveyed& surveyed, const HorizonSurvey& survey,
                         const std::optional<LaggedStrut>& lagged) {
  const bool is_short = static_cast<double>(surveyed.longest) * surveyed.period < kTwoBounces;
  throw TooLittleError(
      "no horizon can be proposed: " +
      std::string(surveyed.samples == 0 ? "no pair of readings can be used" : "the data show no damped spring") +
      " (samples " + std::to_string(surveyed.samples) +
      formatted(" in %.3g s", static_cast<double>(surveyed.samples) * surveyed.period) + ", gaps " +
      std::to_string(surveyed.gaps) + (is_short ? "; two bounces of the body in one piece are enough" : "") +
      describeRejected(surveyed.rejected) + ")" +
      (lagged ? describeClockLag(lagged->model.reading.front().coefficients.front())
              : describeSuspicions(surveyed.grid, survey.dampingIsNegative())) +
      "; give integration_horizon (--set integration_horizon=0.6) to look at them all the same");
}

int proposeHorizonSamples(const ImuBags& bags, const PipelineOptions& options, bool clocks_may_differ) {
  const double period = *options.monitor.sample_period;
  const IntegrationRule rule = MonitorSettings(options.monitor).estimators.rule;
  const double share = HorizonSurvey::kEnough * period / duration(bags);
  if (share < 1.0) {
    ImuBags stretches = bags;
    stretches.stretches = ImuBags::Stretches{kStretch * period / share, kStretch * period};
    HorizonSurvey survey(period, rule, kStretch / 2);
    readInto(survey, stretches, options);
    if (survey.isClear()) return *survey.horizonSamples();
  }
  HorizonSurvey survey(period, rule, HorizonSurvey::kLongest);
  const Surveyed surveyed = readInto(survey, bags, options);
  const std::optional<int> samples = survey.horizonSamples();
  if (samples) return *samples;
  const std::optional<LaggedStrut> lagged = lookForClockLag({surveyed.drive}, period);
  if (!lagged || !clocks_may_differ) refuse(surveyed, survey, lagged);
  return lagged->horizon_samples;
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

void measureOpenSettings(const ImuBags& bags, PipelineOptions& options, bool clocks_may_differ) {
  MonitorOptions& monitor = options.monitor;
  if (!monitor.sample_period) monitor.sample_period = measurePeriod(bags);
  if (!monitor.integration_horizon)
    monitor.integration_horizon = proposeHorizonSamples(bags, options, clocks_may_differ) * *monitor.sample_period;
}

void requireFittingPeriod(const ImuBags& bags, double sample_period) {
  std::size_t count = kCheckedMessages;
  const std::string short_period = describeShortPeriod(sample_period, stampSpacing(bags, count));
  if (!short_period.empty()) throw std::invalid_argument(short_period);
}

}  // namespace suspension_health_monitor
