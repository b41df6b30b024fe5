#include "suspension_health_monitor/internal/vehicle/neighbour_weights.h"

#include <Eigen/Cholesky>

namespace suspension_health_monitor {
namespace {

// Share of a neighbour's force that its model may miss, as that of a damper that has just failed: so much of it must not
// reach others.
constexpr double kUnmodelled = 0.4;

}  // namespace

NeighbourWeights::NeighbourWeights(const Coupling& coupling)
    : combination_(coupling.ratios), leak_(coupling.ratios), coupling_(coupling) {
  const Eigen::Index n = coupling.numStruts();
  for (Eigen::Index i = 0; i < n; ++i) {
    StrutMatrix unwanted = coupling.rest;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (j == i) continue;
      const double power = kUnmodelled * kUnmodelled * coupling.own_power[j];
      unwanted += power * coupling.ratios.col(j) * coupling.ratios.col(j).transpose();
    }
    const StrutVector direction = unwanted.ldlt().solve(coupling.ratios.col(i));
    combination_.row(i) = direction.transpose() / direction.dot(coupling.ratios.col(i));
  }
  leak_ = combination_ * coupling.ratios;
  leak_.diagonal().setZero();
}

StrutVector NeighbourWeights::neighbours(const StrutVector& moving, const ForceVector& forces,
                                         const StrutVector& modelled) const {
  StrutVector of_struts = moving;
  if (coupling_.forces.cols() > 0) of_struts -= coupling_.forces * forces;
  return moving - combination_ * of_struts + leaked(modelled);
}

}  // namespace suspension_health_monitor
