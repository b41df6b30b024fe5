#include "suspension_health_monitor/internal/vehicle/coupling_estimate.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

// A share of 3 % of a strut's own acceleration makes its b1 and b0 wrong by as much at most: a fifth of what warns.
constexpr double kMostDoubt = 0.03;

constexpr double kRounding = 1e-9;  // of the outputs' mean square: less than any sensor leaves

}  // namespace

CouplingEstimate::CouplingEstimate(const CouplingColumns& columns)
    : stddevs(StrutMatrix::Constant(columns.struts, columns.struts, HUGE_VAL)),
      force_stddevs(ForceMatrix::Constant(columns.struts, columns.forces, HUGE_VAL)),
      damping_to_mass(StrutVector::Zero(columns.struts)),
      stiffness_to_mass(StrutVector::Zero(columns.struts)) {
  coupling.ratios = StrutMatrix::Identity(columns.struts, columns.struts);
  coupling.forces.setZero(columns.struts, columns.forces);
  coupling.bars = StrutMatrix::Zero(columns.struts, columns.struts);
  coupling.own_power = StrutVector::Zero(columns.struts);
  own_stddevs.setZero(columns.struts, 2);
  stddevs.diagonal().setZero();
}

bool CouplingEstimate::isKnown() const { return doubt <= kMostDoubt; }

std::vector<StrutModel> CouplingEstimate::models() const {
  std::vector<StrutModel> models;
  for (Eigen::Index i = 0; i < damping_to_mass.size(); ++i)
    models.push_back({damping_to_mass[i], stiffness_to_mass[i], {}, {}});
  return models;
}

std::vector<std::pair<int, int>> CouplingEstimate::bars() const {
  std::vector<std::pair<int, int>> pairs;
  const auto n = static_cast<int>(coupling.bars.rows());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      if (coupling.bars(i, j) != 0.0) pairs.emplace_back(i, j);
  return pairs;
}

OwnUnknowns ownUnknowns(int num_struts, const std::vector<std::pair<int, int>>& bars) {
  const int own = 2 * num_struts;
  OwnUnknowns unknowns;
  unknowns.columns = Eigen::MatrixXd::Zero(own + 2 * static_cast<Eigen::Index>(bars.size()), own);
  for (int a = 0; a < own; ++a) {
    unknowns.columns(a, a) = 1.0;
    unknowns.place.push_back(a % num_struts);
  }
  for (const auto& [i, j] : bars)
    for (const auto& [at, other] : {std::pair(i, j), std::pair(j, i)}) {
      const auto row = static_cast<Eigen::Index>(unknowns.place.size());
      unknowns.columns(row, num_struts + at) = 1.0;
      unknowns.columns(row, num_struts + other) = -1.0;
      unknowns.place.push_back(at);
    }
  return unknowns;
}

CouplingRow ownColumns(const CouplingEstimate& estimate, int j) {
  const auto n = static_cast<int>(estimate.damping_to_mass.size());
  CouplingRow own = CouplingRow::Zero(2 * n);
  own[j] = estimate.damping_to_mass[j];
  own[n + j] = estimate.stiffness_to_mass[j];
  for (int m = 0; m < n; ++m) {
    own[n + j] += estimate.coupling.bars(j, m);
    own[n + m] -= estimate.coupling.bars(j, m);
  }
  return own;
}

CouplingMoments momentsOfStruts(const CouplingEstimate& estimate, const CouplingMoments& moments) {
  const auto n = static_cast<int>(estimate.damping_to_mass.size());
  const Eigen::Index rest = moments.rows() - 2 * n;
  CouplingMoments to = CouplingMoments::Zero(n + rest, 2 * n + rest);
  for (int j = 0; j < n; ++j) to.row(j).head(2 * n) = ownColumns(estimate, j).transpose();
  to.bottomRightCorner(rest, rest).setIdentity();
  const CouplingMoments half = to * moments;
  return half * to.transpose();
}

StrutMatrix restMomentsOf(const CouplingEstimate& estimate, const CouplingMoments& moments) {
  const Eigen::Index n = estimate.damping_to_mass.size(), forces = estimate.coupling.forces.cols();
  Eigen::MatrixXd left(n, 2 * n + forces);
  left << -estimate.coupling.ratios, -estimate.coupling.forces, StrutMatrix::Identity(n, n);
  StrutMatrix rest = left * momentsOfStruts(estimate, moments) * left.transpose();
  rest.diagonal().array() += kRounding * moments.diagonal().tail(n).mean();
  return rest;
}

StrutVector restOf(const CouplingEstimate& estimate, const CouplingMoments& moments) {
  return restMomentsOf(estimate, moments).diagonal();
}

StrutMatrix inverseOf(const StrutMatrix& rest) {
  return rest.ldlt().solve(StrutMatrix::Identity(rest.rows(), rest.cols()));
}

// Of moments that are no numbers, before there are rows enough, the noise is 0.
double sensorVariance(const CouplingEstimate& estimate, const CouplingMoments& moments, const CouplingMoments& noise) {
  const StrutVector rest = restOf(estimate, moments), gain = restOf(estimate, noise);
  double least = HUGE_VAL;
  for (Eigen::Index i = 0; i < rest.size(); ++i) least = std::min(least, std::max(0.0, rest[i]) / gain[i]);
  return least;
}

}  // namespace suspension_health_monitor
