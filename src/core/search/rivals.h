#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "model_evaluator.h"
#include "suspension_health_monitor/internal/fit/free_form.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

inline constexpr double kRivalWindow = 4.0;  // natural periods

/// A function by points (x, y), in straight lines between them and on along the outermost ones.
using Polyline = std::vector<std::pair<double, double>>;

inline double valueAt(const Polyline& points, double x) {
  if (points.empty()) return 0.0;
  const auto after = std::lower_bound(points.begin() + 1, points.end() - 1, x,
                                      [](const auto& point, double value) { return point.first < value; });
  const auto& [x0, y0] = *(after - 1);
  return y0 + (x - x0) / (after->first - x0) * (after->second - y0);
}

/// @return of every window ln of rms velocity over rms position of the wheel, and the time in its middle [s].
inline Polyline windowsOf(const Records& records, double stiffness_to_mass) {
  const double length_in_time = kRivalWindow * 2.0 * M_PI / std::sqrt(stiffness_to_mass);
  Polyline windows;
  for (const DriveSegment* segment : segmentsOf(records)) {
    const auto [travel, travel_rate] = motionError(segment->unsprung, 0.0, segment->period, stiffness_to_mass);
    const auto length = static_cast<std::size_t>(std::ceil(length_in_time / segment->period));
    for (std::size_t first = 0; first + length <= segment->size(); first += length) {
      double position = 0.0, velocity = 0.0;
      for (std::size_t k = first; k < first + length; ++k) {
        position += square(travel[k]);
        velocity += square(travel_rate[k]);
      }
      if (!(position > 0.0 && velocity > 0.0)) continue;
      windows.emplace_back(0.5 * std::log(velocity / position), segment->timeDriven(first + length / 2));
    }
  }
  return windows;
}

/// For every window its own time, and the time that its frequency alone tells: the mean time of the two windows whose
/// frequencies are next to its own, one below and one above. Of the lowest and the highest frequency, where there is no
/// second neighbour, the straight line through the times of the two next windows tells it.
inline Polyline timeByFrequency(Polyline windows) {
  Polyline result;
  if (windows.size() < 3) return result;
  std::sort(windows.begin(), windows.end());
  const auto time = [&](std::size_t i) { return windows[i].second; };
  const auto last = windows.size() - 1;
  result.emplace_back(time(0), 2.0 * time(1) - time(2));
  for (std::size_t i = 1; i < last; ++i) result.emplace_back(time(i), (time(i - 1) + time(i + 1)) / 2.0);
  result.emplace_back(time(last), 2.0 * time(last - 1) - time(last - 2));
  std::sort(result.begin(), result.end());
  return result;
}

/// s of the last effect over time.
inline Polyline lastMemories(const ModelFit& fit, const Records& records) {
  Polyline points;
  std::vector<double> predicted;
  std::vector<StrutState> motion;
  const Segments segments = segmentsOf(records);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (!runFree(fit.model, *segments[s], fit.initial[s], predicted, &motion)) continue;
    for (std::size_t k = 0; k < motion.size(); ++k)
      points.emplace_back(segments[s]->timeDriven(k), motion[k].memory[fit.model.effects.size() - 1].s);
  }
  return points;
}

/// @return true if the force depends on time at some motion, or on a memory that lasts.
inline bool changesSlowly(const ActiveEffect& active) {
  if (active.effect.lasts) return true;
  const auto force = [&](double time) { return active.effect.force({1.0, 1.0, time, 0.5}, active.shapes.data()); };
  return force(0.0) != force(1.0) || force(1.0) != force(std::sqrt(2.0));
}

/// The rival of the last law of a fit, which changes slowly: the same with the time that the frequency of the wheel's
/// motion tells, or with what it remembered at that time.
/// Where that does as well, as on a sweep, nobody can tell a part that wears from one that answers to frequency.
/// Frequency: ln of rms velocity over rms position of the wheel (motionError() of w'') in windows of four natural
/// periods. It tells the mean time of the two windows that are next in frequency; in straight lines between the
/// middles.
inline ForceEffect frequencyRival(const ModelFit& fit, const Records& records, double stiffness_to_mass) {
  const ActiveEffect& last = fit.model.effects.back();
  const ForceEffect& effect = last.effect;
  const Polyline by_frequency = timeByFrequency(windowsOf(records, stiffness_to_mass));
  ForceEffect rival = effect;
  if (effect.lasts) {
    rival.memory_rate = {};
    rival.lasts = false;
    rival.shapes.clear();
    rival.force = [by_frequency, law = effect.force, memory = lastMemories(fit, records), known = last.shapes](
                      const StrutMotion& motion, const double*) {
      StrutMotion there = motion;
      there.memory = valueAt(memory, valueAt(by_frequency, motion.time));
      return law(there, known.data());
    };
    return rival;
  }
  const auto instead = [by_frequency](const auto& law) {
    return [by_frequency, law](const StrutMotion& motion, const double* shapes) {
      StrutMotion there = motion;
      there.time = valueAt(by_frequency, motion.time);
      return law(there, shapes);
    };
  };
  rival.force = instead(effect.force);
  if (effect.memory_rate) rival.memory_rate = instead(effect.memory_rate);
  return rival;
}

/// How far a residual wanders more slowly than the strut moves [m/s^2, rms]. Any strut passes what is slow as it is, so
/// that no law of one leaves this: it is a reading that wanders, as that of a body that leans does, or of a sensor that
/// drifts. It is what the means over neighbouring windows of a natural period have in common; noise has nothing.
/// @param natural_period  [samples].
inline double wandering(const Residuals& residuals, double natural_period) {
  const auto length = static_cast<std::size_t>(std::max(1.0, std::ceil(natural_period)));
  const double mean = meanOf(residuals);
  double products = 0.0, count = 0.0;
  for (const std::vector<double>& segment : residuals) {
    double last = 0.0;
    for (std::size_t first = 0; first + length <= segment.size(); first += length) {
      double sum = 0.0;
      for (std::size_t k = first; k < first + length; ++k) sum += segment[k] - mean;
      if (first > 0) {
        products += last * sum;
        count += square(static_cast<double>(length));
      }
      last = sum;
    }
  }
  return products > 0.0 ? std::sqrt(products / count) : 0.0;
}

/// @return true if a fault of the reading makes an offset above all, and that is not larger than what wanders beside
/// it: then it is no constant, and no fault of a sensor.
inline bool isWanderingOffset(const Residuals& before, const Residuals& after, double natural_period) {
  const double offset = meanOf(before) - meanOf(after);
  return square(offset) > kMajority * (meanSquare(before) - meanSquare(after)) &&
         std::abs(offset) < normalQuantile(kSure) * wandering(after, natural_period);
}

}  // namespace suspension_health_monitor
