#include "suspension_health_monitor/internal/fit/free_decay.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kDecayWindow = 1.5;  // [s]: more than a period of the slowest car's bounce, 1 Hz
constexpr int kDecayOverlap = 6;      // windows begin this many times in the length of one

/// Products of (int u, int int u, z'') with each other, summed over the samples of a window.
using DecayWindow = Eigen::Matrix3d;

/// b1 and b0 by least squares.
Eigen::Vector2d solutionOf(const DecayWindow& products) {
  return products.topLeftCorner<2, 2>().ldlt().solve(products.topRightCorner<2, 1>());
}

/// The residual's sum of squares.
double unexplained(const DecayWindow& products) {
  return std::max(0.0, products(2, 2) - products.topRightCorner<2, 1>().dot(solutionOf(products)));
}

/// What a window's own three numbers explain: orthonormal columns over its samples.
Eigen::MatrixXd ownColumns(Eigen::Index count) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(count, -1.0, 1.0);
  Eigen::MatrixXd own(count, 3);
  own << Eigen::VectorXd::Ones(count), t, t.cwiseAbs2().array() - t.cwiseAbs2().mean();
  own.colwise().normalize();
  return own;
}

/// Sums of a window without what `own` explains.
DecayWindow decayWindow(const CornerSample* samples, double period, const Eigen::MatrixXd& own) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(own.rows(), 3);  // int u, int int u, z''
  double last = 0.0;
  for (Eigen::Index i = 0; i < own.rows(); ++i) {
    const double u = samples[i].unsprung_acceleration - samples[i].sprung_acceleration;
    if (i > 0) {
      columns(i, 0) = columns(i - 1, 0) + 0.5 * period * (last + u);
      columns(i, 1) = columns(i - 1, 1) + 0.5 * period * (columns(i - 1, 0) + columns(i, 0));
    }
    columns(i, 2) = samples[i].sprung_acceleration;
    last = u;
  }
  columns -= own * (own.transpose() * columns);
  return columns.transpose() * columns;
}

std::vector<DecayWindow> decayWindowsOf(const std::vector<Drive>& drives, double period, std::size_t count) {
  const Eigen::MatrixXd own = ownColumns(count);
  std::vector<DecayWindow> windows;
  for (const Drive& drive : drives)
    for (std::size_t first = 0; first + count <= drive.samples.size();
         first += std::max<std::size_t>(1, count / kDecayOverlap)) {
      const double span = toSeconds(drive.samples[first + count - 1].stamp - drive.samples[first].stamp);
      if (span < (static_cast<double>(count) - 0.5) * period)
        windows.push_back(decayWindow(&drive.samples[first], period, own));  // no gap
    }
  return windows;
}

}  // namespace

StrutEstimate estimateFromFreeDecays(const std::vector<Drive>& drives) {
  StrutEstimate estimate;
  const double period = medianPeriod(drives);
  const auto count = static_cast<std::size_t>(kDecayWindow / period);
  if (count < kFewestForScatter) return estimate;
  const std::vector<DecayWindow> windows = decayWindowsOf(drives, period, count);
  if (windows.empty()) return estimate;
  const auto n = static_cast<double>(count);
  const auto noiseOf = [n](const DecayWindow& window) { return std::sqrt(unexplained(window) / n); };  // rms
  std::vector<double> noises = mapped(windows, noiseOf);
  const auto tenth = noises.begin() + noises.size() / 10;
  std::nth_element(noises.begin(), tenth, noises.end());
  // An rms of n values scatters by 1 / sqrt(2 n); the tenth is 1.3 of that below the mean.
  const double most = *tenth * (1.0 + (1.3 + kLikely) / std::sqrt(2.0 * n));
  DecayWindow products = DecayWindow::Zero();
  double values = 0.0;
  for (const DecayWindow& window : windows) {
    const double motion = std::sqrt(window(2, 2) / n);
    if (noiseOf(window) > std::max(most, kWorthHaving * motion) || motion < kMuchMore * *tenth) continue;
    products += window;
    values += n;
  }
  if (values == 0.0) return estimate;
  const Eigen::Vector2d theta = solutionOf(products);
  // Windows that overlap share their noise: that many count as one.
  const double variance = kDecayOverlap * unexplained(products) / values;
  const Eigen::Matrix2d covariance = variance * products.topLeftCorner<2, 2>().inverse();
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
