#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "rigid_body_rows.h"
#include "suspension_health_monitor/internal/vehicle/body_fit.h"

namespace suspension_health_monitor {
namespace {

constexpr double kProvenBar = 3.0;  // standard deviations
constexpr double kStep = 1e-6;   // relative, of differences

}  // namespace

Eigen::Matrix2d BodyFitResult::absoluteCovariance(std::size_t strut, const Eigen::Vector2d& own,
                                                  const Eigen::Matrix2d& covariance, double friction_damping) const {
  const Measured &rate = b1[strut], &travel = b0[strut];
  Eigen::Matrix2d result = covariance;
  // Uniform between nothing and all of it: the mean square from one end is a third.
  result(0, 0) += std::pow(rate.stddev / rate.value * own[0], 2) + friction_damping * friction_damping / 3.0;
  result(1, 1) += std::pow(travel.stddev / travel.value * own[1], 2);
  return result;
}

// S about the middle of the struts is 1/M (1 and inertia about the centre of gravity, x_c off): S_00 = 1 + x_c J
// x_c', S_0x = -x_c J, with J the inverse of the inertia; S is over its own S_00.
Eigen::VectorXd BodyFit::inertia(const Eigen::MatrixXd& s) const {
  const Eigen::Index m = s.rows() - 1;
  Eigen::VectorXd lengths(m);
  if (sees_pitch_) lengths[0] = scale_[0];
  if (sees_roll_) lengths[m - 1] = scale_[1];
  const Eigen::MatrixXd j =
      lengths.cwiseInverse().asDiagonal() * s.bottomRightCorner(m, m) * lengths.cwiseInverse().asDiagonal();
  const Eigen::VectorXd first = lengths.cwiseInverse().asDiagonal() * s.col(0).tail(m);
  const Eigen::VectorXd centre = -j.ldlt().solve(first);
  const double share = 1.0 - centre.dot(j * centre);  // 1/M over S_00
  Eigen::VectorXd numbers(5);                         // M/Iyy, M/Ixx, product, x, y
  numbers.setZero();
  if (sees_pitch_) numbers[0] = j(0, 0) / share, numbers[3] = centre[0] + middle_[0];
  if (sees_roll_) numbers[1] = j(m - 1, m - 1) / share, numbers[4] = centre[m - 1] + middle_[1];
  if (sees_pitch_ && sees_roll_) numbers[2] = j(0, 1) / share;
  return numbers;
}

BodyFitResult BodyFit::describe(const Solution& solution, BodyFitResult::Bars bars) const {
  const auto n = q_.rows();
  const BodyRows none{
      Eigen::MatrixXd::Ones(n, n), Eigen::MatrixXd::Ones(n, n),
      std::vector<Eigen::MatrixXd>(static_cast<std::size_t>(n), Eigen::MatrixXd::Identity(2 * n, 2 * n)), false};
  const RigidBodyRows functor(q_, pairs_, bars, none, 0.0);
  BodyFitResult result;
  result.phi = solution.phi;
  result.bars = bars;
  // A number of the parameters with its standard deviation, by differences.
  const auto measured = [&](auto&& number) {
    const double value = number(solution.parameters);
    Eigen::VectorXd slope(functor.inputs());
    for (int i = 0; i < functor.inputs(); ++i) {
      const double step = kStep * std::max(1.0, std::abs(solution.parameters[i]));
      Eigen::VectorXd moved = solution.parameters;
      moved[i] += step;
      slope[i] = (number(moved) - value) / step;
    }
    return Measured{value, std::sqrt(slope.dot(solution.covariance * slope))};
  };
  const auto mobility = [&](const Eigen::VectorXd& p) {
    return Eigen::MatrixXd(q_ * functor.body(p) * q_.transpose());
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto own = [&](const Eigen::VectorXd& p, int kind) {
      return mobility(p).row(i).dot(functor.struts(p, kind).col(i));
    };
    result.b1.push_back(measured([&](const Eigen::VectorXd& p) { return own(p, 0); }));
    result.b0.push_back(measured([&](const Eigen::VectorXd& p) { return own(p, 1); }));
  }
  for (std::size_t b = 0; bars != BodyFitResult::Bars::kNone && b < pairs_.size(); ++b) {
    const auto i = static_cast<Eigen::Index>(pairs_[b].first), j = static_cast<Eigen::Index>(pairs_[b].second);
    const auto share = [&](const Eigen::VectorXd& p, int kind) {
      if (functor.numBars(kind) == 0) return 0.0;
      const Eigen::MatrixXd a = mobility(p);
      return (a(i, i) - a(i, j)) * p[functor.firstBar(kind) + static_cast<int>(b)];
    };
    const BodyFitResult::Bar bar{pairs_[b], measured([&](const Eigen::VectorXd& p) { return share(p, 1); }),
                                 measured([&](const Eigen::VectorXd& p) { return share(p, 0); })};
    if (bar.stiffness.value > kProvenBar * bar.stiffness.stddev) result.found.push_back(bar);
  }
  Measured* const numbers[] = {&result.mass_to_pitch_inertia, &result.mass_to_roll_inertia, &result.product, &result.x,
                               &result.y};
  const bool is_seen[] = {sees_pitch_, sees_roll_, sees_pitch_ && sees_roll_, sees_pitch_, sees_roll_};
  for (int i = 0; i < 5; ++i) {
    *numbers[i] = measured([&](const Eigen::VectorXd& p) { return inertia(functor.body(p))[i]; });
    if (!is_seen[i]) numbers[i]->stddev = std::numeric_limits<double>::infinity();
  }
  return result;
}

}  // namespace suspension_health_monitor
