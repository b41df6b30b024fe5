#pragma once

#include "suspension_health_monitor/internal/vehicle/coupling.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// How a strut's own part of the body's acceleration, p_i, is told from the accelerations of all strut tops:
///   p_i = l_i' (z'' - kappa x) - sum_{j != i} (l_i' rho_j) p_j,   l_i' rho_i = 1,
/// with the l_i that lets the least power of noise and of unknown neighbours through: the minimum variance beamformer
/// of Capon, Proceedings of the IEEE 57 (1969), 1408-1418. A body has three motions, so of more than three struts
/// something of the neighbours remains in l_i' z''; that part alone is taken off by their models.
class NeighbourWeights {
 public:
  explicit NeighbourWeights(const Coupling& coupling);

  /// @param moving  z'' without gravity [m/s^2].  @param forces  x without what is constant in them.
  /// @param modelled  p_j as the neighbours' models tell it [m/s^2].
  /// @return n_i, what the other struts and known forces do to the top of strut i [m/s^2].
  StrutVector neighbours(const StrutVector& moving, const ForceVector& forces, const StrutVector& modelled) const;

  /// @return p as far as the strut tops alone tell it: Wiener's estimate, which leaves out what moves no strut top.
  StrutVector ownOf(const StrutVector& moving, const ForceVector& forces) const {
    return estimate_ * ofStruts(moving, forces);
  }

 private:
  StrutVector ofStruts(const StrutVector& moving, const ForceVector& forces) const;

  StrutMatrix combination_;  // l_i' in row i
  StrutMatrix leak_;         // l_i' rho_j, 0 for j = i
  StrutMatrix estimate_;     // p of kappa-free z''
  Coupling coupling_;
};

/// What of a strut's model is taken off of others: forces of travel and travel rate at an instant. Effects with a
/// memory are left in.
StrutModel withoutMemories(StrutModel model);

}  // namespace suspension_health_monitor
