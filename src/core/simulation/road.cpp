#include "suspension_health_monitor/internal/simulation/road.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"

namespace suspension_health_monitor {
namespace {

// Amplitude [m] and period [s].
constexpr std::pair<double, double> kWaves[] = {{0.01, 1.3}, {0.02, 1.9}, {0.03, 2.5}, {0.04, 2.8}};

constexpr double kBumpHeight = 0.15;            // [m]
constexpr double kBumpSharpness = 22.2;         // alpha [1/s^2]
constexpr double kBumpTimes[] = {85.0, 110.0};  // [s]

constexpr double kReferenceFrequency = 0.1;  // n0 [cycles/m]
constexpr int kBlockIntervals = 512;

// The quintic on [0, h] with given height, rate and acceleration at both ends, at the share s of the interval.
RoadPoint interpolate(const RoadPoint& p, const RoadPoint& q, double h, double s) {
  const double rise = q.height - p.height;
  const double v0 = h * p.rate, v1 = h * q.rate;
  const double a0 = h * h * p.acceleration, a1 = h * h * q.acceleration;
  const double c2 = 0.5 * a0;
  const double c3 = 10.0 * rise - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1;
  const double c4 = -15.0 * rise + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1;
  const double c5 = 6.0 * rise - 3.0 * (v0 + v1) - 0.5 * (a0 - a1);
  return {p.height + s * (v0 + s * (c2 + s * (c3 + s * (c4 + s * c5)))),
          (v0 + s * (2.0 * c2 + s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5)))) / h,
          (2.0 * c2 + s * (6.0 * c3 + s * (12.0 * c4 + s * 20.0 * c5))) / (h * h)};
}

}  // namespace

RoadPoint operator+(const RoadPoint& a, const RoadPoint& b) {
  return {a.height + b.height, a.rate + b.rate, a.acceleration + b.acceleration};
}

RoadPoint paperRoad(double t) {
  RoadPoint sum;
  for (const auto& [amplitude, period] : kWaves) {
    const double omega = 2.0 * M_PI / period;
    const double cosine = std::cos(omega * t);
    sum = sum + RoadPoint{amplitude * (1.0 - cosine), amplitude * omega * std::sin(omega * t),
                          amplitude * omega * omega * cosine};
  }
  return sum;
}

RoadPoint paperBumps(double t) {
  RoadPoint sum;
  for (const double centre : kBumpTimes) {
    const double x = t - centre;
    const double height = kBumpHeight * std::exp(-kBumpSharpness * x * x);
    const double slope = -2.0 * kBumpSharpness * x;
    sum = sum + RoadPoint{height, slope * height, (slope * slope - 2.0 * kBumpSharpness) * height};
  }
  return sum;
}

double isoDisplacementDensity(char road_class, double spatial_frequency) {
  if (road_class < 'A' || road_class > 'H')
    throw std::invalid_argument(std::string("iso_class = \"") + road_class + "\" [-], must be one of A to H");
  const double at_reference = std::ldexp(16e-6, 2 * (road_class - 'A'));
  const double ratio = spatial_frequency / kReferenceFrequency;
  return at_reference / (ratio * ratio);
}

IsoRoad::IsoRoad(char road_class, double speed, int seed, double lateral, unsigned surface)
    : amplitude_(kComponents), omega_(kComponents), phase_(kComponents), table_(kBlockIntervals + 1) {
  requireAboveZero("speed", speed, "m/s");
  RandomStream random(seed, RandomPurpose::kRoad, surface);
  RandomStream across(seed, RandomPurpose::kRoadLateral, surface);
  const double width = std::log(kHighest / kLowest) / kComponents;
  for (int i = 0; i < kComponents; ++i) {
    const double low = kLowest * std::exp(i * width);
    const double high = low * std::exp(width);
    const double n = low * std::exp(random.uniform() * width);
    // The integral of a density that falls as n^-2 from low to high is low Gd(low) (1 - low / high).
    const double variance = low * isoDisplacementDensity(road_class, low) * (1.0 - low / high);
    amplitude_[i] = std::sqrt(2.0 * variance);
    omega_[i] = 2.0 * M_PI * n * speed;
    const double s = 2.0 * across.uniform() - 1.0;
    phase_[i] = 2.0 * M_PI * (random.uniform() + n * s / std::sqrt(1.0 - s * s) * lateral);
  }
  grid_step_ = 1.0 / (kPointsPerWave * kHighest * speed);
  cosine_step_ = (omega_ * grid_step_).array().cos();
  sine_step_ = (omega_ * grid_step_).array().sin();
}

RoadPoint IsoRoad::operator()(double t) {
  const double position = t / grid_step_;
  const auto interval = static_cast<long>(std::floor(position));
  const auto block = static_cast<long>(std::floor(position / kBlockIntervals));
  if (block != block_) tabulate(block);
  const auto first = static_cast<std::size_t>(interval - block * kBlockIntervals);
  return interpolate(table_[first], table_[first + 1], grid_step_, position - static_cast<double>(interval));
}

void IsoRoad::tabulate(long block) {
  const double start = static_cast<double>(block * kBlockIntervals) * grid_step_;
  const Eigen::ArrayXd angle = omega_.array() * start + phase_.array();
  Eigen::ArrayXd cosine = amplitude_.array() * angle.cos();
  Eigen::ArrayXd sine = amplitude_.array() * angle.sin();
  const Eigen::VectorXd omega_squared = omega_.cwiseAbs2();
  Eigen::ArrayXd turned(kComponents);
  for (RoadPoint& point : table_) {
    point = {cosine.sum(), -omega_.dot(sine.matrix()), -omega_squared.dot(cosine.matrix())};
    // Angle addition: every phasor turns by its own step.
    turned = cosine * cosine_step_.array() - sine * sine_step_.array();
    sine = sine * cosine_step_.array() + cosine * sine_step_.array();
    cosine.swap(turned);
  }
  block_ = block;
}

}  // namespace suspension_health_monitor
