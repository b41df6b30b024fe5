#include "suspension_health_monitor/internal/fit/free_decay.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kDecayWindow = 1.5;  // [s]: more than a period of the slowest car's bounce, 1 Hz
constexpr int kDecayOverlap = 6;      // windows begin this many times in the length of one

struct DecayWindow {
  Eigen::Matrix2d information;
  Eigen::Vector2d right;
  double power, noise, motion;  // sum of squares; rms of what is left, and of z''
};

// Sums of a window without what its own three numbers explain.
class DecayWindowSums {
 public:
  DecayWindowSums(double period, Eigen::Index count) : period_(period), own_(count, 3) {
    const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(count, -1.0, 1.0);
    own_ << Eigen::VectorXd::Ones(count), t, t.cwiseAbs2().array() - t.cwiseAbs2().mean();  // orthogonal
    own_.colwise().normalize();
  }

  DecayWindow of(const std::vector<CornerSample>& samples, std::size_t first) const {
    const Eigen::Index count = own_.rows();
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(count, 3);  // int u, int int u, z''
    double last = 0.0;
    for (Eigen::Index i = 0; i < count; ++i) {
      const CornerSample& sample = samples[first + i];
      const double u = sample.unsprung_acceleration - sample.sprung_acceleration;
      if (i > 0) {
        columns(i, 0) = columns(i - 1, 0) + 0.5 * period_ * (last + u);
        columns(i, 1) = columns(i - 1, 1) + 0.5 * period_ * (columns(i - 1, 0) + columns(i, 0));
      }
      columns(i, 2) = sample.sprung_acceleration;
      last = u;
    }
    columns -= own_ * (own_.transpose() * columns);
    const Eigen::Matrix3d sums = columns.transpose() * columns;
    DecayWindow window{sums.topLeftCorner<2, 2>(), sums.topRightCorner<2, 1>(), sums(2, 2), 0.0, 0.0};
    const auto n = static_cast<double>(count);
    const double explained = window.right.dot(window.information.ldlt().solve(window.right));
    window.noise = std::sqrt(std::max(0.0, window.power - explained) / n);
    window.motion = std::sqrt(window.power / n);
    return window;
  }

 private:
  double period_;
  Eigen::MatrixXd own_;
};

std::vector<DecayWindow> decayWindowsOf(const std::vector<Drive>& drives, double period, std::size_t count) {
  const DecayWindowSums sums(period, count);
  std::vector<DecayWindow> windows;
  for (const Drive& drive : drives)
    for (std::size_t first = 0; first + count <= drive.samples.size();
         first += std::max<std::size_t>(1, count / kDecayOverlap)) {
      const double span = toSeconds(drive.samples[first + count - 1].stamp - drive.samples[first].stamp);
      if (span < (static_cast<double>(count) - 0.5) * period)
        windows.push_back(sums.of(drive.samples, first));  // no gap
    }
  return windows;
}

}  // namespace

StrutEstimate estimateFromFreeDecays(const std::vector<Drive>& drives) {
  StrutEstimate estimate;
  const double period = medianPeriod(drives);
  const auto count = static_cast<std::size_t>(kDecayWindow / period);
  if (count < kFewestForScatter) return estimate;
  std::vector<DecayWindow> windows = decayWindowsOf(drives, period, count);
  if (windows.empty()) return estimate;
  std::vector<double> noises;
  for (const DecayWindow& window : windows) noises.push_back(window.noise);
  const auto tenth = noises.begin() + noises.size() / 10;
  std::nth_element(noises.begin(), tenth, noises.end());
  // An rms of n values scatters by 1 / sqrt(2 n); the tenth is 1.3 of that below the mean.
  const double most = *tenth * (1.0 + (1.3 + kLikely) / std::sqrt(2.0 * static_cast<double>(count)));
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double power = 0.0, values = 0.0;
  for (const DecayWindow& window : windows) {
    if (window.noise > std::max(most, kWorthHaving * window.motion) || window.motion < kMuchMore * *tenth) continue;
    information += window.information;
    right += window.right;
    power += window.power;
    values += static_cast<double>(count);
  }
  if (values == 0.0) return estimate;
  const Eigen::Vector2d theta = information.ldlt().solve(right);
  // Windows that overlap share their noise: that many count as one.
  const double variance = kDecayOverlap * std::max(0.0, power - right.dot(theta)) / values;
  const Eigen::Matrix2d covariance = variance * information.inverse();
  estimate.damping_to_mass = theta[0];
  estimate.stiffness_to_mass = theta[1];
  estimate.damping_to_mass_stddev = std::sqrt(covariance(0, 0));
  estimate.stiffness_to_mass_stddev = std::sqrt(covariance(1, 1));
  estimate.damping_model_stddev = kWorthHaving * theta[0];  // what is let pass as free
  estimate.stiffness_model_stddev = kWorthHaving * theta[1];
  estimate.correlation = covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1));
  // A damper that is dead is known, too: by the b1 of a damping ratio of 0.1.
  const double damping = std::max(theta[0], 0.2 * std::sqrt(theta[1]));
  const bool is_known = estimate.damping_to_mass_stddev < kMostRelativeStddev * damping &&
                        estimate.stiffness_to_mass_stddev < kMostRelativeStddev * theta[1];
  estimate.doubt = is_known ? EstimateDoubt::kNone : EstimateDoubt::kNotExcited;
  return estimate;
}

}  // namespace suspension_health_monitor
