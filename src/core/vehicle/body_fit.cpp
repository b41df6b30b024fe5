#include "suspension_health_monitor/internal/vehicle/body_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>

#include "rigid_body_rows.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/vehicle/tuning.h"

namespace suspension_health_monitor {
namespace {

/// @return x or y less its middle, over its mean size; zero where all are alike.
Eigen::VectorXd scaled(const Eigen::VectorXd& values, double& middle, double& scale) {
  middle = values.mean();
  const Eigen::VectorXd from = values.array() - middle;
  scale = from.norm() / std::sqrt(static_cast<double>(values.size()));
  return scale > kVehicleTuning.smallest_spread ? Eigen::VectorXd(from / scale) : Eigen::VectorXd::Zero(values.size());
}

}  // namespace

std::vector<StrutPair> pairsOf(const StrutPlaces& places) {
  double ahead = -std::numeric_limits<double>::infinity(), behind = -ahead, side = 0.0;
  for (const auto& place : places) {
    ahead = std::max(ahead, place[0]);
    behind = std::min(behind, place[0]);
    side += place[1] / static_cast<double>(places.size());
  }
  std::vector<StrutPair> pairs;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = i + 1; j < places.size(); ++j)
      if (std::abs(places[i][0] - places[j][0]) <= kSmall * (ahead - behind) &&
          (places[i][1] - side) * (places[j][1] - side) < 0.0)
        pairs.emplace_back(i, j);
  return pairs;
}

BodyFit::BodyFit(const StrutPlaces& places, const std::vector<StrutPair>& pairs) : pairs_(pairs) {
  const auto n = static_cast<Eigen::Index>(places.size());
  Eigen::VectorXd x(n), y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    x[i] = places[static_cast<std::size_t>(i)][0];
    y[i] = places[static_cast<std::size_t>(i)][1];
  }
  x = scaled(x, middle_[0], scale_[0]);
  y = scaled(y, middle_[1], scale_[1]);
  // Two struts, or all on one line, do not see the body turn about that line.
  Eigen::MatrixXd q(n, 3);
  q << Eigen::VectorXd::Ones(n), x, y;
  sees_pitch_ = scale_[0] > kVehicleTuning.smallest_spread;
  sees_roll_ = scale_[1] > kVehicleTuning.smallest_spread && rankOf(q) == (sees_pitch_ ? 3 : 2);
  q_.resize(n, 1 + (sees_pitch_ ? 1 : 0) + (sees_roll_ ? 1 : 0));
  q_.col(0).setOnes();
  if (sees_pitch_) q_.col(1) = x;
  if (sees_roll_) q_.rightCols<1>() = y;
  if (!sees_roll_) pairs_.clear();
}

BodyFit::BodyFit(std::size_t struts) {
  const auto n = static_cast<Eigen::Index>(struts);
  q_.setIdentity(n, n);
}

BodyFit BodyFit::of(std::size_t struts, const StrutPlaces& places) {
  return places.empty() ? BodyFit(struts) : BodyFit(places, pairsOf(places));
}

std::optional<BodyFit::Solution> BodyFit::solve(const BodyRows& rows, BodyFitResult::Bars bars, double phi,
                                                const Eigen::VectorXd& start) const {
  RigidBodyRows functor(q_, pairs_, bars, rows, phi);
  if (!(functor.degreesOfFreedom() > 0.0)) return std::nullopt;
  Solution solution;
  solution.phi = phi;
  solution.parameters = start.size() == functor.inputs() ? start : functor.start(rows);
  Eigen::LevenbergMarquardt<RigidBodyRows> solver(functor);
  solver.minimize(solution.parameters);
  if (!solution.parameters.allFinite()) return std::nullopt;
  Eigen::VectorXd distance(functor.values());
  functor(solution.parameters, distance);
  solution.chi2 = distance.squaredNorm() / functor.degreesOfFreedom();
  Eigen::MatrixXd jacobian(functor.values(), functor.inputs());
  functor.df(solution.parameters, jacobian);
  const Eigen::MatrixXd inverse = pseudoInverse(jacobian);
  solution.covariance = inverse * inverse.transpose();
  if (!std::isfinite(solution.chi2)) return std::nullopt;
  return solution;
}

// The phi that makes chi2 equal to its degrees of freedom.
std::optional<BodyFit::Solution> BodyFit::solve(const BodyRows& rows, BodyFitResult::Bars bars) const {
  double low = std::log(kVehicleTuning.least_phi), high = std::log(kVehicleTuning.most_phi);
  std::optional<Solution> best;
  for (int i = 0; i < kVehicleTuning.halvings; ++i) {
    const double middle = 0.5 * (low + high);
    auto solution = solve(rows, bars, std::exp(middle), best ? best->parameters : Eigen::VectorXd());
    if (!solution) return std::nullopt;
    (solution->chi2 > 1.0 ? low : high) = middle;
    best = std::move(solution);
  }
  return best;
}

bool BodyFit::hasNegativeBar(const Solution& solution, BodyFitResult::Bars bars) const {
  const auto count = static_cast<Eigen::Index>(pairs_.size());
  const Eigen::Index bar_parameters = bars == BodyFitResult::Bars::kNone        ? 0
                                      : bars == BodyFitResult::Bars::kStiffness ? count
                                                                                : 2 * count;
  for (Eigen::Index i = solution.parameters.size() - bar_parameters; i < solution.parameters.size(); ++i)
    if (solution.parameters[i] < -kProven * std::sqrt(solution.covariance(i, i))) return true;
  return false;
}

// Where laws with memory look like bars the body that goes with them is none.
bool BodyFit::isVehicle(const Eigen::VectorXd& numbers) const {
  const auto isPlausible = [&](int axis, Eigen::Index column) {
    const double most = kVehicleTuning.longest_gyration * scale_[axis] * q_.col(column).cwiseAbs().maxCoeff();
    return numbers[axis] * most * most > 1.0;
  };
  return (!sees_pitch_ || isPlausible(0, 1)) && (!sees_roll_ || isPlausible(1, q_.cols() - 1));
}

bool BodyFit::isNamed(const Solution& without, const Solution& with, BodyFitResult::Bars bars,
                      const std::vector<BodyRows>& halves) const {
  // Multibody vehicles without bars kept a phi of more than 2.5 % with false ones, those with bars 1.1 % with them.
  if (halves.size() < 2 || !(with.phi < kWorthHaving) || !(without.phi > kMuchMore * with.phi)) return false;
  const RigidBodyRows functor(q_, pairs_, bars, halves.front(), with.phi);
  // Of fewer numbers that are left over nobody knows how much is left: two struts fit a bar that is none.
  if (functor.degreesOfFreedom() < kFewestForScatter) return false;
  if (!isVehicle(inertia(functor.body(with.parameters)))) return false;
  std::vector<Solution> parts{with};
  for (const BodyRows& half : halves) {
    const auto part = solve(half, bars, with.phi, with.parameters);
    if (!part) return false;
    parts.push_back(*part);
  }
  for (const Solution& part : parts)
    if (hasNegativeBar(part, bars)) return false;
  bool is_any_proven = false;
  for (const int kind : {0, 1})
    for (int p = 0; p < functor.numBars(kind); ++p) {
      const int at = functor.firstBar(kind) + p;
      const auto value = [&](std::size_t i) { return parts[i].parameters[at]; };
      const auto variance = [&](std::size_t i) { return parts[i].covariance(at, at); };
      if (std::abs(value(1) - value(2)) > kProven * std::sqrt(variance(1) + variance(2))) return false;
      if (kind == 1) is_any_proven = is_any_proven || value(0) > kProven * std::sqrt(variance(0));
    }
  return is_any_proven;
}

std::optional<BodyFitResult> BodyFit::fit(const BodyRows& rows, const std::vector<BodyRows>& halves) const {
  using Bars = BodyFitResult::Bars;
  const auto without = solve(rows, Bars::kNone);
  if (!without) return std::nullopt;
  BodyFitResult result = describe(*without, Bars::kNone);
  std::array<std::optional<double>, 3> phi_of;
  phi_of[0] = without->phi;
  for (const Bars bars : {Bars::kStiffness, Bars::kStiffnessAndDamping}) {
    if (pairs_.empty()) break;
    const auto with = solve(rows, bars);
    if (!with) break;
    phi_of[static_cast<std::size_t>(bars)] = with->phi;
    if (result.bars != Bars::kNone && !(result.phi > kMuchMore * with->phi)) break;
    if (isNamed(*without, *with, bars, halves)) result = describe(*with, bars);
    // Bars that damp, too, are many numbers, which fit what is no bar: of a vehicle that has them the stiffnesses alone
    // leave more, but are not negative.
    if (hasNegativeBar(*with, bars)) break;
  }
  result.phi_of = phi_of;
  return result;
}

namespace {

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
  const Eigen::VectorXd centre = -solveSymmetric(j, first);
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
      const double step = kDifferenceStep * std::max(1.0, std::abs(solution.parameters[i]));
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
