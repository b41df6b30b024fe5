#include "suspension_health_monitor/internal/identification/skew_profile.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/identification/regressor_noise.h"

namespace suspension_health_monitor {
namespace {

constexpr int kRowsOfHorizon = 64, kFewestRows = 32;
constexpr int kHorizonsOfBlock = 8;
constexpr double kAlike = 6.0;       // rows that count as one
constexpr double kFitted = 3.0;      // parameters of every block
constexpr double kUsualSteps = 3.0;  // standard deviation beforehand
constexpr double kMemories = 30.0;   // of the estimator: clocks differ by as much for long
constexpr double kCertain = 4.0;     // standard deviations
constexpr double kRounding = 1e-12;  // of squares

/// The parabola through three values a step apart; x in steps.
struct Parabola {
  double value, slope, curvature;  // in the middle

  Parabola(double before, double here, double after)
      : value(here), slope((after - before) / 2.0), curvature(after - 2.0 * here + before) {}

  double at(double x) const { return value + x * (slope + 0.5 * x * curvature); }
};

}  // namespace

SkewProfile::SkewProfile(const WheelHistory& wheel, const IntegralFilterOptions& filter, double forgetting_factor)
    : step_(mostSkew(filter) / kSteps),
      every_(std::max(1, filter.horizon_samples / kRowsOfHorizon)),
      horizon_rows_(std::max(kFewestRows, filter.horizon_samples)),
      noise_(RegressorNoise(filter).covariance()) {
  for (std::size_t j = 0; j < kNumSkews; ++j) places_.push_back(wheel.place(skewAt(j)));
  setForgettingFactor(forgetting_factor);
}

void SkewProfile::setForgettingFactor(double forgetting_factor) {
  share_ = std::pow(forgetting_factor, kHorizonsOfBlock * horizon_rows_ / kMemories);
}

bool SkewProfile::add(const WheelHistory& wheel, const Eigen::Vector2d& body, double output) {
  if (++rows_ % every_ == 0) {
    num_ += 1.0;
    output_ += output;
    output_square_ += output * output;
    for (std::size_t j = 0; j < kNumSkews; ++j) {
      const WheelRow row = wheel.at(places_[j]);
      const double damping = row.damping - body[0], stiffness = row.stiffness - body[1];
      Sums& sums = sums_[j];
      sums.damping += damping;
      sums.stiffness += stiffness;
      sums.damping_square += damping * damping;
      sums.stiffness_square += stiffness * stiffness;
      sums.both += damping * stiffness;
      sums.damping_output += damping * output;
      sums.stiffness_output += stiffness * output;
    }
  }
  if (rows_ % horizon_rows_ != 0) return false;
  closeHorizon();
  if (rows_ >= kHorizonsOfBlock * horizon_rows_) interrupt();
  return true;
}

// The least v' M v / v' N v over the struts v = (1, -b1, -b0), M the moments about the means, N those of the noise.
double SkewProfile::rest(const Sums& sums) const {
  Eigen::Matrix3d moments;  // the lower triangle
  moments(0, 0) = output_square_ - output_ * output_ / num_;
  moments(1, 0) = sums.damping_output - sums.damping * output_ / num_;
  moments(2, 0) = sums.stiffness_output - sums.stiffness * output_ / num_;
  moments(1, 1) = sums.damping_square - sums.damping * sums.damping / num_;
  moments(2, 1) = sums.both - sums.damping * sums.stiffness / num_;
  moments(2, 2) = sums.stiffness_square - sums.stiffness * sums.stiffness / num_;
  if (!moments.triangularView<Eigen::Lower>().toDenseMatrix().allFinite()) return 0.0;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments, noise_, Eigen::EigenvaluesOnly);
  return std::max(solver.eigenvalues()[0], kRounding * output_square_ / noise_(0, 0));
}

void SkewProfile::closeHorizon() {
  Profile rests;
  std::transform(sums_.begin(), sums_.end(), rests.begin(), [&](const Sums& sums) { return rest(sums); });
  const double least = *std::min_element(rests.begin(), rests.end());
  const double most = *std::max_element(rests.begin(), rests.end());
  if (!(least > 0.0 && std::isfinite(most))) return;
  const double unit = (num_ - kFitted) / kAlike / least;
  std::transform(rests.begin(), rests.end(), newest_.begin(), [&](double left) { return unit * left; });
  if (is_known_ && !newestAgrees()) older_.fill(0.0);
  is_known_ = true;
  locate();
}

bool SkewProfile::newestAgrees() const {
  const long j = std::lround(skew_ / step_) + kSteps;
  if (j < 1 || j >= 2 * kSteps) return true;
  const auto here = static_cast<std::size_t>(j);
  const Parabola parabola(newest_[here - 1], newest_[here], newest_[here + 1]);
  const double at_skew = parabola.at((skew_ - skewAt(here)) / step_);
  return at_skew - *std::min_element(newest_.begin(), newest_.end()) < kCertain * kCertain;
}

void SkewProfile::locate() {
  Profile total;
  for (std::size_t j = 0; j < kNumSkews; ++j)
    total[j] = older_[j] + newest_[j] + std::pow(skewAt(j) / (kUsualSteps * step_), 2);
  const auto best = static_cast<std::size_t>(std::min_element(total.begin(), total.end()) - total.begin());
  is_within_ = best > 0 && best + 1 < kNumSkews;
  if (!is_within_) return;
  const Parabola here(total[best - 1], total[best], total[best + 1]);
  if (!(here.curvature > 0.0)) return;
  skew_ = skewAt(best) - here.slope / here.curvature * step_;
  variance_ = 2.0 / here.curvature * step_ * step_;
}

void SkewProfile::interrupt() {
  for (std::size_t j = 0; j < kNumSkews; ++j) older_[j] = share_ * older_[j] + newest_[j];
  newest_.fill(0.0);
  sums_.fill({});
  output_ = output_square_ = num_ = 0.0;
  rows_ = 0;
}

void SkewProfile::restart() {
  interrupt();
  older_.fill(0.0);
  is_known_ = false;
  is_within_ = true;
  skew_ = variance_ = 0.0;
}

}  // namespace suspension_health_monitor
