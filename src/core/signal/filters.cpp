#include "suspension_health_monitor/internal/signal/filters.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <tuple>
#include <utility>

#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/signal/readings.h"
#include "suspension_health_monitor/internal/signal/tuning.h"

namespace suspension_health_monitor {
namespace {

// Where the energy of a wheel's motion is counts most; near Nyquist's frequency an error is cheaper than the length
// that would avoid it. Bands from 0, as shares of Nyquist's frequency, and their weights.
constexpr std::pair<double, double> kBands[] = {{0.5, 1.0}, {0.75, 1e-2}, {0.9, 1e-4}};
constexpr double kRidge = 1e-12;  // keeps the weights small where the bands leave them free

double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(x) / x; }

// Weighted mean of cos(omega x) over the bands.
double bandMean(double x) {
  double sum = 0.0;
  for (const auto& [edge, weight] : kBands) sum += weight * edge * sinc(edge * M_PI * x);
  return sum;
}

// Mean over the band of |sum_i h_i e^(j w i) - e^(j w D)|^2 is a quadratic form in h with these entries.
Eigen::LDLT<Eigen::MatrixXd> factoredGram(Eigen::Index n) {
  Eigen::MatrixXd gram(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) gram(i, j) = bandMean(static_cast<double>(i - j));
    gram(i, i) += kRidge;
  }
  return gram.ldlt();
}

constexpr int kFrequencies = 2000;  // at which the errors are summed: many more than the taps can tell apart

/// With q = 2 pi f T: H = h_0 + 2 sum_n h_n cos(n q), T G = 2j sum_n g_n sin(n q).
/// @param flat, stop  in cycles per sample.
/// @return taps from the oldest sample to the newest, of the value and of the rate per sample.
std::pair<Eigen::VectorXd, Eigen::VectorXd> makePair(int delay, double flat, double stop) {
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
                                             kSignalTuning.same_filter * difference.transpose() * difference;
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

  Eigen::VectorXd value(2 * delay + 1), rate(2 * delay + 1);
  value[delay] = taps[0];
  rate[delay] = 0.0;
  for (int n = 1; n <= delay; ++n) {
    value[delay + n] = value[delay - n] = taps[n];
    rate[delay + n] = taps[delay + n];
    rate[delay - n] = -taps[delay + n];
  }
  return {value, rate};
}

constexpr double kNoiseShare = 1e-3;  // of the slope's mean square

/// Robust standard deviation of white noise, from the fourth differences: those of white noise have 70 times its
/// variance.
double noiseOf(const std::vector<std::vector<double>>& series) {
  std::vector<double> differences;
  for (const std::vector<double>& x : series)
    for (std::size_t k = 2; k + 2 < x.size(); ++k)
      differences.push_back(x[k - 2] - 4 * x[k - 1] + 6 * x[k] - 4 * x[k + 1] + x[k + 2]);
  return robustDeviation(std::move(differences)) / std::sqrt(70.0);
}

double meanSquareSlope(const std::vector<std::vector<double>>& series, const Eigen::VectorXd& weights) {
  const std::size_t margin = kWidestSlope;
  double sum = 0.0, count = 0.0;
  for (const std::vector<double>& x : series)
    for (std::size_t k = margin; k + margin < x.size(); ++k, ++count) sum += square(weightedSlope(&x[k], weights));
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

std::vector<double> interpolationWeights(double fraction) {
  constexpr Eigen::Index n = 2 * kInterpolationReach;
  static const Eigen::LDLT<Eigen::MatrixXd> gram = factoredGram(n);
  Eigen::VectorXd target(n);
  const double wanted = kInterpolationReach - 1 + fraction;
  for (Eigen::Index i = 0; i < n; ++i) target[i] = bandMean(static_cast<double>(i) - wanted);
  Eigen::VectorXd solution = gram.solve(target);
  solution /= solution.sum();  // a constant, gravity say, comes out exactly
  return {solution.data(), solution.data() + n};
}

std::vector<double> integrationWeights(double from, double to, int power) {
  using Gauss = boost::math::quadrature::gauss<double, 10>;
  std::vector<double> weights(2 * kInterpolationReach, 0.0);
  for (std::size_t n = 0; n < Gauss::abscissa().size(); ++n)
    for (const double side : {-1.0, 1.0}) {
      const double position = from + (to - from) * (1.0 + side * Gauss::abscissa()[n]) / 2.0;
      const std::vector<double> at_node = interpolationWeights(position);
      for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] += (to - from) / 2.0 * Gauss::weights()[n] * std::pow(to - position, power) * at_node[i];
    }
  return weights;
}

MotionFilter::MotionFilter(Stamp period, std::size_t filtered, std::size_t differentiated)
    : period_(period),
      flat_(std::min(kSignalTuning.body_band, kSignalTuning.widest_flat / toSeconds(period))),
      delay_(static_cast<int>(
          std::ceil(kInterpolationReach * kSignalTuning.widest_flat / (flat_ * toSeconds(period)) - 1e-9))),
      instant_{{}, std::vector<double>(filtered), std::vector<double>(differentiated), std::vector<double>(filtered)},
      history_(filtered + differentiated, DelayLine(2 * delay_ + 1)),
      stamps_(2 * delay_ + 1) {
  std::tie(value_, rate_) = makePair(delay_, flat_ * toSeconds(period), stop() * toSeconds(period));
  rate_ /= toSeconds(period);
}

double MotionFilter::stop() const { return flat_ * kSignalTuning.widest_stop / kSignalTuning.widest_flat; }

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
  instant_.stamp = stamps_[delay_];
  return &instant_;
}

Eigen::VectorXd slopeWeights(int half_width, double period) {
  // Normal equations of x = a t + b t^3; even powers do not touch the slope in the middle.
  const Eigen::ArrayXd k = Eigen::ArrayXd::LinSpaced(half_width, 1.0, half_width);
  const double s2 = 2.0 * k.square().sum(), s4 = 2.0 * k.pow(4.0).sum(), s6 = 2.0 * k.pow(6.0).sum();
  return (s6 * k - s4 * k.cube()) / ((s2 * s6 - s4 * s4) * period);
}

Eigen::VectorXd fittingSlope(const std::vector<std::vector<double>>& series, double period) {
  const double noise = noiseOf(series);
  for (const int half_width : {2, 4, 8}) {
    const Eigen::VectorXd weights = slopeWeights(half_width, period);
    if (square(noise * noiseOfSlope(weights)) <= kNoiseShare * meanSquareSlope(series, weights)) return weights;
  }
  return slopeWeights(kWidestSlope, period);
}

double weightedSlope(const double* middle, const Eigen::VectorXd& weights) {
  double sum = 0.0;
  for (Eigen::Index k = 1; k <= weights.size(); ++k) sum += weights[k - 1] * (middle[k] - middle[-k]);
  return sum;
}

}  // namespace suspension_health_monitor
