#pragma once

#include <Eigen/Core>
#include <optional>

#include "batch_estimators.h"

namespace suspension_health_monitor {

/// theta = (sum w z phi')^-1 sum w z psi, w = lambda^(N-i): consistent although phi and e are correlated, provided that
/// z is correlated with phi and not with e. z = phi is least squares.
/// Source: Soederstroem and Stoica (1981); paper, end of sec. 3.1.
/// @param instruments  z, (N, p), in the order of the rows.
/// @return none if the rows do not determine theta.
/// @throws std::invalid_argument  on a wrong forgetting factor or sizes that disagree.
std::optional<Eigen::VectorXd> batchInstrumentalVariables(const RegressionRows& rows,
                                                          const Eigen::MatrixXd& instruments,
                                                          double forgetting_factor = 1.0);

/// The same in the sense of the least sum of absolute values: w = lambda^(N-i) / |e_i|, repeated as in (20)-(23).
/// A fixed point solves sum lambda^(N-i) z_i sgn(e_i) = 0. It is not the minimum of (18), which may therefore rise on
/// the way; iteration ends when (18) changes by less than min_decrease either way.
std::optional<BatchLeastAbsoluteEstimate> batchInstrumentalLeastAbsolute(const RegressionRows& rows,
                                                                         const Eigen::MatrixXd& instruments,
                                                                         const BatchLeastAbsoluteOptions& options = {});

}  // namespace suspension_health_monitor
