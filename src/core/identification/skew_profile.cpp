#include "suspension_health_monitor/internal/identification/skew_profile.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr int kRowsOfHorizon = 64, kFewestHorizonRows = 32;
constexpr int kHorizonsOfBlock = 8;
constexpr double kAlike = 6.0;          // rows that count as one
constexpr double kFitted = 3.0;         // parameters of every block
constexpr double kUsualSteps = 3.0;     // half of all skews are within it beforehand
constexpr double kSkewMemories = 30.0;  // of the estimator: clocks differ by as much for long
constexpr double kCertain = 4.0;        // standard deviations
constexpr double kRounding = 1e-12;     // of squares

/// The polynomial through five values a step apart, or three at the ends of a profile, where there are no more; x in
/// steps from the middle. Total least squares weighs by the strut, which changes with the skew: a parabola through
/// three of its values is off by a tenth of a step, however little noise there is.
struct Course {
  double value, slope, curvature, change = 0.0;  // in the middle; change of the curvature

  template <class Profile>
  Course(const Profile& values, Eigen::Index middle) : value(values[middle]) {
    const auto v = [&](Eigen::Index i) { return values[middle + i]; };
    slope = (v(1) - v(-1)) / 2.0;
    curvature = v(1) - 2.0 * value + v(-1);
    if (middle < 2 || middle + 2 >= values.size()) return;
    change = (v(2) - 2.0 * v(1) + 2.0 * v(-1) - v(-2)) / 2.0;
    slope -= change / 6.0;
    curvature -= (v(2) - 4.0 * v(1) + 6.0 * value - 4.0 * v(-1) + v(-2)) / 12.0;
  }

  double at(double x) const { return value + x * (slope + x * (curvature / 2.0 + x * change / 6.0)); }

  double minimum() const {
    const double x = -slope / curvature;  // Newton's step, and what the curvature changes on it
    return -slope / (curvature + change * x / 2.0);
  }
};

}  // namespace

SkewProfile::SkewProfile(const WheelHistory& wheel, const IntegralFilterOptions& filter, const RegressorNoise& noise,
                         double forgetting_factor)
    : step_(mostSkew(filter) / kSteps),
      every_(std::max(1, filter.horizon_samples / kRowsOfHorizon)),
      horizon_rows_(std::max(kFewestHorizonRows, filter.horizon_samples)),
      noise_of_psi_(noise.covariance()(0, 0)),
      residuals_(noise.covariance()),
      noise_share_(1.0) {
  for (std::size_t j = 0; j < kNumSkews; ++j) {
    places_.push_back(wheel.place(skewAt(j)));
    prior_[j] = 2.0 * std::log1p(std::pow(skewAt(j) / (kUsualSteps * step_), 2));
  }
  setForgettingFactor(forgetting_factor);
}

void SkewProfile::setForgettingFactor(double forgetting_factor) {
  share_ = std::pow(forgetting_factor, kHorizonsOfBlock * horizon_rows_ / kSkewMemories);
  noise_share_.setForgettingFactor(std::pow(share_, 1.0 / kHorizonsOfBlock));
}

bool SkewProfile::add(const WheelHistory& wheel, const Eigen::Vector2d& body, double output) {
  if (++sums_.rows % every_ == 0) {
    sums_.num += 1.0;
    sums_.output += output;
    sums_.output_square += output * output;
    Profile damping, stiffness;
    for (std::size_t j = 0; j < kNumSkews; ++j) {
      const WheelRow row = wheel.at(places_[j]);
      damping[j] = row.damping - body[0];
      stiffness[j] = row.stiffness - body[1];
    }
    sums_.damping += damping;
    sums_.stiffness += stiffness;
    sums_.damping_square += damping * damping;
    sums_.stiffness_square += stiffness * stiffness;
    sums_.both += damping * stiffness;
    sums_.damping_output += damping * output;
    sums_.stiffness_output += stiffness * output;
  }
  if (sums_.rows % horizon_rows_ != 0) return false;
  closeHorizon();
  if (sums_.rows >= kHorizonsOfBlock * horizon_rows_) interrupt();
  return true;
}

// About the means, since every block has an offset of its own.
Eigen::Matrix3d SkewProfile::momentsAt(std::size_t j) const {
  const Eigen::Vector3d means = Eigen::Vector3d(sums_.output, sums_.damping[j], sums_.stiffness[j]) / sums_.num;
  Eigen::Matrix3d squares;
  squares << sums_.output_square, sums_.damping_output[j], sums_.stiffness_output[j],  //
      sums_.damping_output[j], sums_.damping_square[j], sums_.both[j],                 //
      sums_.stiffness_output[j], sums_.both[j], sums_.stiffness_square[j];
  return squares - sums_.num * means * means.transpose();
}

void SkewProfile::closeHorizon() {
  Profile plain, of_noise;
  const double rounding = kRounding * sums_.output_square;
  for (std::size_t j = 0; j < kNumSkews; ++j) {
    const ResidualSquares left = residuals_.solve(momentsAt(j));
    if (!std::isfinite(left.plain)) return;
    plain[j] = std::max(left.plain, rounding);
    of_noise[j] = std::max(left.of_noise, rounding / noise_of_psi_);
  }
  const double weight = (sums_.num - kFitted) / kAlike;
  if (!plain_.take(plain, weight)) return;
  if (of_noise_.take(of_noise, weight))
    noise_share_.add({std::min(1.0, noise_variance_ * (sums_.num - kFitted) / of_noise.minCoeff())});
  if (found_ && !newestAgrees()) forgetOlder();
  locate();
}

bool SkewProfile::Evidence::take(const Profile& rests, double weight) {
  const double least = rests.minCoeff();
  if (!(least > 0.0 && rests.isFinite().all())) return false;
  newest = weight / least * rests;
  return true;
}

void SkewProfile::Evidence::closeBlock(double share) {
  older = share * older + newest;
  newest.setZero();
}

bool SkewProfile::newestAgrees() const {
  const long j = std::lround(found_->skew / step_) + kSteps;
  if (j < 1 || j >= 2 * kSteps) return true;
  const double beyond = (found_->skew - skewAt(static_cast<std::size_t>(j))) / step_;
  return Course(plain_.newest, j).at(beyond) - plain_.newest.minCoeff() < kCertain * kCertain;
}

SkewProfile::Optimum SkewProfile::optimumOf(const Evidence& evidence) const {
  const Profile total = evidence.older + evidence.newest + prior_;
  Eigen::Index place = 0;
  total.minCoeff(&place);
  const auto best = static_cast<std::size_t>(place);
  const double skew = skewAt(best);
  if (best == 0 || best + 1 == kNumSkews) return {skew, 0.0, false};
  const Course here(total, place);
  return {skew + here.minimum() * step_, 2.0 / here.curvature * step_ * step_, true};
}

void SkewProfile::locate() {
  const Optimum plain = optimumOf(plain_);
  if (!found_) found_ = Optimum{0.0, 0.0, true};
  found_->is_within = plain.is_within;
  if (!plain.is_within) return;
  const double apart = optimumOf(of_noise_).skew - plain.skew, s = noise_share_.mean(0);
  found_->skew = plain.skew + s * apart;
  found_->variance = plain.variance + (s * s * s + (1.0 - s) * (1.0 - s) * (1.0 - s)) / 3.0 * apart * apart;
}

void SkewProfile::interrupt() {
  plain_.closeBlock(share_);
  of_noise_.closeBlock(share_);
  sums_ = {};
}

void SkewProfile::restart() {
  interrupt();
  forgetOlder();
  noise_share_ = RunningMeans<1>(std::pow(share_, 1.0 / kHorizonsOfBlock));
  found_.reset();
}

}  // namespace suspension_health_monitor
