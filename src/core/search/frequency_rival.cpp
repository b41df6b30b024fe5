#include "frequency_rival.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/fit/motion_error.h"
#include "suspension_health_monitor/internal/pi.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kWindow = 4.0;  // natural periods

struct Point {
  double time, frequency;  // [s], [-]
};

std::vector<Point> frequencies(const Records& records, double stiffness_to_mass) {
  const double window = kWindow * 2.0 * kPi / std::sqrt(stiffness_to_mass);
  std::vector<Point> points;
  double mean = 0.0;
  for (const DriveSegment* segment : segmentsOf(records)) {
    const MotionError wheel = motionError(segment->unsprung, 0.0, segment->period, stiffness_to_mass);
    const auto length = static_cast<std::size_t>(std::ceil(window / segment->period));
    for (std::size_t first = 0; first + length <= segment->size(); first += length) {
      double position = 0.0, velocity = 0.0;
      for (std::size_t k = first; k < first + length; ++k) {
        position += square(wheel.travel[k]);
        velocity += square(wheel.travel_rate[k]);
      }
      if (!(position > 0.0 && velocity > 0.0)) continue;
      points.push_back({segment->timeDriven(first + length / 2), 0.5 * std::log(velocity / position)});
      mean += points.back().frequency;
    }
  }
  for (Point& point : points) point.frequency -= mean / static_cast<double>(points.size());
  return points;
}

double at(const std::vector<Point>& points, double time) {
  const auto after =
      std::lower_bound(points.begin(), points.end(), time, [](const Point& p, double t) { return p.time < t; });
  if (points.empty()) return 0.0;
  if (after == points.begin()) return points.front().frequency;
  if (after == points.end()) return points.back().frequency;
  const Point& before = *(after - 1);
  const double share = (time - before.time) / (after->time - before.time);
  return before.frequency + share * (after->frequency - before.frequency);
}

}  // namespace

bool dependsOnTime(const ActiveEffect& active) {
  const auto force = [&](double time) { return active.effect.force({1.0, 1.0, time, 0.5}, active.shapes.data()); };
  return force(0.0) != force(1.0) || force(1.0) != force(std::sqrt(2.0));
}

ForceEffect frequencyRival(const ForceEffect& effect, const Records& records, double stiffness_to_mass) {
  const std::vector<Point> points = frequencies(records, stiffness_to_mass);
  const auto instead = [points](ForceEffect::Law law) {
    return [points, law](const StrutMotion& motion, const double* shapes) {
      StrutMotion there = motion;
      there.time = at(points, motion.time);
      return law(there, shapes);
    };
  };
  ForceEffect rival = effect;
  rival.force = instead(effect.force);
  if (effect.memory_rate) rival.memory_rate = instead(effect.memory_rate);
  return rival;
}

}  // namespace suspension_health_monitor
