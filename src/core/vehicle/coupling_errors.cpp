#include "suspension_health_monitor/internal/vehicle/coupling_errors.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

// The share that noise has in the rows is known to a half: it is that of the residual, which is not all noise.
constexpr double kNoiseKnown = 0.5;

/// Where the unknowns of a joint estimate stand: by strut its ratios to the others and its coefficients of known
/// forces, then what all struts do of their own.
struct JointUnknowns {
  int struts, forces;

  int ofStrut() const { return struts - 1 + forces; }
  int num() const { return struts * ofStrut(); }
  int at(int strut, int cause) const { return strut * ofStrut() + (cause < strut ? cause : cause - 1); }
};

// Which struts the rows tell apart least.
void describeAlike(const CouplingMoments& moments, const CouplingMoments& noise, CouplingEstimate& estimate) {
  const Eigen::Index n = estimate.damping_to_mass.size();
  const StrutMatrix of_noise = momentsOfStruts(estimate, noise).topLeftCorner(n, n);
  const StrutMatrix with_noise = momentsOfStruts(estimate, moments).topLeftCorner(n, n);
  const Eigen::GeneralizedSelfAdjointEigenSolver<StrutMatrix> parts(with_noise, of_noise);
  estimate.told_apart = parts.eigenvalues()[0];
  StrutVector sizes = parts.eigenvectors().col(0).cwiseAbs();
  const auto largest = [&] {
    return static_cast<int>(std::max_element(sizes.data(), sizes.data() + n) - sizes.data());
  };
  estimate.first_alike = largest();
  sizes[estimate.first_alike] = -1.0;
  estimate.second_alike = largest();
}

// @return ratio of the largest to the least size of a combination of the columns of all struts, each scaled to 1.
double conditionOf(const CouplingMoments& columns) {
  const CouplingRow size = columns.diagonal().cwiseSqrt().cwiseInverse();
  const CouplingMoments scaled = size.asDiagonal() * columns * size.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<CouplingMoments> spread(scaled, Eigen::EigenvaluesOnly);
  return std::sqrt(spread.eigenvalues()[columns.rows() - 1] / spread.eigenvalues()[0]);
}

// The information that the rows have of all unknowns together, of z_i'' by rho_ij, j != i, kappa_ik and by what every
// strut does of its own. One by one they would seem to be known far better where tracks are alike.
// @param moments  without the noise's.  @param of_struts  those of p_j and x_k.
// @param rows  by strut and strut: how many of independent errors, times inverseOf() what is left.
Eigen::MatrixXd informationOf(const CouplingMoments& moments, const CouplingMoments& of_struts,
                              const CouplingEstimate& estimate, const StrutMatrix& rows) {
  const auto n = static_cast<int>(rows.rows()), forces = static_cast<int>(of_struts.rows()) - n;
  const JointUnknowns joint{n, forces};
  const auto [columns, place] = ownUnknowns(n, estimate.bars());
  const Eigen::Index num_own = columns.rows();
  Eigen::MatrixXd ratios(n, num_own);  // of the strut that an unknown belongs to
  for (Eigen::Index a = 0; a < num_own; ++a)
    ratios.col(a) = estimate.coupling.ratios.col(place[static_cast<std::size_t>(a)]);
  const Eigen::MatrixXd weighted = rows * ratios, with_own = columns * moments.topLeftCorner(2 * n, 2 * n);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(joint.num() + num_own, joint.num() + num_own);
  for (int j = 0; j < n + forces; ++j) {
    const Eigen::VectorXd with_other =
        j < n ? Eigen::VectorXd(with_own * ownColumns(estimate, j)) : columns * moments.col(n + j).head(2 * n);
    for (int i = 0; i < n; ++i) {
      if (i == j) continue;
      for (int l = 0; l < n + forces; ++l)
        for (int m = 0; m < n; ++m)
          if (m != l) information(joint.at(i, j), joint.at(m, l)) = rows(i, m) * of_struts(j, l);
      information.row(joint.at(i, j)).tail(num_own) = weighted.row(i).cwiseProduct(with_other.transpose());
    }
  }
  information.bottomLeftCorner(num_own, joint.num()) = information.topRightCorner(joint.num(), num_own).transpose();
  information.bottomRightCorner(num_own, num_own) =
      (ratios.transpose() * weighted).cwiseProduct(with_own * columns.transpose());
  return information;
}

// @return the largest rms that the errors of ratios and of forces' coefficients give a strut's own acceleration, as a
// share of it.
double largestShare(const Eigen::MatrixXd& covariance, const CouplingMoments& of_struts, const JointUnknowns& joint) {
  double most = 0.0;
  for (int i = 0; i < joint.struts; ++i) {
    double error = 0.0;
    for (int j = 0; j < joint.struts + joint.forces; ++j)
      for (int l = 0; l < joint.struts + joint.forces; ++l)
        if (j != i && l != i) error += covariance(joint.at(i, j), joint.at(i, l)) * of_struts(j, l);
    most = std::max(most, error / of_struts(i, i));
  }
  return std::sqrt(most);
}

void describeStddevs(const Eigen::MatrixXd& covariance, const CouplingMoments& of_struts, const JointUnknowns& joint,
                     CouplingEstimate& estimate) {
  const auto deviation = [&](Eigen::Index unknown) { return std::sqrt(covariance(unknown, unknown)); };
  const double of_noise = kNoiseKnown / estimate.told_apart;
  for (int i = 0; i < joint.struts; ++i) {
    for (int j = 0; j < joint.struts; ++j)
      if (j != i) estimate.stddevs(i, j) = deviation(joint.at(i, j));
    for (int k = 0; k < joint.forces; ++k) {
      const int cause = joint.struts + k;
      estimate.force_stddevs(i, k) = of_struts(cause, cause) > 0.0 ? deviation(joint.at(i, cause)) : HUGE_VAL;
    }
    const int damping = joint.num() + i, stiffness = damping + joint.struts;
    estimate.own_stddevs(i, 0) = std::hypot(deviation(damping), of_noise * estimate.damping_to_mass[i]);
    estimate.own_stddevs(i, 1) = std::hypot(deviation(stiffness), of_noise * estimate.stiffness_to_mass[i]);
  }
}

}  // namespace

void describeErrors(const CouplingMoments& moments, const CouplingMoments& noise, double rows,
                    CouplingEstimate& estimate) {
  const auto n = static_cast<int>(estimate.damping_to_mass.size());
  const JointUnknowns joint{n, static_cast<int>(estimate.coupling.forces.cols())};
  const int known = n + joint.forces;
  const CouplingMoments of_noise = sensorVariance(estimate, moments, noise) * noise;
  const CouplingMoments without = moments - of_noise;
  const CouplingMoments of_struts = momentsOfStruts(estimate, without).topLeftCorner(known, known);
  estimate.coupling.own_power = of_struts.diagonal().head(n);
  estimate.coupling.rest = restMomentsOf(estimate, moments);
  estimate.condition = conditionOf(moments.topLeftCorner(2 * n, 2 * n));
  describeAlike(moments, of_noise, estimate);
  const Eigen::MatrixXd information =
      informationOf(without, of_struts, estimate, rows * inverseOf(estimate.coupling.rest));
  const Eigen::MatrixXd covariance =
      information.ldlt().solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
  describeStddevs(covariance, of_struts, joint, estimate);
  estimate.doubt = largestShare(covariance, of_struts, joint) + kNoiseKnown / estimate.told_apart;
  const bool are_struts = estimate.damping_to_mass.minCoeff() > 0.0 && estimate.stiffness_to_mass.minCoeff() > 0.0;
  if (!(estimate.doubt >= 0.0) || !are_struts || !(estimate.coupling.own_power.minCoeff() > 0.0))
    estimate.doubt = HUGE_VAL;
}

}  // namespace suspension_health_monitor
