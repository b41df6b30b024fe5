#include "suspension_health_monitor/internal/record/drive_record.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/signal/filters.h"
#include "suspension_health_monitor/internal/signal/readings.h"

namespace suspension_health_monitor {
namespace {

constexpr int kStuckRepeats = 4;  // a value that is read so many times again is a stuck one
constexpr std::size_t kShortestSegment = 32;

/// @param values  of a channel, one per message.
/// @return the channel at an instant.
double valueAt(Stamp stamp, const std::vector<BodyMotion>& motion, const std::vector<double>& values) {
  const auto after =
      std::lower_bound(motion.begin(), motion.end(), stamp, [](const BodyMotion& m, Stamp s) { return m.stamp < s; });
  const auto i = static_cast<std::size_t>(after - motion.begin());
  if (i == 0) return values.front();
  if (after == motion.end()) return values.back();
  const double share = toSeconds(stamp - motion[i - 1].stamp) / toSeconds(motion[i].stamp - motion[i - 1].stamp);
  return (1.0 - share) * values[i - 1] + share * values[i];
}

/// @return false where a channel is not measured, or does not change.
bool tells(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return std::all_of(values.begin(), values.end(), isUsable) &&
         *most - *least > kRounding * std::max(std::abs(*least), std::abs(*most));
}

void addAcceleration(const std::vector<BodyMotion>& motion, std::size_t axis, std::vector<DriveSegment>& segments) {
  const auto values = mapped(motion, [axis](const BodyMotion& m) { return m.acceleration[axis]; });
  if (!tells(values)) return;
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  for (DriveSegment& segment : segments)
    for (const Stamp stamp : segment.stamps) segment.body[axis].push_back(valueAt(stamp, motion, values) - mean);
}

void addAngularAcceleration(const std::vector<BodyMotion>& motion, std::size_t axis,
                            std::vector<DriveSegment>& segments) {
  const auto rates = mapped(motion, [axis](const BodyMotion& m) { return m.angular_rate[axis]; });
  if (!tells(rates)) return;
  const double period = segments.front().period;
  const int margin = kWidestSlope;
  std::vector<std::vector<double>> series;  // with a margin on both sides, where messages are, too
  for (const DriveSegment& segment : segments) {
    series.emplace_back();
    const auto aside = [&](Stamp stamp, int k) {
      series.back().push_back(valueAt(stamp + k * fromSeconds(period), motion, rates));
    };
    for (int k = -margin; k < 0; ++k) aside(segment.stamps.front(), k);
    for (const Stamp stamp : segment.stamps) aside(stamp, 0);
    for (int k = 1; k <= margin; ++k) aside(segment.stamps.back(), k);
  }
  const Eigen::VectorXd weights = fittingSlope(series, period);
  for (std::size_t s = 0; s < segments.size(); ++s)
    for (std::size_t k = 0; k < segments[s].size(); ++k)
      segments[s].body[2 + axis].push_back(weightedSlope(&series[s][k + margin], weights));
}

/// The samples of an uninterrupted part of a drive, by their places in it.
using Stretch = std::vector<std::size_t>;

std::vector<Stretch> stretchesOf(const Drive& drive, double period) {
  std::vector<Stretch> stretches;
  int sprung_repeats = 0, wheel_repeats = 0;  // of the last reading
  const CornerSample* last = nullptr;
  for (std::size_t k = 0; k < drive.samples.size(); ++k) {
    const CornerSample& sample = drive.samples[k];
    const Continuity follows =
        last == nullptr ? Continuity::kGap : continuity(sample.stamp - last->stamp, fromSeconds(period));
    if (follows == Continuity::kTooSoon) continue;
    if (follows == Continuity::kContinues) {
      sprung_repeats = sample.sprung_acceleration == last->sprung_acceleration ? sprung_repeats + 1 : 0;
      wheel_repeats = sample.unsprung_acceleration == last->unsprung_acceleration ? wheel_repeats + 1 : 0;
    } else {
      stretches.emplace_back();
      sprung_repeats = wheel_repeats = 0;
    }
    last = &sample;
    Stretch& stretch = stretches.back();
    if (std::max(sprung_repeats, wheel_repeats) < kStuckRepeats) {
      stretch.push_back(k);
    } else if (!stretch.empty()) {  // the readings that turn out to be stuck are in it already
      stretch.resize(stretch.size() - std::min<std::size_t>(stretch.size(), kStuckRepeats));
      stretches.emplace_back();
    }
  }
  return stretches;
}

/// @param mean  of w''.
/// @return nothing of a stretch that is too short.
std::optional<DriveSegment> segmentOf(const Drive& drive, const Stretch& stretch, double mean, double period,
                                      int steps) {
  const LowPass& filter = drive.low_pass;
  const std::size_t end = kInterpolationReach;
  const std::size_t lead = filter.taps.size() / 2;
  if (stretch.size() < 2 * (end + lead) + kShortestSegment) return std::nullopt;
  std::vector<double> driving;
  for (const std::size_t k : stretch)
    driving.push_back((filter.taps.empty() ? drive.samples[k].unsprung_acceleration : filter.unfiltered[k]) - mean);

  DriveSegment segment;
  const std::size_t first = end + lead, last = driving.size() - 1 - end;
  segment.start = toSeconds(drive.samples[stretch.front()].stamp - drive.samples.front().stamp) +
                  static_cast<double>(first) * period;
  segment.period = period;
  segment.steps = steps;
  segment.taps = filter.taps;
  for (std::size_t i = first; i <= last - lead; ++i) {
    const CornerSample& sample = drive.samples[stretch[i]];
    segment.sprung.push_back(sample.sprung_acceleration - mean);
    segment.body[static_cast<std::size_t>(BodyChannel::kGravity)].push_back(mean);
    segment.stamps.push_back(sample.stamp);
    segment.unsprung.push_back(sample.unsprung_acceleration - mean);
    segment.driving.push_back(driving[i]);
  }
  const std::vector<WheelInterpolator> interpolators = WheelInterpolator::ofSample(steps, period);
  for (std::size_t k = end; k < last; ++k)
    for (const WheelInterpolator& interpolate : interpolators)
      segment.wheel.push_back(interpolate(&driving[k + 1 - end]));
  return segment;
}

bool isKnown(const Records& records, BodyChannel channel) {
  const Segments segments = segmentsOf(records);
  return std::none_of(segments.begin(), segments.end(), [&](const DriveSegment* segment) {
    return segment->body[static_cast<std::size_t>(channel)].empty();
  });
}

}  // namespace

DriveRecord::DriveRecord(const Drive& drive, double period, int steps, double driven_before)
    : period_(period), noise_(drive.noise) {
  const std::vector<Stretch> stretches = stretchesOf(drive, period);
  double sum = 0.0, count = 0.0;
  for (const Stretch& stretch : stretches) {
    for (const std::size_t k : stretch) sum += drive.samples[k].unsprung_acceleration;
    count += static_cast<double>(stretch.size());
  }
  mean_wheel_ = count > 0.0 ? sum / count : 0.0;
  for (const Stretch& stretch : stretches)
    if (std::optional<DriveSegment> segment = segmentOf(drive, stretch, mean_wheel_, period, steps)) {
      segment->driven_before = driven_before;
      segments_.push_back(*std::move(segment));
    }
  if (drive.body.empty() || segments_.empty()) return;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    addAcceleration(drive.body, axis, segments_);
    addAngularAcceleration(drive.body, axis, segments_);
  }
}

std::size_t DriveRecord::numSamples() const {
  std::size_t count = 0;
  for (const DriveSegment& segment : segments_) count += segment.size();
  return count;
}

Segments segmentsOf(const Records& records) {
  Segments all;
  for (const DriveRecord* record : records)
    for (const DriveSegment& segment : record->segments()) all.push_back(&segment);
  return all;
}

double restBetween(const DriveSegment& before, const DriveSegment& after) {
  return toSeconds(after.stamps.front() - before.stamps.back());
}

std::deque<DriveRecord> makeRecords(const std::vector<Drive>& drives, double period, const StrutModel& model) {
  const double exact = stepsPerSample(model.damping_to_mass, model.stiffness_to_mass, period);
  const int steps = std::max(1, static_cast<int>(std::ceil(exact)));
  std::deque<DriveRecord> records;
  double driven = 0.0;
  for (const Drive& drive : drives) {
    records.emplace_back(drive, period, steps, driven);
    if (!drive.samples.empty()) driven += toSeconds(drive.samples.back().stamp - drive.samples.front().stamp);
  }
  return records;
}

Records pointersTo(const std::deque<DriveRecord>& records) {
  return mapped(records, [](const DriveRecord& record) { return &record; });
}

std::vector<std::pair<std::string, BodyChannel>> takeUntestable(EffectLibrary& library, const Records& records) {
  const auto isTestable = [&](const MeasurementEffect& effect) {
    return effect.channels.empty() || std::any_of(effect.channels.begin(), effect.channels.end(),
                                                  [&](BodyChannel channel) { return isKnown(records, channel); });
  };
  return mapped(takeUnless(library.readings, isTestable),
                [](const MeasurementEffect& effect) { return std::pair(effect.name, effect.channels.front()); });
}

std::optional<std::pair<std::string, BodyChannel>> findUntestable(const StrutModel& model, const Records& records) {
  ReadingSizes sizes{1.0, 1.0, 1.0, {}};
  for (std::size_t c = 0; c < kNumBodyChannels; ++c) sizes.body[c] = isKnown(records, static_cast<BodyChannel>(c));
  for (const auto& [effect, coefficients] : model.reading) {
    const auto missing = std::find_if(effect.channels.begin(), effect.channels.end(),
                                      [&](BodyChannel channel) { return !isKnown(records, channel); });
    for (std::size_t i = 0; i < coefficients.size(); ++i)
      if (coefficients[i] != 0.0 && !std::isfinite(effect.scale(sizes, i))) return std::pair(effect.name, *missing);
  }
  return std::nullopt;
}

}  // namespace suspension_health_monitor
