#include "suspension_health_monitor/internal/identification/horizon_integral.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "suspension_health_monitor/internal/pi.h"
#include "suspension_health_monitor/internal/plain_text.h"

namespace suspension_health_monitor {
namespace {

[[noreturn]] void refuseIntervals(int intervals, const char* allowed) {
  throw std::invalid_argument("horizon_samples = " + std::to_string(intervals) + ", must be " + allowed);
}

// Beside the trapezoid rule an end must give, of exp(i w t) at t = 0 with T = 1, 1 / (i w) - cot(w / 2) / (2 i): what
// the integral has there less what the sum has. Its series -i w / 12 - ... sets the moments of the corrections c_k,
// which are sum c_k = sum k^2 c_k = 0, sum k c_k = 1/12 (exact on parabolas); what is left of them is least squares,
// relative to the integral, over the band, and small.
std::vector<double> endCorrections(int count) {
  constexpr int kFrequencies = 128, kMoments = 3;
  constexpr double kBeyond = 1e-2;  // weight of an error beyond half of the Nyquist frequency: it must not grow there
  constexpr double kSize = 1e-5;    // weight of a correction: it passes noise on
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count + kMoments, count + kMoments);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count + kMoments);
  for (int i = 1; i < kFrequencies; ++i) {
    const double w = kPi * i / kFrequencies, weight = (2 * i <= kFrequencies ? 1.0 : kBeyond) / w;
    const double wanted = 0.5 / std::tan(w / 2.0) - 1.0 / w;  // its imaginary part
    const Eigen::ArrayXd phase = -w * Eigen::ArrayXd::LinSpaced(count, 0.0, count - 1.0);
    const Eigen::VectorXd real = phase.cos(), imaginary = phase.sin();
    system.topLeftCorner(count, count) += weight * (real * real.transpose() + imaginary * imaginary.transpose());
    right.head(count) += weight * wanted * imaginary;
  }
  system.topLeftCorner(count, count).diagonal().array() += kFrequencies * kSize;
  for (int k = 0; k < count; ++k)
    for (int moment = 0; moment < kMoments; ++moment)
      system(k, count + moment) = system(count + moment, k) = std::pow(k, moment);
  right[count + 1] = 1.0 / 12.0;
  const Eigen::VectorXd solution = system.fullPivLu().solve(right);
  return {solution.data(), solution.data() + count};
}

}  // namespace

HorizonIntegral::HorizonIntegral(int intervals, double period, IntegrationRule rule)
    : intervals_(intervals),
      period_(period),
      until_refresh_(intervals + 1),
      leaves_other_parity_(intervals % 2 == 0 ? 1 : 0) {
  if (intervals < 1) refuseIntervals(intervals, "at least 1");
  if (!(std::isfinite(period) && period > 0.0))
    throw std::invalid_argument("sample_period = " + numberText(period) + " [s], must be above 0");
  switch (rule) {
    case IntegrationRule::kTrapezoid: end_corrections_ = {-1.0 / 2}; break;
    case IntegrationRule::kSimpson:
      if (intervals % 2 != 0) refuseIntervals(intervals, "even for Simpson's rule");
      same_weight_ = 2.0 / 3;
      other_weight_ = 4.0 / 3;
      end_corrections_ = {-1.0 / 3};
      break;
    case IntegrationRule::kBandLimited:
      if (intervals < 5) refuseIntervals(intervals, "at least 5");
      end_corrections_ = endCorrections(std::min(kMostCorrections, intervals + 1));
      end_corrections_[0] -= 1.0 / 2;
      break;
  }
}

double HorizonIntegral::update(const DelayLine& signal) {
  const double newest = signal.at(0);
  sums_[parity_] += newest;
  sums_[parity_ ^ leaves_other_parity_] -= signal.at(intervals_ + 1);
  fresh_[parity_] += newest;
  if (--until_refresh_ == 0) {
    sums_ = fresh_;
    fresh_ = {};
    until_refresh_ = intervals_ + 1;
  }
  double integral = same_weight_ * sums_[parity_] + other_weight_ * sums_[parity_ ^ 1];
  for (std::size_t k = 0; k < end_corrections_.size(); ++k) {
    const int place = static_cast<int>(k);
    integral += end_corrections_[k] * (signal.at(place) + signal.at(intervals_ - place));
  }
  parity_ ^= 1;
  return period_ * integral;
}

void HorizonIntegral::reset() {
  sums_ = {};
  fresh_ = {};
  until_refresh_ = intervals_ + 1;
  parity_ = 0;
}

}  // namespace suspension_health_monitor
