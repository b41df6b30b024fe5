#include "suspension_health_monitor/internal/record/motion.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/periodogram.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/model/free_run.h"
#include "suspension_health_monitor/internal/signal/readings.h"

namespace suspension_health_monitor {
namespace {

constexpr double kOutside = 0.05;  // of the power, on either side
constexpr std::size_t kShortestPart = 64, kLongestPart = 16384;

/// @return the bin below which that share of the power is.
double quantile(const std::vector<double>& power, double share) {
  const double wanted = share * std::accumulate(power.begin(), power.end(), 0.0);
  double below = 0.0;
  std::size_t bin = 0;
  while (bin + 1 < power.size() && below + power[bin] < wanted) below += power[bin++];
  return static_cast<double>(bin);
}

/// A force that is `factor` times as large where all that moves is, and does not depend on time.
bool followsFactor(const ForceEffect& effect, const std::vector<double>& shapes, double factor) {
  const auto motion = [](double size, double time) {
    return StrutMotion{size, 0.7 * size, time, {0.5 * size, 0.3 * size}, 0.9 * size};
  };
  const auto isScaled = [&](double one, double other) {
    return std::abs(other - factor * one) <= 1e-9 * std::abs(one);
  };
  const StrutMotion one = motion(1.0, 0.0), other = motion(factor, 1.0);
  if (!isScaled(effect.force(one, shapes.data()), effect.force(other, shapes.data()))) return false;
  if (!effect.memory_rate) return true;
  const Memory rate = effect.memory_rate(one, shapes.data()), there = effect.memory_rate(other, shapes.data());
  return isScaled(rate.s, there.s) && isScaled(rate.second, there.second);
}

bool isFrequencyResponse(const ForceEffect& effect) {
  if (effect.lasts) return false;
  std::vector<double> shapes;  // not equal ones, by which terms of a law may cancel
  for (const ShapeParameter& shape : effect.shapes) {
    const double place = (static_cast<double>(shapes.size()) + 1.0) / (static_cast<double>(effect.shapes.size()) + 1.0);
    shapes.push_back(shape.min * std::pow(shape.max / shape.min, place));
  }
  return followsFactor(effect, shapes, -1.0) && followsFactor(effect, shapes, 2.0);
}

}  // namespace

std::optional<MotionRange> rangeOfMotion(const Records& records) {
  const Segments segments = segmentsOf(records);
  const std::vector<std::size_t> sizes = mapped(segments, &DriveSegment::size);
  const std::size_t longest = sizes.empty() ? 0 : *std::max_element(sizes.begin(), sizes.end());
  if (longest < kShortestPart) return std::nullopt;
  std::size_t length = kShortestPart;
  while (2 * length <= std::min(longest, kLongestPart)) length *= 2;

  std::vector<double> power(length / 2 + 1), relative(length);
  Periodogram periodogram(length);
  Spectrum spectrum;
  Periodogram::forEachWindow(sizes, length, [&](std::size_t segment, std::size_t first) {
    for (std::size_t k = 0; k < length; ++k)
      relative[k] = segments[segment]->unsprung[first + k] - segments[segment]->sprung[first + k];
    periodogram.of(relative.data(), spectrum);
    for (std::size_t bin = 1; bin < power.size(); ++bin)
      power[bin] += std::norm(spectrum[bin]) / square(static_cast<double>(bin));
  });
  const double low = quantile(power, kOutside), high = quantile(power, 1.0 - kOutside);
  if (!(low > 0.0)) return std::nullopt;
  const double bin = 1.0 / (static_cast<double>(length) * records.front()->period());
  return MotionRange{bin * low, bin * high, bin};
}

std::vector<std::string> takeFrequencyResponses(EffectLibrary& library) {
  std::vector<std::string> names = namesOf(takeUnless(library.forces, std::not_fn(isFrequencyResponse)));
  for (const MeasurementEffect& effect : library.readings) names.push_back(effect.name);
  library.readings.clear();
  return names;
}

double MotionScale::unit(ShapeScale scale) const {
  switch (scale) {
    case ShapeScale::kTravel: return travel;
    case ShapeScale::kTravelRate: return travel_rate;
    case ShapeScale::kTime: return time;
    case ShapeScale::kFrequency: return 1.0 / (2.0 * M_PI * time);
    case ShapeScale::kNone: break;
  }
  return 1.0;
}

bool hasShapeAtEnd(const ActiveEffect& active, const MotionScale& scale) {
  constexpr double end = 0.01;
  for (std::size_t i = 0; i < active.shapes.size(); ++i) {
    const ShapeParameter& shape = active.effect.shapes[i];
    const double lowest = scale.unit(shape.scale) * shape.min;
    const double place = std::log(active.shapes[i] / lowest) / std::log(shape.max / shape.min);
    if ((!(place < 1.0 - end) && !shape.open_above) || (place < end && !shape.open_below)) return true;
  }
  return false;
}

std::optional<MotionScale> motionScale(const std::vector<CornerSample>& samples, double period, double damping_to_mass,
                                       double stiffness_to_mass) {
  FreeRun free_run(period);
  if (!free_run.trySetModel(damping_to_mass, stiffness_to_mass)) return std::nullopt;
  double count = 0.0, travel = 0.0, travel_square = 0.0, rate_square = 0.0;
  const CornerSample* last = nullptr;
  for (const CornerSample& sample : samples) {
    if (last != nullptr && continuity(sample.stamp - last->stamp, fromSeconds(period)) != Continuity::kContinues)
      free_run.reset();
    last = &sample;
    if (!free_run.push(sample.unsprung_acceleration) || !free_run.settled()) continue;
    count += 1.0;
    travel += free_run.travel();
    travel_square += free_run.travel() * free_run.travel();
    rate_square += free_run.travelRate() * free_run.travelRate();
  }
  if (count < 2.0) return std::nullopt;
  const double mean = travel / count;
  const MotionScale scale{std::sqrt(std::max(0.0, travel_square / count - mean * mean)), std::sqrt(rate_square / count),
                          1.0 / std::sqrt(stiffness_to_mass)};
  if (!(scale.travel > 0.0 && scale.travel_rate > 0.0)) return std::nullopt;
  return scale;
}

}  // namespace suspension_health_monitor
