#include "suspension_health_monitor/internal/signal/motion_filter.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/signal/continuity.h"

namespace suspension_health_monitor {
namespace {

// Of the sampling rate, of a filter of kShortest samples to either side; longer ones are narrower by as much.
constexpr double kWidestFlat = 0.24, kWidestStop = 0.42;
constexpr int kShortest = 12;
constexpr int kFrequencies = 2000;  // at which the errors are summed: many more than the taps can tell apart

struct FilterPair {
  Eigen::VectorXd value, rate;  // taps from the oldest sample to the newest; the rate per sample
};

/// With q = 2 pi f T: H = h_0 + 2 sum_n h_n cos(n q), T G = 2j sum_n g_n sin(n q).
/// @param flat, stop  in cycles per sample.
FilterPair makePair(int delay, double flat, double stop) {
  const int unknowns = 2 * delay + 1;  // h_0 .. h_delay, g_1 .. g_delay
  const Eigen::ArrayXd frequencies = Eigen::ArrayXd::LinSpaced(kFrequencies + 1, 0.0, 0.5),
                       q = 2.0 * M_PI * frequencies;
  Eigen::MatrixXd low_pass = Eigen::MatrixXd::Zero(q.size(), unknowns), difference = low_pass;
  low_pass.col(0).setOnes();
  for (int n = 1; n <= delay; ++n) low_pass.col(n) = 2.0 * (n * q).cos();
  difference.leftCols(delay + 1) = -(q.matrix().asDiagonal() * low_pass.leftCols(delay + 1));
  for (int n = 1; n <= delay; ++n) difference.col(delay + n) = 2.0 * (n * q).sin();
  const Eigen::VectorXd passes = (frequencies <= flat).cast<double>(), stops = (frequencies >= stop).cast<double>();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns + 2, unknowns + 2);
  normal.topLeftCorner(unknowns, unknowns) = low_pass.transpose() * (passes + stops).asDiagonal() * low_pass +
                                             MotionFilter::kSameFilter * difference.transpose() * difference;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns + 2);
  right.head(unknowns) = low_pass.transpose() * passes;
  // Lagrange's conditions: sum of h is 1, and sum of n g_n over both sides.
  normal(unknowns, 0) = 1.0;
  for (int n = 1; n <= delay; ++n) {
    normal(unknowns, n) = 2.0;
    normal(unknowns + 1, delay + n) = 2.0 * n;
  }
  normal.rightCols(2) = normal.bottomRows(2).transpose();
  right.tail<2>().setOnes();
  const Eigen::VectorXd taps = normal.partialPivLu().solve(right);

  FilterPair pair{Eigen::VectorXd(2 * delay + 1), Eigen::VectorXd(2 * delay + 1)};
  pair.value[delay] = taps[0];
  pair.rate[delay] = 0.0;
  for (int n = 1; n <= delay; ++n) {
    pair.value[delay + n] = pair.value[delay - n] = taps[n];
    pair.rate[delay + n] = taps[delay + n];
    pair.rate[delay - n] = -taps[delay + n];
  }
  return pair;
}

}  // namespace

MotionFilter::MotionFilter(Stamp period, std::size_t filtered, std::size_t differentiated)
    : period_(period),
      flat_(std::min(kBand, kWidestFlat / toSeconds(period))),
      delay_(static_cast<int>(std::ceil(kShortest * kWidestFlat / (flat_ * toSeconds(period)) - 1e-9))),
      instant_{{}, std::vector<double>(filtered), std::vector<double>(differentiated), std::vector<double>(filtered)},
      history_(filtered + differentiated, DelayLine(2 * delay_ + 1)),
      stamps_(static_cast<std::size_t>(2 * delay_ + 1)) {
  const FilterPair pair = makePair(delay_, flat_ * toSeconds(period), stop() * toSeconds(period));
  value_ = pair.value;
  rate_ = pair.rate / toSeconds(period);
}

double MotionFilter::stop() const { return flat_ * kWidestStop / kWidestFlat; }

const MotionFilter::Instant* MotionFilter::push(Stamp stamp, const std::vector<double>& signals) {
  const Continuity follows = stamps_.empty() ? Continuity::kGap : continuity(stamp - stamps_.back(), period_);
  if (follows == Continuity::kTooSoon) return nullptr;
  if (follows != Continuity::kContinues) stamps_.clear();
  stamps_.push_back(stamp);
  for (std::size_t i = 0; i < signals.size(); ++i) history_[i].push(signals[i]);
  if (!stamps_.full()) return nullptr;

  const auto windowOf = [this](std::size_t signal) {
    return Eigen::Map<const Eigen::VectorXd>(history_[signal].window(), value_.size());
  };
  const std::size_t filtered = instant_.values.size();
  for (std::size_t i = 0; i < filtered; ++i) {
    instant_.values[i] = value_.dot(windowOf(i));
    instant_.unfiltered[i] = windowOf(i)[delay_];
  }
  for (std::size_t i = 0; i < instant_.rates.size(); ++i) instant_.rates[i] = rate_.dot(windowOf(filtered + i));
  instant_.stamp = stamps_[static_cast<std::size_t>(delay_)];
  return &instant_;
}

}  // namespace suspension_health_monitor
