#include "suspension_health_monitor/internal/signal/motion_filter.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/pi.h"
#include "suspension_health_monitor/internal/signal/continuity.h"

namespace suspension_health_monitor {
namespace {

constexpr int kDelay = MotionFilter::kDelay;
constexpr int kUnknowns = 2 * kDelay + 1;  // h_0 .. h_kDelay, g_1 .. g_kDelay
constexpr int kFrequencies = 2000;         // at which the errors are summed: many more than the taps can tell apart

using Taps = Eigen::Matrix<double, 2 * kDelay + 1, 1>;
struct FilterPair {
  Taps value, rate;  // from the oldest sample to the newest; the rate per sample
};

/// With q = 2 pi f T: H = h_0 + 2 sum_n h_n cos(n q), T G = 2j sum_n g_n sin(n q).
FilterPair makePair() {
  using Row = Eigen::Matrix<double, 1, kUnknowns>;
  using Square = Eigen::Matrix<double, kUnknowns + 2, kUnknowns + 2>;
  using Column = Eigen::Matrix<double, kUnknowns + 2, 1>;
  Square normal = Square::Zero();
  Column right = Column::Zero();
  for (int i = 0; i <= kFrequencies; ++i) {
    const double frequency = 0.5 * i / kFrequencies, q = 2.0 * kPi * frequency;
    Row low_pass = Row::Zero(), derivative = Row::Zero();
    low_pass[0] = 1.0;
    for (int n = 1; n <= kDelay; ++n) {
      low_pass[n] = 2.0 * std::cos(n * q);
      derivative[kDelay + n] = 2.0 * std::sin(n * q);
    }
    const bool passes = frequency <= MotionFilter::kFlat, stops = frequency >= MotionFilter::kStop;
    const Row difference = derivative - q * low_pass;
    auto gram = normal.topLeftCorner<kUnknowns, kUnknowns>();
    if (passes || stops) gram += low_pass.transpose() * low_pass;
    if (passes) right.head<kUnknowns>() += low_pass.transpose();
    gram += MotionFilter::kSameFilter * difference.transpose() * difference;
  }
  // Lagrange's conditions: sum of h is 1, and sum of n g_n over both sides.
  Row sum = Row::Zero(), slope = Row::Zero();
  sum[0] = 1.0;
  for (int n = 1; n <= kDelay; ++n) {
    sum[n] = 2.0;
    slope[kDelay + n] = 2.0 * n;
  }
  normal.row(kUnknowns).head<kUnknowns>() = sum;
  normal.row(kUnknowns + 1).head<kUnknowns>() = slope;
  normal.col(kUnknowns).head<kUnknowns>() = sum.transpose();
  normal.col(kUnknowns + 1).head<kUnknowns>() = slope.transpose();
  right.tail<2>().setOnes();
  const Column taps = normal.fullPivLu().solve(right);

  FilterPair pair;
  pair.value[kDelay] = taps[0];
  pair.rate[kDelay] = 0.0;
  for (int n = 1; n <= kDelay; ++n) {
    pair.value[kDelay + n] = pair.value[kDelay - n] = taps[n];
    pair.rate[kDelay + n] = taps[kDelay + n];
    pair.rate[kDelay - n] = -taps[kDelay + n];
  }
  return pair;
}

const FilterPair& filters() {
  static const FilterPair pair = makePair();
  return pair;
}

}  // namespace

MotionFilter::MotionFilter(Stamp period, std::size_t filtered, std::size_t differentiated)
    : period_(period),
      instant_{{}, std::vector<double>(filtered), std::vector<double>(differentiated)},
      history_(2 * kTaps * (filtered + differentiated)) {
  filters();  // not on the sample path
}

const MotionFilter::Instant* MotionFilter::push(Stamp stamp, const std::vector<double>& signals) {
  const Continuity follows = samples_ > 0 ? continuity(stamp - stamps_[newest_], period_) : Continuity::kGap;
  if (follows == Continuity::kTooSoon) return nullptr;
  samples_ = follows == Continuity::kContinues ? std::min(samples_ + 1, kTaps) : 1;
  newest_ = (newest_ + 1) % kTaps;
  stamps_[newest_] = stamp;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    double* const ring = &history_[i * 2 * kTaps];
    ring[newest_] = ring[newest_ + kTaps] = signals[i];
  }
  if (samples_ < kTaps) return nullptr;

  const auto windowOf = [this](std::size_t signal) {
    return Eigen::Map<const Taps>(&history_[signal * 2 * kTaps + newest_ + 1]);
  };
  const FilterPair& pair = filters();
  const std::size_t filtered = instant_.values.size();
  for (std::size_t i = 0; i < filtered; ++i) instant_.values[i] = pair.value.dot(windowOf(i));
  for (std::size_t i = 0; i < instant_.rates.size(); ++i)
    instant_.rates[i] = pair.rate.dot(windowOf(filtered + i)) / toSeconds(period_);
  instant_.stamp = stamps_[(newest_ + 1 + kDelay) % kTaps];
  return &instant_;
}

double MotionFilter::valueNoise() { return filters().value.norm(); }

double MotionFilter::rateNoise() const { return filters().rate.norm() / toSeconds(period_); }

}  // namespace suspension_health_monitor
