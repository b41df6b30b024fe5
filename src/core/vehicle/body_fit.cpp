#include "suspension_health_monitor/internal/vehicle/body_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>

#include "rigid_body_rows.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLeastPhi = 1e-4, kMostPhi = 1.0;
constexpr int kHalvings = 14;  // of the logarithm of phi: to 0.06 %
// Multibody vehicles without bars kept more than 2.5 % with false ones in the model, those with bars 1.1 % with them.
constexpr double kLeastLeft = 0.02;
constexpr double kFall = 3.0;  // phi without bars over that with them
constexpr double kSmallest = 1e-6;

/// @return x or y less its middle, over its mean size; zero where all are alike.
Eigen::VectorXd scaled(const Eigen::VectorXd& values, double& middle, double& scale) {
  middle = values.mean();
  const Eigen::VectorXd from = values.array() - middle;
  scale = from.norm() / std::sqrt(static_cast<double>(values.size()));
  return scale > kSmallest ? Eigen::VectorXd(from / scale) : Eigen::VectorXd::Zero(values.size());
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
      if (std::abs(places[i][0] - places[j][0]) <= kSideBySide * (ahead - behind) &&
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
  sees_pitch_ = scale_[0] > kSmallest;
  sees_roll_ = scale_[1] > kSmallest && q.colPivHouseholderQr().rank() == (sees_pitch_ ? 3 : 2);
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
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(jacobian);
  const Eigen::MatrixXd inverse = decomposition.pseudoInverse();
  solution.covariance = inverse * inverse.transpose();
  if (!std::isfinite(solution.chi2)) return std::nullopt;
  return solution;
}

// The phi that makes chi2 equal to its degrees of freedom.
std::optional<BodyFit::Solution> BodyFit::solve(const BodyRows& rows, BodyFitResult::Bars bars) const {
  double low = std::log(kLeastPhi), high = std::log(kMostPhi);
  std::optional<Solution> best;
  for (int i = 0; i < kHalvings; ++i) {
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

bool BodyFit::isNamed(const Solution& without, const Solution& with, BodyFitResult::Bars bars,
                      const std::vector<BodyRows>& halves) const {
  if (halves.size() < 2 || !(with.phi < kLeastLeft) || !(without.phi > kFall * with.phi)) return false;
  const RigidBodyRows functor(q_, pairs_, bars, halves.front(), with.phi);
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
    if (result.bars != Bars::kNone && !(result.phi > kFall * with->phi)) break;
    if (isNamed(*without, *with, bars, halves)) result = describe(*with, bars);
    // Bars that damp, too, are many numbers, which fit what is no bar: of a vehicle that has them the stiffnesses alone
    // leave more, but are not negative.
    if (hasNegativeBar(*with, bars)) break;
  }
  result.phi_of = phi_of;
  return result;
}

}  // namespace suspension_health_monitor
