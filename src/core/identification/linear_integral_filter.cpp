#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

constexpr int kCorrections = 6;

// Of exp(i w t), T = 1, the integral up to t = 0 is 1 / (i w), where the sum up to there has cot(w / 2) / (2 i), half
// of the end's sample counted. What is between them the corrections -2 i sum c_k sin(k w) have to make: least squares
// of their error over the integral, most where motion is, at low frequencies, under the condition that the slope at w =
// 0 is right, 2 sum k c_k = 1/12, which makes the rule exact on cubics.
std::vector<double> endCorrections() {
  constexpr int kFrequencies = 128;
  constexpr double kBand = 0.75;  // of the Nyquist frequency: what an anti-alias filter lets pass
  using Corrections = Eigen::Matrix<double, kCorrections, 1>;
  using WithCondition = Eigen::Matrix<double, kCorrections + 1, 1>;
  Eigen::Matrix<double, kCorrections + 1, kCorrections + 1> system;
  system.setZero();
  WithCondition right = WithCondition::Zero();
  const Corrections k = Corrections::LinSpaced(1.0, kCorrections);
  for (int i = 1; i <= kFrequencies; ++i) {
    const double w = kBand * M_PI * i / kFrequencies, weight = std::pow(w, -6);
    const Corrections made = 2.0 * w * (w * k).array().sin().matrix();
    system.topLeftCorner<kCorrections, kCorrections>() += weight * made * made.transpose();
    right.head<kCorrections>() += weight * (1.0 - 0.5 * w / std::tan(0.5 * w)) * made;
  }
  system.topRightCorner<kCorrections, 1>() = 2.0 * k;
  system.bottomLeftCorner<1, kCorrections>() = 2.0 * k.transpose();
  right[kCorrections] = 1.0 / 12.0;
  const WithCondition solution = system.fullPivLu().solve(right);
  return {solution.data(), solution.data() + kCorrections};
}

}  // namespace

HorizonIntegral::HorizonIntegral(int intervals, double period, IntegrationRule rule)
    : intervals_(intervals),
      period_(period),
      lateness_(lateness(rule)),
      ends_(std::max(intervals, 1) + 1),
      until_refresh_(intervals) {
  if (intervals < 1) refuse("horizon_samples", intervals, "", "at least 1");
  requireAboveZero("sample_period", period, "s");
  static const std::vector<double> band_limited = endCorrections();
  if (rule == IntegrationRule::kBandLimited) corrections_ = band_limited;
}

int HorizonIntegral::lateness(IntegrationRule rule) { return rule == IntegrationRule::kBandLimited ? kCorrections : 0; }

double HorizonIntegral::update(const DelayLine& signal) {
  const double end = signal.at(lateness_);
  sum_ += end - signal.at(lateness_ + intervals_);
  fresh_ += end;
  if (--until_refresh_ == 0) {
    sum_ = fresh_;
    fresh_ = 0.0;
    until_refresh_ = intervals_;
  }
  double correction = -0.5 * end;
  for (int k = 1; k <= lateness_; ++k)
    correction += corrections_[k - 1] * (signal.at(lateness_ + k) - signal.at(lateness_ - k));
  ends_.push(correction);
  return period_ * (sum_ + correction - ends_.at(intervals_));
}

LinearIntegralFilter::LinearIntegralFilter(int order, const IntegralFilterOptions& options, int lowest_derivative)
    : order_(order), horizon_(options.horizon_samples), lateness_(HorizonIntegral::lateness(options.rule)) {
  if (order < 1) refuse("filter order n", order, "", "at least 1");
  requireIn("derivative r", lowest_derivative, "", 0.0, order);
  const HorizonIntegral integral(options.horizon_samples, options.period, options.rule);
  const int num_integrals = order - lowest_derivative;
  integrals_.assign(num_integrals, integral);
  lines_.emplace_back(window(order, options));  // as long as the window: it is full when the filter is
  for (int i = 1; i <= num_integrals; ++i) {
    const int for_differences = (order - i) * (horizon_ + lateness_) + 1;
    lines_.emplace_back(i < num_integrals ? std::max(for_differences, integral.requiredHistory()) : for_differences);
  }
}

double LinearIntegralFilter::output(int derivative) const {
  const DelayLine& line = lines_[order_ - derivative];
  int lag = derivative * lateness_;
  // The strut's own cases, without a loop.
  if (derivative == 0) return line.at(0);
  if (derivative == 1) return line.at(lag) - line.at(lag + horizon_);
  if (derivative == 2) return line.at(lag) - 2.0 * line.at(lag + horizon_) + line.at(lag + 2 * horizon_);
  double result = 0.0, coefficient = 1.0;  // of q^(-jL) in (1 - q^-L)^r
  for (int j = 0; j <= derivative; ++j) {
    result += coefficient * line.at(lag);
    coefficient = coefficient * (j - derivative) / (j + 1);
    lag += horizon_;
  }
  return result;
}

}  // namespace suspension_health_monitor
