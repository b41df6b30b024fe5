#include "suspension_health_monitor/internal/vehicle/separation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "suspension_health_monitor/internal/signal/continuity.h"
#include "suspension_health_monitor/internal/vehicle/neighbour_weights.h"
#include "suspension_health_monitor/internal/vehicle/travel_observer.h"

namespace suspension_health_monitor {
namespace {

constexpr double kWashout = 1.0 / 5.0;  // of the natural frequency; forward and backward together leave 0.998 there
constexpr std::array<double, kMostEffects> kNoMemories{};

using Series = std::vector<double>;

/// Samples [from, to) of a drive without a gap.
struct Stretch {
  std::size_t from, to;
  std::size_t size() const { return to - from; }
};

std::vector<Stretch> stretchesOf(const Drive& drive, double period) {
  const auto& samples = drive.samples;
  std::vector<Stretch> stretches;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const bool continues = k > 0 && continuity(samples[k].stamp - samples[k - 1].stamp, fromSeconds(period)) ==
                                        Continuity::kContinues;
    if (!continues) stretches.push_back({k, k});
    stretches.back().to = k + 1;
  }
  return stretches;
}

void requireSameStamps(const StrutDrives& drive) {
  for (const Drive& strut : drive) {
    const auto same = [](const CornerSample& a, const CornerSample& b) { return a.stamp == b.stamp; };
    const auto& first = drive.front().samples;
    if (!std::equal(first.begin(), first.end(), strut.samples.begin(), strut.samples.end(), same))
      throw std::invalid_argument("the struts of a drive must have samples of the same stamps");
  }
}

void fill(const StrutDrives& drive, std::size_t k, VehicleSample& sample) {
  const auto n = static_cast<Eigen::Index>(drive.size());
  sample.stamp = drive.front().samples[k].stamp;
  sample.sprung.resize(n);
  sample.unsprung.resize(n);
  sample.forces.resize(0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const CornerSample& strut = drive[static_cast<std::size_t>(i)].samples[k];
    sample.sprung[i] = strut.sprung_acceleration;
    sample.unsprung[i] = strut.unsprung_acceleration;
  }
}

// Backward in time what the observer's washout is forward: s^2 / (s^2 + 2 zeta omega s + omega^2), by the trapezoid rule.
void washBackward(double frequency, double period, Series& values) {
  const double x = frequency * period / 2.0, damping = 2.0 * TravelObserver::kDamping * x;
  const double scale = 1.0 / (1.0 + damping + x * x);
  const double a1 = 2.0 * (x * x - 1.0) * scale, a2 = (1.0 - damping + x * x) * scale;
  double before = 0.0, before_that = 0.0;
  for (auto value = values.rbegin(); value != values.rend(); ++value) {
    const double state = *value - a1 * before - a2 * before_that;
    *value = scale * (state - 2.0 * before + before_that);
    before_that = before;
    before = state;
  }
}

double meanOf(const Series& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// What the model of a strut says of its own part of the body's acceleration, at all samples of a stretch but the first
// and last kDelay.
Series forcesOf(const Drive& drive, const Stretch& stretch, double period, const StrutModel& model) {
  Series relative;
  for (std::size_t k = stretch.from; k < stretch.to; ++k)
    relative.push_back(drive.samples[k].unsprung_acceleration - drive.samples[k].sprung_acceleration);
  const double mean = meanOf(relative), frequency = kWashout * std::sqrt(std::max(0.0, model.stiffness_to_mass));
  TravelObserver observer(period);
  observer.setWashout(frequency);
  Series travel, rate;
  for (const double value : relative) {
    observer.push(value - mean);
    if (!observer.full()) continue;
    travel.push_back(observer.travel());
    rate.push_back(observer.travelRate());
  }
  washBackward(frequency, period, travel);
  washBackward(frequency, period, rate);
  Series forces;
  for (std::size_t k = 0; k < travel.size(); ++k)
    forces.push_back(model.force(travel[k], rate[k], 0.0, kNoMemories.data()));
  return forces;
}

}  // namespace

CouplingEstimate coupleStruts(const std::vector<StrutDrives>& drives, const IntegralFilterOptions& filter) {
  const int n = static_cast<int>(drives.front().size());
  CouplingEstimator estimator(n, 0, filter, std::numeric_limits<double>::infinity());
  VehicleSample sample;
  for (const StrutDrives& drive : drives) {
    requireSameStamps(drive);
    for (const Stretch& stretch : stretchesOf(drive.front(), filter.period)) {
      estimator.startNewSeries();
      for (std::size_t k = stretch.from; k < stretch.to; ++k) {
        fill(drive, k, sample);
        estimator.add(sample);
      }
    }
  }
  return estimator.solve();
}

StrutDrives separateStruts(const StrutDrives& drive, double period, const Coupling& coupling,
                           const std::vector<StrutModel>& models) {
  const NeighbourWeights weights(coupling);
  const auto n = static_cast<Eigen::Index>(drive.size());
  StrutDrives separated(drive.size());
  StrutVector gravity(n), modelled(n);
  VehicleSample sample;
  constexpr auto kEnd = static_cast<std::size_t>(TravelObserver::kDelay);
  for (const Stretch& stretch : stretchesOf(drive.front(), period)) {
    if (stretch.size() < 2 * kEnd) continue;
    std::vector<Series> forces;
    for (std::size_t i = 0; i < drive.size(); ++i) {
      forces.push_back(forcesOf(drive[i], stretch, period, withoutMemories(models[i])));
      double sum = 0.0;
      for (std::size_t k = stretch.from; k < stretch.to; ++k) sum += drive[i].samples[k].sprung_acceleration;
      gravity[static_cast<Eigen::Index>(i)] = sum / static_cast<double>(stretch.size());
    }
    for (std::size_t k = 0; k < forces.front().size(); ++k) {
      for (Eigen::Index i = 0; i < n; ++i) modelled[i] = forces[static_cast<std::size_t>(i)][k];
      fill(drive, stretch.from + kEnd - 1 + k, sample);
      const StrutVector neighbours = weights.neighbours(sample.sprung - gravity, sample.forces, modelled);
      for (Eigen::Index i = 0; i < n; ++i)
        separated[static_cast<std::size_t>(i)].samples.push_back(
            {sample.stamp, sample.sprung[i] - neighbours[i], sample.unsprung[i] - neighbours[i]});
    }
  }
  return separated;
}

}  // namespace suspension_health_monitor
