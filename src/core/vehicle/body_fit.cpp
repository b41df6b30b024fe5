#include "suspension_health_monitor/internal/vehicle/body_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>

#include "rigid_body_rows.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/vehicle/tuning.h"

namespace suspension_health_monitor {
namespace {

bool isProven(const Measured& number) { return number.value > kProven * number.stddev; }

/// @return x or y less its middle, over its mean size; zero where all are alike.
Eigen::VectorXd scaled(const Eigen::VectorXd& values, double& middle, double& scale) {
  middle = values.mean();
  const Eigen::VectorXd from = values.array() - middle;
  scale = from.norm() / std::sqrt(static_cast<double>(values.size()));
  return scale > kVehicleTuning.smallest_spread ? Eigen::VectorXd(from / scale) : Eigen::VectorXd::Zero(values.size());
}

struct Solution {
  RigidBody body;
  double phi;
  Eigen::VectorXd parameters;
  Eigen::MatrixXd covariance;
  double chi2 = 0.0;
};

std::optional<Solution> solve(const RigidBody& body, const BodyRows& rows, double phi, const Eigen::VectorXd& start) {
  RigidBodyRows functor(body, rows, phi);
  if (!(functor.degreesOfFreedom() > 0.0)) return std::nullopt;
  Solution solution{body, phi, start.size() == functor.inputs() ? start : functor.start(rows), {}};
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
std::optional<Solution> solve(const RigidBody& body, const BodyRows& rows) {
  double low = std::log(kVehicleTuning.least_phi), high = std::log(kVehicleTuning.most_phi);
  std::optional<Solution> best;
  for (int i = 0; i < kVehicleTuning.halvings; ++i) {
    const double middle = 0.5 * (low + high);
    auto solution = solve(body, rows, std::exp(middle), best ? best->parameters : Eigen::VectorXd());
    if (!solution) return std::nullopt;
    (solution->chi2 > 1.0 ? low : high) = middle;
    best = std::move(solution);
  }
  return best;
}

bool hasNegativeBar(const Solution& solution) {
  for (Eigen::Index i = solution.body.firstBar(); i < solution.parameters.size(); ++i)
    if (solution.parameters[i] < -kProven * std::sqrt(solution.covariance(i, i))) return true;
  return false;
}

bool isNamed(const Solution& without, const Solution& with, const std::vector<BodyRows>& halves) {
  // On multibody vehicles without bars a fit with bars left a phi of more than 2.5 %, on those that have bars 1.1 %.
  if (halves.size() < 2 || !(with.phi < kWorthHaving) || !(without.phi > kMuchMore * with.phi)) return false;
  const RigidBody& body = with.body;
  // From fewer degrees of freedom the misfit is not known: rows of two struts fit a bar that does not exist.
  if (RigidBodyRows(body, halves.front(), with.phi).degreesOfFreedom() < kFewestForScatter) return false;
  if (!body.isVehicle(with.parameters)) return false;
  std::vector<Solution> parts{with};
  for (const BodyRows& half : halves) {
    const auto part = solve(body, half, with.phi, with.parameters);
    if (!part) return false;
    parts.push_back(*part);
  }
  if (std::any_of(parts.begin(), parts.end(), hasNegativeBar)) return false;
  const auto value = [&](std::size_t part, int bar) { return parts[part].parameters[bar]; };
  const auto variance = [&](std::size_t part, int bar) { return parts[part].covariance(bar, bar); };
  for (int bar = body.firstBar(); bar < body.numParameters(); ++bar)
    if (std::abs(value(1, bar) - value(2, bar)) > kProven * std::sqrt(variance(1, bar) + variance(2, bar)))
      return false;
  const int first = body.firstBar(RigidBody::kStiffness);
  for (int bar = first; bar < first + body.numBars(RigidBody::kStiffness); ++bar)
    if (value(0, bar) > kProven * std::sqrt(variance(0, bar))) return true;
  return false;
}

BodyFitResult describe(const Solution& solution) {
  const RigidBody& body = solution.body;
  const int n = body.numStruts();
  BodyFitResult result;
  result.phi = solution.phi;
  const Eigen::MatrixXd rows = body.rows(solution.parameters);
  result.rate = rows.leftCols(n);
  result.travel = rows.rightCols(n);
  // A number of the parameters with its standard deviation, by differences.
  const auto measured = [&](auto&& number) {
    const double value = number(solution.parameters);
    Eigen::VectorXd slope(solution.parameters.size());
    for (Eigen::Index i = 0; i < slope.size(); ++i) {
      const double step = kDifferenceStep * std::max(1.0, std::abs(solution.parameters[i]));
      Eigen::VectorXd moved = solution.parameters;
      moved[i] += step;
      slope[i] = (number(moved) - value) / step;
    }
    return Measured{value, std::sqrt(slope.dot(solution.covariance * slope))};
  };
  using Parameters = Eigen::VectorXd;
  const auto mobility = [&](const Parameters& p) { return body.mobility(body.inertia(p)); };
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto own = [&](int kind) {
      return measured([&](const Parameters& p) { return mobility(p).row(i).dot(body.struts(p, kind).col(i)); });
    };
    result.b1.push_back(own(RigidBody::kDamping));
    result.b0.push_back(own(RigidBody::kStiffness));
  }
  for (int b = 0; b < body.numBars(RigidBody::kStiffness); ++b) {
    const auto atStrut = [&](std::size_t i, int kind) {
      if (body.numBars(kind) == 0) return Measured{0.0, 0.0};
      return measured([&](const Parameters& p) { return mobility(p)(i, i) * p[body.firstBar(kind) + b]; });
    };
    const auto [i, j] = body.pairs[b];
    const BodyFitResult::Bar bar{body.pairs[b],
                                 {atStrut(i, RigidBody::kStiffness), atStrut(j, RigidBody::kStiffness)},
                                 {atStrut(i, RigidBody::kDamping), atStrut(j, RigidBody::kDamping)}};
    if (isProven(bar.stiffness[0])) result.found.push_back(bar);
  }
  const auto numberOf = [&](int i, bool is_seen) {
    Measured number = measured([&](const Parameters& p) { return body.massAndPlace(p)[i]; });
    if (!is_seen) number.stddev = std::numeric_limits<double>::infinity();
    return number;
  };
  result.inertia = {InertiaDoubt::kNone, numberOf(0, body.sees_pitch), numberOf(1, body.sees_roll),
                    numberOf(2, body.sees_pitch), numberOf(3, body.sees_roll)};
  return result;
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

RigidBody::RigidBody(Eigen::Index n, const StrutPlaces& places) : q_(Eigen::MatrixXd::Identity(n, n)) {
  if (places.empty()) return;
  const Eigen::Map<const Eigen::Matrix2Xd> xy(places.front().data(), 2, n);
  const Eigen::VectorXd x = scaled(xy.row(0), middle_[0], scale_[0]), y = scaled(xy.row(1), middle_[1], scale_[1]);
  // Two struts, or all on one line, do not see the body turn about that line.
  Eigen::MatrixXd q(n, 3);
  q << Eigen::VectorXd::Ones(n), x, y;
  sees_pitch = scale_[0] > kVehicleTuning.smallest_spread;
  sees_roll = scale_[1] > kVehicleTuning.smallest_spread && rankOf(q) == (sees_pitch ? 3 : 2);
  if (!sees_pitch) q.col(1) = y;
  q_ = q.leftCols(1 + (sees_pitch ? 1 : 0) + (sees_roll ? 1 : 0));
  if (sees_roll) pairs = pairsOf(places);
}

// S about the middle of the struts is 1/M (1 and inertia about the centre of gravity, x_c off): S_00 = 1 + x_c J
// x_c', S_0x = -x_c J, with J the inverse of the inertia; S is over its own S_00.
Eigen::Vector4d RigidBody::massAndPlace(const Eigen::VectorXd& parameters) const {
  const Eigen::MatrixXd s = inertia(parameters);
  const Eigen::Index m = s.rows() - 1;
  Eigen::VectorXd lengths(m);
  if (sees_pitch) lengths[0] = scale_[0];
  if (sees_roll) lengths[m - 1] = scale_[1];
  const Eigen::MatrixXd j =
      lengths.cwiseInverse().asDiagonal() * s.bottomRightCorner(m, m) * lengths.cwiseInverse().asDiagonal();
  const Eigen::VectorXd first = lengths.cwiseInverse().asDiagonal() * s.col(0).tail(m);
  const Eigen::VectorXd centre = -solveSymmetric(j, first);
  const double share = 1.0 - centre.dot(j * centre);  // 1/M over S_00
  Eigen::Vector4d numbers = Eigen::Vector4d::Zero();
  if (sees_pitch) numbers[0] = j(0, 0) / share, numbers[2] = centre[0] + middle_[0];
  if (sees_roll) numbers[1] = j(m - 1, m - 1) / share, numbers[3] = centre[m - 1] + middle_[1];
  return numbers;
}

bool RigidBody::isVehicle(const Eigen::VectorXd& parameters) const {
  const Eigen::Vector4d numbers = massAndPlace(parameters);
  const auto isPlausible = [&](int axis, Eigen::Index column) {
    const double most = kVehicleTuning.longest_gyration * scale_[axis] * q_.col(column).cwiseAbs().maxCoeff();
    return numbers[axis] * most * most > 1.0;
  };
  return (!sees_pitch || isPlausible(0, 1)) && (!sees_roll || isPlausible(1, q_.cols() - 1));
}

std::optional<BodyFitResult> fitRigidBody(const BodyRows& rows, const StrutPlaces& places,
                                          const std::vector<BodyRows>& halves) {
  using Bars = RigidBody::Bars;
  RigidBody body(rows.size(), places);
  const auto without = solve(body, rows);
  if (!without) return std::nullopt;
  std::optional<Solution> named;  // with bars
  for (const Bars bars : {Bars::kStiffness, Bars::kStiffnessAndDamping}) {
    if (body.pairs.empty()) break;
    body.bars = bars;
    const auto with = solve(body, rows);
    if (!with || (named && !(named->phi > kMuchMore * with->phi))) break;
    if (isNamed(*without, *with, halves)) named = with;
    // Bars that damp, too, are many numbers, which fit what is no bar: of a vehicle that has them the stiffnesses alone
    // leave more, but are not negative.
    if (hasNegativeBar(*with)) break;
  }
  return describe(named ? *named : *without);
}

Eigen::Array2d BodyFitResult::modelVariances(std::size_t strut, const Eigen::Vector2d& own,
                                             double friction_damping) const {
  const Measured &damping = b1[strut], &stiffness = b0[strut];
  // Uniform between nothing and all of it: the mean square from one end is a third.
  return {std::pow(damping.stddev / damping.value * own[0], 2) + friction_damping * friction_damping / 3.0,
          std::pow(stiffness.stddev / stiffness.value * own[1], 2)};
}

BodyRows BodyFitResult::combined(const BodyRows& rows) const {
  BodyRows result = rows;
  const auto combine = [&](const Eigen::MatrixXd& of_body, Eigen::Index first, Eigen::MatrixXd& own) {
    for (Eigen::Index i = 0; i < own.rows(); ++i) {
      const double error = phi * own.row(i).cwiseAbs().maxCoeff();
      for (Eigen::Index j = 0; j < own.cols(); ++j) {
        const double variance = rows.covariance[i](first + j, first + j);
        own(i, j) += variance / (variance + error * error) * (of_body(i, j) - own(i, j));
      }
    }
  };
  combine(rate, 0, result.rate);
  combine(travel, rows.size(), result.travel);
  return result;
}

Measured BodyRows::ratio(Eigen::Index i, Eigen::Index j) const {
  if (i == j) return {1.0, 0.0};
  double weights = 0.0, sum = 0.0;
  const auto add = [&](const Eigen::MatrixXd& of, Eigen::Index at) {
    const double value = of(i, j) / of(j, j);
    const double variance = (covariance[i](at, at) + value * value * covariance[j](at, at)) / (of(j, j) * of(j, j));
    weights += 1.0 / variance;
    sum += value / variance;
  };
  add(rate, j);
  add(travel, size() + j);
  return {sum / weights, 1.0 / std::sqrt(weights)};
}

bool BodyRows::areKnown() const {
  if (!(rate.diagonal().minCoeff() > 0.0 && travel.diagonal().minCoeff() > 0.0)) return false;
  for (Eigen::Index i = 0; i < size(); ++i)
    for (Eigen::Index j = 0; j < size(); ++j)
      // Of a neighbour's force: such an error makes b1 and b0 wrong by a few percent, as wheels hardly ever move alike.
      if (!(ratio(i, j).stddev < kMostRelativeStddev)) return false;
  return true;
}

BodyInertia inertiaOf(const std::optional<BodyFitResult>& fit, const StrutPlaces& places) {
  if (places.empty()) return {InertiaDoubt::kNoPositions};
  if (!fit) return {InertiaDoubt::kUncertain};
  const Measured &pitch = fit->inertia.mass_to_pitch_inertia, &roll = fit->inertia.mass_to_roll_inertia;
  if (!std::isfinite(pitch.stddev) || !std::isfinite(roll.stddev)) return {InertiaDoubt::kOnOneLine};
  if (!isProven(pitch) || !isProven(roll)) return {InertiaDoubt::kUncertain};
  return fit->inertia;
}

}  // namespace suspension_health_monitor
