#include "suspension_health_monitor/internal/identification/skew_profile.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr int kRowsOfHorizon = 64, kFewestRows = 32;
constexpr int kHorizonsOfBlock = 8;
constexpr double kAlike = 6.0;       // rows that count as one
constexpr double kFitted = 3.0;      // parameters of every block
constexpr double kUsualSteps = 3.0;  // half of all skews are within it beforehand
constexpr double kMemories = 30.0;   // of the estimator: clocks differ by as much for long
constexpr double kCertain = 4.0;     // standard deviations
constexpr double kRounding = 1e-12;  // of squares

/// @return the rest of the squares of psi that the best strut leaves.
double leastSquares(const Eigen::Matrix3d& moments) {
  const Eigen::Vector2d products = moments.bottomLeftCorner<2, 1>();
  return moments(0, 0) - products.dot(moments.bottomRightCorner<2, 2>().ldlt().solve(products));
}

/// @return the least v' M v / v' N v over the struts v = (1, -b1, -b0), M the moments and N those of the noise.
double totalLeastSquares(const Eigen::Matrix3d& moments, const Eigen::Matrix3d& noise) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d>(moments, noise, Eigen::EigenvaluesOnly)
      .eigenvalues()[0];
}

/// The parabola through three values a step apart; x in steps.
struct Parabola {
  double value, slope, curvature;  // in the middle

  Parabola(double before, double here, double after)
      : value(here), slope((after - before) / 2.0), curvature(after - 2.0 * here + before) {}

  double at(double x) const { return value + x * (slope + 0.5 * x * curvature); }
};

}  // namespace

SkewProfile::SkewProfile(const WheelHistory& wheel, const IntegralFilterOptions& filter, const RegressorNoise& noise,
                         double forgetting_factor)
    : step_(mostSkew(filter) / kSteps),
      every_(std::max(1, filter.horizon_samples / kRowsOfHorizon)),
      horizon_rows_(std::max(kFewestRows, filter.horizon_samples)),
      noise_(noise.covariance()) {
  for (std::size_t j = 0; j < kNumSkews; ++j) {
    places_.push_back(wheel.place(skewAt(j)));
    prior_[j] = 2.0 * std::log1p(std::pow(skewAt(j) / (kUsualSteps * step_), 2));
  }
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

// About the means, since every block has an offset of its own.
Eigen::Matrix3d SkewProfile::momentsOf(const Sums& sums) const {
  const Eigen::Vector3d means = Eigen::Vector3d(output_, sums.damping, sums.stiffness) / num_;
  Eigen::Matrix3d squares;
  squares << output_square_, sums.damping_output, sums.stiffness_output,  //
      sums.damping_output, sums.damping_square, sums.both,                //
      sums.stiffness_output, sums.both, sums.stiffness_square;
  return squares - num_ * means * means.transpose();
}

void SkewProfile::closeHorizon() {
  Profile plain, of_noise;
  const double rounding = kRounding * output_square_;
  for (std::size_t j = 0; j < kNumSkews; ++j) {
    const Eigen::Matrix3d moments = momentsOf(sums_[j]);
    if (!moments.allFinite()) return;
    plain[j] = std::max(leastSquares(moments), rounding);
    of_noise[j] = std::max(totalLeastSquares(moments, noise_), rounding / noise_(0, 0));
  }
  const double weight = (num_ - kFitted) / kAlike;
  if (!plain_.take(plain, weight)) return;
  of_noise_.take(of_noise, weight);
  if (is_known_ && !newestAgrees()) plain_.older = of_noise_.older = {};
  is_known_ = true;
  locate();
}

bool SkewProfile::Evidence::take(const Profile& rests, double weight) {
  const double least = *std::min_element(rests.begin(), rests.end());
  if (!(least > 0.0 && std::isfinite(*std::max_element(rests.begin(), rests.end())))) return false;
  std::transform(rests.begin(), rests.end(), newest.begin(), [&](double left) { return weight * left / least; });
  return true;
}

void SkewProfile::Evidence::closeBlock(double share) {
  for (std::size_t j = 0; j < kNumSkews; ++j) older[j] = share * older[j] + newest[j];
  newest.fill(0.0);
}

bool SkewProfile::newestAgrees() const {
  const long j = std::lround(skew_ / step_) + kSteps;
  if (j < 1 || j >= 2 * kSteps) return true;
  const auto here = static_cast<std::size_t>(j);
  const Profile& newest = plain_.newest;
  const Parabola parabola(newest[here - 1], newest[here], newest[here + 1]);
  const double at_skew = parabola.at((skew_ - skewAt(here)) / step_);
  return at_skew - *std::min_element(newest.begin(), newest.end()) < kCertain * kCertain;
}

SkewProfile::Optimum SkewProfile::optimumOf(const Evidence& evidence) const {
  Profile total;
  for (std::size_t j = 0; j < kNumSkews; ++j) total[j] = evidence.older[j] + evidence.newest[j] + prior_[j];
  const auto best = static_cast<std::size_t>(std::min_element(total.begin(), total.end()) - total.begin());
  const double skew = skewAt(best);
  if (best == 0 || best + 1 == kNumSkews) return {skew, 0.0, false};
  const Parabola here(total[best - 1], total[best], total[best + 1]);
  return {skew - here.slope / here.curvature * step_, 2.0 / here.curvature * step_ * step_, true};
}

void SkewProfile::locate() {
  const Optimum plain = optimumOf(plain_);
  is_within_ = plain.is_within;
  if (!is_within_) return;
  skew_ = plain.skew;
  variance_ = plain.variance + std::pow(optimumOf(of_noise_).skew - plain.skew, 2) / 3.0;
}

void SkewProfile::interrupt() {
  plain_.closeBlock(share_);
  of_noise_.closeBlock(share_);
  sums_.fill({});
  output_ = output_square_ = num_ = 0.0;
  rows_ = 0;
}

void SkewProfile::restart() {
  interrupt();
  plain_.older = of_noise_.older = {};
  is_known_ = false;
  is_within_ = true;
  skew_ = variance_ = 0.0;
}

}  // namespace suspension_health_monitor
