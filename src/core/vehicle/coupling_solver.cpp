#include "suspension_health_monitor/internal/vehicle/coupling_solver.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "suspension_health_monitor/internal/vehicle/coupling_errors.h"

namespace suspension_health_monitor {
namespace {

constexpr int kFirstSteps = 30, kBarSteps = 10, kSteps = 3;  // of the alternation: from nothing, with one bar more, on
// A law in one strut shows in the columns of another by chance only; a bar that is worth having takes a tenth.
constexpr double kLeastOfBar = 0.1;
constexpr double kChiSquare = 50.0;  // chi^2 of two more unknowns: chance gives as much once in 7e10

}  // namespace

CouplingSolver::CouplingSolver(const CouplingColumns& columns, CouplingMoments noise)
    : columns_(columns), noise_(std::move(noise)), estimate_(columns) {}

const CouplingEstimate& CouplingSolver::solve(const CouplingMoments& moments, double rows) {
  moments_ = moments;
  rows_ = rows;
  if (!estimate_.isKnown() && !start()) return estimate_;
  refine(estimate_.bars(), kSteps);
  while (addBar()) {
  }
  describeErrors(moments_, noise_, rows_, estimate_);
  estimate_.doubt += valley_doubt_;
  return estimate_;
}

// The alternation goes downhill, and where tracks are alike there is more than one valley. The best is kept; how far
// the others are from it that are no worse for certain is in doubt.
// @return false: there is no strut yet.
bool CouplingSolver::start() {
  const CouplingEstimate before = estimate_;
  std::vector<Valley> valleys;
  for (const CouplingEstimate& begin : beginnings()) {
    estimate_ = begin;
    refine(before.bars(), kFirstSteps);
    const double left = shareLeft();
    if (left < HUGE_VAL) valleys.push_back({left, estimate_});
  }
  if (valleys.empty()) {
    estimate_ = before;
    return false;
  }
  std::sort(valleys.begin(), valleys.end(), [](const Valley& a, const Valley& b) { return a.left < b.left; });
  estimate_ = valleys.front().estimate;
  has_start_ = true;
  valley_doubt_ = doubtOf(valleys);
  return true;
}

// @return what the alternation is begun with: the columns of all struts without the knowledge that the ratios are the
// same for damper and spring; every strut alone; and what is known so far.
std::vector<CouplingEstimate> CouplingSolver::beginnings() const {
  const int n = columns_.struts, inputs = columns_.numInputs();
  const CouplingMoments of_all =
      moments_.topLeftCorner(inputs, inputs).ldlt().solve(moments_.block(0, inputs, inputs, n));
  CouplingEstimate alone = estimate_, together = estimate_;
  for (int j = 0; j < n; ++j) {
    const int damping = columns_.damping(j), stiffness = columns_.stiffness(j), output = columns_.output(j);
    together.damping_to_mass[j] = of_all(damping, j);
    together.stiffness_to_mass[j] = of_all(stiffness, j);
    Eigen::Matrix2d own;
    own << moments_(damping, damping), moments_(damping, stiffness), moments_(stiffness, damping),
        moments_(stiffness, stiffness);
    const Eigen::Vector2d strut =
        own.ldlt().solve(Eigen::Vector2d(moments_(damping, output), moments_(stiffness, output)));
    alone.damping_to_mass[j] = strut[0];
    alone.stiffness_to_mass[j] = strut[1];
  }
  std::vector<CouplingEstimate> begins{std::move(together), std::move(alone)};
  if (has_start_) begins.push_back(estimate_);
  return begins;
}

// @param valleys  the best first.
double CouplingSolver::doubtOf(const std::vector<Valley>& valleys) const {
  const StrutVector power = momentsOfStruts(estimate_, moments_).diagonal().head(columns_.struts);
  double doubt = 0.0;
  for (const Valley& valley : valleys) {
    if (isCertain(valley.left, valleys.front().left)) continue;
    const StrutMatrix off = (valley.estimate.coupling.ratios - estimate_.coupling.ratios).cwiseAbs2();
    doubt = std::max(doubt, std::sqrt((off * power).cwiseQuotient(power).maxCoeff()));
  }
  return doubt;
}

void CouplingSolver::refine(const Bars& bars, int steps) {
  for (int i = 0; i < steps; ++i) {
    const CouplingMoments without_noise = moments_ - sensorVariance(estimate_, moments_, noise_) * noise_;
    solveRatios(without_noise);
    solveStruts(without_noise, bars);
  }
}

// Of all struts as they are the ratios, and what each strut is of the ratios.
void CouplingSolver::solveRatios(const CouplingMoments& moments) {
  Coupling& coupling = estimate_.coupling;
  const int n = columns_.struts, known = n + columns_.forces;
  const CouplingMoments of_struts = momentsOfStruts(estimate_, moments);
  const CouplingMoments solution =
      of_struts.topLeftCorner(known, known).ldlt().solve(of_struts.block(0, known, known, n));
  for (int j = 0; j < n; ++j) {
    const double own = solution(j, j);
    coupling.ratios.col(j) = solution.row(j).transpose() / own;
    coupling.bars.row(j) *= own;
    estimate_.damping_to_mass[j] *= own;
    estimate_.stiffness_to_mass[j] *= own;
  }
  coupling.forces = solution.middleRows(n, columns_.forces).transpose();
}

void CouplingSolver::solveStruts(const CouplingMoments& moments, const Bars& bars) {
  Coupling& coupling = estimate_.coupling;
  const int n = columns_.struts, own = columns_.numOwn();
  const auto [columns, place] = ownUnknowns(n, bars);
  const Eigen::Index unknowns = columns.rows();
  const StrutMatrix weighted = coupling.ratios.transpose() * inverseOf(restMomentsOf(estimate_, moments_));
  const StrutMatrix products = weighted * coupling.ratios;
  const Eigen::MatrixXd inputs = columns * moments.topLeftCorner(own, own) * columns.transpose();
  const Eigen::MatrixXd outputs = columns * (moments.block(0, columns_.numInputs(), own, n) -
                                             moments.block(0, own, own, columns_.forces) * coupling.forces.transpose());
  Eigen::MatrixXd normal(unknowns, unknowns);
  Eigen::VectorXd right(unknowns);
  for (Eigen::Index a = 0; a < unknowns; ++a) {
    const int at = place[static_cast<std::size_t>(a)];
    for (Eigen::Index b = 0; b < unknowns; ++b)
      normal(a, b) = products(at, place[static_cast<std::size_t>(b)]) * inputs(a, b);
    right[a] = outputs.row(a).dot(weighted.row(at));
  }
  const Eigen::VectorXd solution = normal.ldlt().solve(right);
  estimate_.damping_to_mass = solution.head(n);
  estimate_.stiffness_to_mass = solution.segment(n, n);
  Eigen::Index next = own;
  for (const auto& [i, j] : bars) {
    coupling.bars(i, j) = solution[next++];
    coupling.bars(j, i) = solution[next++];
  }
}

// Of the bars that there may be more the one that takes most at the first step of the alternation is tried to its end.
// @return true if it stays.
bool CouplingSolver::addBar() {
  const CouplingEstimate known = estimate_;
  const Bars bars = known.bars();
  const double before = shareLeft();
  CouplingEstimate best = known;
  double least = before;
  for (int i = 0; i < columns_.struts; ++i)
    for (int j = i + 1; j < columns_.struts; ++j) {
      if (known.coupling.bars(i, j) != 0.0) continue;
      estimate_ = known;
      Bars more = bars;
      more.emplace_back(i, j);
      refine(more, 1);
      const double left = shareLeft();
      if (!(left < least && estimate_.coupling.bars(i, j) > 0.0 && estimate_.coupling.bars(j, i) > 0.0)) continue;
      least = left;
      best = estimate_;
    }
  // Of moments that are no numbers, before there are rows enough, nothing is less.
  estimate_ = best;
  if (!(least < before)) return false;
  refine(best.bars(), kBarSteps);
  least = shareLeft();
  const bool are_bars = (estimate_.coupling.bars.array() >= 0.0).all();
  const bool stays = are_bars && before - least >= kLeastOfBar * before && isCertain(before, least);
  if (!stays) estimate_ = known;
  return stays;
}

// @return what is left of all outputs, each over its own size.
double CouplingSolver::shareLeft() const {
  const auto outputs = moments_.diagonal().tail(columns_.struts);
  return restOf(estimate_, moments_).cwiseQuotient(outputs).sum();
}

// @return true if rows that are left so much of by two models are so by no chance.
bool CouplingSolver::isCertain(double left, double less) const { return rows_ * (left - less) >= kChiSquare * less; }

}  // namespace suspension_health_monitor
