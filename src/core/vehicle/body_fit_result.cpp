#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "rigid_body_rows.h"
#include "suspension_health_monitor/internal/statistics.h"
#include "suspension_health_monitor/internal/vehicle/body_fit.h"

namespace suspension_health_monitor {
namespace {

constexpr double kStep = 1e-6;  // relative, of differences

bool isProven(const Measured& number) { return number.value > kProven * number.stddev; }

}  // namespace

Measured BodyRows::ratio(Eigen::Index i, Eigen::Index j) const {
  const auto n = size();
  double weights = 0.0, sum = 0.0;
  for (const bool is_travel : {false, true}) {
    const Eigen::MatrixXd& of = is_travel ? travel : rate;
    const Eigen::Index at = is_travel ? n : 0;
    const double value = of(i, j) / of(j, j);
    const double variance = (covariance[static_cast<std::size_t>(i)](at + j, at + j) +
                             value * value * covariance[static_cast<std::size_t>(j)](at + j, at + j)) /
                            (of(j, j) * of(j, j));
    weights += 1.0 / variance;
    sum += value / variance;
  }
  return i == j ? Measured{1.0, 0.0} : Measured{sum / weights, 1.0 / std::sqrt(weights)};
}

bool BodyRows::areKnown() const {
  if (!(rate.diagonal().minCoeff() > 0.0 && travel.diagonal().minCoeff() > 0.0)) return false;
  for (Eigen::Index i = 0; i < size(); ++i)
    for (Eigen::Index j = 0; j < size(); ++j)
      // Of a neighbour's force: such an error makes b1 and b0 wrong by a few percent, as wheels hardly ever move alike.
      if (!(ratio(i, j).stddev < kMostRelativeStddev)) return false;
  return true;
}

std::vector<StrutModel> BodyRows::models() const {
  std::vector<StrutModel> models;
  for (Eigen::Index i = 0; i < size(); ++i) models.push_back({rate(i, i), travel(i, i), {}, {}});
  return models;
}

Eigen::Matrix2d BodyFitResult::absoluteCovariance(std::size_t strut, const Eigen::Vector2d& own,
                                                  const Eigen::Matrix2d& covariance, double friction_damping) const {
  const Measured &damping = b1[strut], &stiffness = b0[strut];
  Eigen::Matrix2d result = covariance;
  // Uniform between nothing and all of it: the mean square from one end is a third.
  result(0, 0) += std::pow(damping.stddev / damping.value * own[0], 2) + friction_damping * friction_damping / 3.0;
  result(1, 1) += std::pow(stiffness.stddev / stiffness.value * own[1], 2);
  return result;
}

BodyRows BodyFitResult::combined(const BodyRows& rows) const {
  BodyRows result = rows;
  const auto combine = [&](const Eigen::MatrixXd& of_body, Eigen::Index first, Eigen::MatrixXd& own) {
    for (Eigen::Index i = 0; i < own.rows(); ++i) {
      const double error = phi * own.row(i).cwiseAbs().maxCoeff();
      for (Eigen::Index j = 0; j < own.cols(); ++j) {
        const double variance = rows.covariance[static_cast<std::size_t>(i)](first + j, first + j);
        own(i, j) += variance / (variance + error * error) * (of_body(i, j) - own(i, j));
      }
    }
  };
  combine(rate, 0, result.rate);
  combine(travel, rows.size(), result.travel);
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
      Eigen::MatrixXd::Ones(n, n),
      Eigen::MatrixXd::Ones(n, n),
      {},
      {},
      std::vector<Eigen::MatrixXd>(static_cast<std::size_t>(n), Eigen::MatrixXd::Identity(2 * n, 2 * n)),
      false};
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
  result.rate = mobility(solution.parameters) * functor.struts(solution.parameters, 0);
  result.travel = mobility(solution.parameters) * functor.struts(solution.parameters, 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto own = [&](const Eigen::VectorXd& p, int kind) {
      return mobility(p).row(i).dot(functor.struts(p, kind).col(i));
    };
    result.b1.push_back(measured([&](const Eigen::VectorXd& p) { return own(p, 0); }));
    result.b0.push_back(measured([&](const Eigen::VectorXd& p) { return own(p, 1); }));
  }
  for (std::size_t b = 0; bars != BodyFitResult::Bars::kNone && b < pairs_.size(); ++b) {
    const auto atStrut = [&](std::size_t strut, int kind) {
      const auto i = static_cast<Eigen::Index>(strut);
      return measured([&](const Eigen::VectorXd& p) {
        return functor.numBars(kind) == 0 ? 0.0 : mobility(p)(i, i) * p[functor.firstBar(kind) + static_cast<int>(b)];
      });
    };
    const auto [first, second] = pairs_[b];
    const BodyFitResult::Bar bar{
        pairs_[b], {atStrut(first, 1), atStrut(second, 1)}, {atStrut(first, 0), atStrut(second, 0)}};
    if (isProven(bar.stiffness[0])) result.found.push_back(bar);
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

BodyInertiaResult inertiaOf(const std::optional<BodyFitResult>& fit, const StrutPlaces& places) {
  if (places.empty()) return {{}, InertiaDoubt::kNoPositions};
  if (!fit) return {{}, InertiaDoubt::kUncertain};
  const BodyInertia body{fit->mass_to_pitch_inertia, fit->mass_to_roll_inertia, fit->x, fit->y};
  if (!std::isfinite(body.mass_to_pitch_inertia.stddev) || !std::isfinite(body.mass_to_roll_inertia.stddev))
    return {{}, InertiaDoubt::kOnOneLine};
  if (!isProven(body.mass_to_pitch_inertia) || !isProven(body.mass_to_roll_inertia))
    return {{}, InertiaDoubt::kUncertain};
  return {body, InertiaDoubt::kNone};
}

}  // namespace suspension_health_monitor
