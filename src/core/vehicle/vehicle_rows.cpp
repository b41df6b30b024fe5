// What VehicleBlocks knows of all blocks at once.
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/vehicle/vehicle_blocks.h"

namespace suspension_health_monitor {

std::optional<TopEstimate> VehicleBlocks::overTheDrive(std::size_t strut) {
  // Blocks of another length before may be those of most of the drive.
  const bool is_earlier = coveredBy(longest_) > coveredBy(estimators_);
  if (!has_model_ && !is_earlier) return std::nullopt;
  BlockEstimator& estimator = (is_earlier ? longest_ : estimators_)[strut];
  const std::optional<WindowEstimate> of_drive = estimator.overTheDrive();
  const auto& all = estimator.ofAllBlocks();
  if (!of_drive || (!all && !isAlone())) return std::nullopt;
  TopEstimate result = estimates_[strut];
  static_cast<WindowEstimate&>(result) = *of_drive;
  result.length = lengthOf(estimator);
  if (isAlone()) return result;
  // Noise of wheels that move alike draws every block the same way: more blocks do not help.
  result.alike = std::max(result.alike, all->alike);
  for (const int i : {kBlockDamping, kBlockStiffness})
    result.covariance(i, i) += std::pow(all->alike * result.theta[i], 2);
  return result;
}

template <class EstimateOf>
bool VehicleBlocks::setRows(const EstimateOf& estimate_of, BodyRows& rows) const {
  const std::size_t n = size();
  rows.is_by_body = vehicle_.numTopsOfBody() == n;
  rows.rate.resize(n, n);
  rows.travel.resize(n, n);
  rows.force.resize(n, vehicle_.known_forces.size());
  rows.force_stddev.resize(rows.force.rows(), rows.force.cols());
  rows.covariance.resize(n);
  using Selection = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * kMostStruts, kMostBlockParameters>;
  for (std::size_t i = 0; i < n; ++i) {
    const auto& estimate = estimate_of(i);
    if (!estimate) return false;
    Selection selection = Selection::Zero(2 * n, estimate->theta.size());
    for (std::size_t j = 0; j < n; ++j) {
      const int at = rateColumn(columns_, i, j);
      selection(j, at) = selection(n + j, at + 1) = 1.0;
    }
    // The damping that other struts see of this one includes what its friction acts as.
    if (looksForFriction()) selection(i, columns_.firstForce()) = estimate->frictionGain();
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2 * kMostStruts, 1> row = selection * estimate->theta;
    rows.rate.row(i) = row.head(n).transpose();
    rows.travel.row(i) = row.tail(n).transpose();
    rows.covariance[i].noalias() = selection * (estimate->covariance * selection.transpose()).eval();
    const int known = columns_.firstForce() + firstKnownForce();
    rows.force.row(i) = estimate->theta.segment(known, rows.force.cols()).transpose();
    const auto variances = estimate->covariance.diagonal().segment(known, rows.force.cols()).array();
    // The variance is 0 of a force that has not changed.
    rows.force_stddev.row(i) = (variances > 0.0).select(variances.sqrt(), HUGE_VAL).matrix().transpose();
  }
  return true;
}

bool VehicleBlocks::rows(BodyRows& rows) const {
  const auto of_all = [&](std::size_t i) -> const auto& { return estimators_[i].ofAllBlocks(); };
  return has_model_ && setRows(of_all, rows);
}

std::optional<BodyRows> VehicleBlocks::rowsOverTheDrive() {
  BodyRows rows;
  if (!setRows([&](std::size_t i) { return overTheDrive(i); }, rows)) return std::nullopt;
  return rows;
}

VehicleClaims VehicleBlocks::claims(const VehicleChannels& vehicle) const {
  const std::size_t n = size(), num_forces = vehicle_.known_forces.size();
  const Modulation& modulation = estimators_.front().equations().undelayed();
  VehicleClaims claims(vehicle, modulation.s(), estimators_.front().count(), hasDeadGyro());
  Eigen::ArrayXXcd spectra(modulation.s().size(), 6 * n + num_forces);
  for (int age = 0; age < estimators_.front().count(); ++age) {
    for (std::size_t i = 0; i < n; ++i) {
      const StrutBlock& block = estimators_[i].block(age);
      for (std::size_t p = 0; p < 3; ++p) {
        modulation.apply(p, block.wheel, spectra.col(2 * p * n + i));
        spectra.col((2 * p + 1) * n + i) = block.body.col(p);
      }
    }
    const StrutBlock& first = estimators_.front().block(age);
    for (std::size_t k = 0; k < num_forces; ++k)
      modulation.apply(2, first.forces.col(firstKnownForce() + k), spectra.col(6 * n + k));
    claims.add(spectra);
  }
  return claims;
}

std::vector<BodyRows> VehicleBlocks::rowsOfHalves() {
  std::vector<BodyRows> halves(2);
  for (const bool is_older : {true, false}) {
    const auto of_half = [&](std::size_t i) {
      const int all = estimators_[i].count(), half = (all - 1) / 2;  // the block between both shares readings with each
      return estimators_[i].ofBlocks(is_older ? all - half : 0, half);
    };
    if (!has_model_ || !setRows(of_half, halves[is_older ? 0 : 1])) return {};
  }
  return halves;
}

}  // namespace suspension_health_monitor
