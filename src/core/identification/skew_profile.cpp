#include "suspension_health_monitor/internal/identification/skew_profile.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr int kRowsOfHorizon = 64, kFewestRows = 32;
constexpr double kAlike = 4.0;       // rows that count as one
constexpr double kFitted = 3.0;      // parameters of every horizon
constexpr double kMemories = 10.0;   // of the estimator: clocks differ by as much for long
constexpr double kRounding = 1e-12;  // of squares

double skewAt(std::size_t j) { return static_cast<double>(j) * SkewProfile::kStep - SkewProfile::kMostSkew; }

/// A parabola through three values kStep apart.
struct Parabola {
  double slope, curvature;  // in the middle

  Parabola(double before, double here, double after)
      : slope((after - before) / (2.0 * SkewProfile::kStep)),
        curvature((after - 2.0 * here + before) / (SkewProfile::kStep * SkewProfile::kStep)) {}
};

}  // namespace

SkewProfile::SkewProfile(const WheelHistory& wheel, int horizon_samples, double forgetting_factor)
    : every_(std::max(1, horizon_samples / kRowsOfHorizon)), horizon_rows_(std::max(kFewestRows, horizon_samples)) {
  for (std::size_t j = 0; j < kNumSkews; ++j) places_.push_back(wheel.place(skewAt(j)));
  setForgettingFactor(forgetting_factor);
}

void SkewProfile::setForgettingFactor(double forgetting_factor) {
  share_ = std::pow(forgetting_factor, horizon_rows_ / kMemories);
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
  if (rows_ < horizon_rows_) return false;
  closeHorizon();
  clear();
  return true;
}

// What is left of psi by the best strut and offset: least squares about the means.
double SkewProfile::rest(const Sums& sums) const {
  const double damping = sums.damping / num_, stiffness = sums.stiffness / num_;
  const double a = sums.damping_square - damping * sums.damping, b = sums.both - damping * sums.stiffness;
  const double c = sums.stiffness_square - stiffness * sums.stiffness;
  const double p = sums.damping_output - damping * output_, q = sums.stiffness_output - stiffness * output_;
  const double determinant = a * c - b * b, square = output_square_ - output_ * output_ / num_;
  const double explained = determinant > 0.0 ? (p * (c * p - b * q) + q * (a * q - b * p)) / determinant : 0.0;
  return std::max(square - explained, kRounding * output_square_);
}

void SkewProfile::closeHorizon() {
  Profile rests;
  std::transform(sums_.begin(), sums_.end(), rests.begin(), [&](const Sums& sums) { return rest(sums); });
  const double least = *std::min_element(rests.begin(), rests.end());
  const double most = *std::max_element(rests.begin(), rests.end());
  if (!(least > 0.0 && std::isfinite(most))) return;
  const double unit = (num_ - kFitted) / kAlike / least;
  if (isKnown()) {
    const double place = std::round((skew_ + kMostSkew) / kStep);
    const auto j = static_cast<std::size_t>(std::clamp(place, 1.0, static_cast<double>(kNumSkews - 2)));
    const Parabola here(rests[j - 1], rests[j], rests[j + 1]);
    scatter_ = share_ * scatter_ + std::pow(unit * (here.slope + here.curvature * (skew_ - skewAt(j))), 2);
  }
  for (std::size_t j = 0; j < kNumSkews; ++j) misfit_[j] = share_ * misfit_[j] + unit * rests[j];
  ++horizons_;
  locate();
}

void SkewProfile::locate() {
  Profile total;
  for (std::size_t j = 0; j < kNumSkews; ++j) total[j] = misfit_[j] + std::pow(skewAt(j) / kUsualSkew, 2);
  const auto best = static_cast<std::size_t>(std::min_element(total.begin(), total.end()) - total.begin());
  is_within_ = best > 0 && best + 1 < kNumSkews;
  if (!is_within_) return;
  const Parabola here(total[best - 1], total[best], total[best + 1]);
  if (!(here.curvature > 0.0)) return;
  skew_ = skewAt(best) - here.slope / here.curvature;
  variance_ = (2.0 * here.curvature + scatter_) / (here.curvature * here.curvature);
}

void SkewProfile::clear() {
  sums_.fill({});
  output_ = output_square_ = num_ = 0.0;
  rows_ = 0;
}

void SkewProfile::restart() {
  clear();
  misfit_.fill(0.0);
  scatter_ = 0.0;
  horizons_ = 0;
  skew_ = 0.0;
  variance_ = kUsualSkew * kUsualSkew;
  is_within_ = true;
}

}  // namespace suspension_health_monitor
