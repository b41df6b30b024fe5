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
      horizon_rows_(std::max(kFewestHorizonRows, filter.horizon_samples)),
      noise_of_psi_(noise.covariance()(0, 0)),
      residuals_(noise.covariance()) {
  for (std::size_t j = 0; j < kNumSkews; ++j) {
    places_.push_back(wheel.place(skewAt(j)));
    prior_[j] = 2.0 * std::log1p(std::pow(skewAt(j) / (kUsualSteps * step_), 2));
  }
  setForgettingFactor(forgetting_factor);
}

void SkewProfile::setForgettingFactor(double forgetting_factor) {
  share_ = std::pow(forgetting_factor, kHorizonsOfBlock * horizon_rows_ / kSkewMemories);
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
  of_noise_.take(of_noise, weight);
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
  const auto here = static_cast<std::size_t>(j);
  const Profile& newest = plain_.newest;
  const Parabola parabola(newest[here - 1], newest[here], newest[here + 1]);
  const double at_skew = parabola.at((found_->skew - skewAt(here)) / step_);
  return at_skew - newest.minCoeff() < kCertain * kCertain;
}

SkewProfile::Optimum SkewProfile::optimumOf(const Evidence& evidence) const {
  const Profile total = evidence.older + evidence.newest + prior_;
  Eigen::Index place = 0;
  total.minCoeff(&place);
  const auto best = static_cast<std::size_t>(place);
  const double skew = skewAt(best);
  if (best == 0 || best + 1 == kNumSkews) return {skew, 0.0, false};
  const Parabola here(total[best - 1], total[best], total[best + 1]);
  return {skew - here.slope / here.curvature * step_, 2.0 / here.curvature * step_ * step_, true};
}

void SkewProfile::locate() {
  const Optimum plain = optimumOf(plain_);
  if (!found_) found_ = Optimum{0.0, 0.0, true};
  found_->is_within = plain.is_within;
  if (!plain.is_within) return;
  found_->skew = plain.skew;
  found_->variance = plain.variance + std::pow(optimumOf(of_noise_).skew - plain.skew, 2) / 3.0;
}

void SkewProfile::interrupt() {
  plain_.closeBlock(share_);
  of_noise_.closeBlock(share_);
  sums_ = {};
}

void SkewProfile::restart() {
  interrupt();
  forgetOlder();
  found_.reset();
}

}  // namespace suspension_health_monitor
