#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

#include "suspension_health_monitor/internal/identification/recursive_estimators.h"

namespace suspension_health_monitor {

/// Rows psi = Phi theta + e of a whole recording, oldest first.
struct RegressionRows {
  Eigen::MatrixXd regressors;  ///< Phi, (N, p)
  Eigen::VectorXd outputs;     ///< psi, (N)
};

/// @param forgetting_factor  lambda in (0, 1].
/// @return lambda^(N-i), i = 1..N: the newest row weighs 1.
/// @throws std::invalid_argument  naming forgetting_factor, its value and what is allowed.
Eigen::VectorXd forgettingWeights(Eigen::Index num_rows, double forgetting_factor);

/// Weighted least squares, the minimum of sum_i w_i (psi_i - phi_i' theta)^2, Eq. (13)-(14), by a QR factorisation with
/// scaled and pivoted columns: the condition of Phi counts once (not squared, as in (14)), the units not at all.
/// @param weights  w, (N), each >= 0.
/// @return theta, (p); none if the rows do not determine it (fewer rows than parameters, dependent columns up to 1e-12
///         of their length, numbers that are not finite).
/// @throws std::invalid_argument  if the sizes disagree.
std::optional<Eigen::VectorXd> batchLeastSquares(const RegressionRows& rows, const Eigen::VectorXd& weights);

/// The same with the weights of exponential forgetting.
std::optional<Eigen::VectorXd> batchLeastSquares(const RegressionRows& rows, double forgetting_factor = 1.0);

/// When the decrease of the criterion per iteration counts as none.
enum class StoppingRule {
  kAbsolute,  ///< below Delta_min in the unit of the criterion (that of psi), Eq. (23)
  kRelative,  ///< below Delta_min times the criterion: scale-free
};

inline constexpr std::string_view kStoppingRuleNames = "absolute relative";

struct BatchLeastAbsoluteOptions {
  double forgetting_factor = 1.0;  ///< lambda in (0, 1]
  StoppingRule stopping_rule = StoppingRule::kRelative;
  double min_decrease = 1e-9;  ///< Delta_min >= 0, [unit of psi] if absolute, [-] if relative; the paper's is 1e-6
  SmallDivisor small_divisor_rule = SmallDivisor::kRelative;
  double small_divisor = 1e-6;  ///< eps_min >= 0, [unit of psi] if absolute, [-] if relative; the paper's is 1e-8
  int max_iterations = 200;     ///< >= 1

  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  void validate() const;

  /// @return the smallest change of the criterion that counts, when it stands at `criterion` [unit of psi].
  double stoppingThreshold(double criterion) const;
};

struct BatchLeastAbsoluteEstimate {
  Eigen::VectorXd parameters;  ///< theta, (p)
  double criterion = 0.0;      ///< (18) at theta [unit of psi]
  int iterations = 0;          ///< solutions of (22)
  bool converged = false;      ///< stopped by min_decrease, not by max_iterations
};

/// @return max(|residual|, smallestDivisor()).
double boundedDivisor(double residual, SmallDivisor rule, double smallest, double residual_scale);

/// V = sum_i w_i |psi_i - phi_i' theta|, Eq. (18) [unit of psi].
double leastAbsoluteCriterion(const RegressionRows& rows, const Eigen::VectorXd& weights, const Eigen::VectorXd& theta);

/// @return w_i / |psi_i - phi_i' theta| of Eq. (22), (N), small divisors bounded as the options say.
Eigen::VectorXd leastAbsoluteWeights(const RegressionRows& rows, const Eigen::VectorXd& weights,
                                     const Eigen::VectorXd& theta, const BatchLeastAbsoluteOptions& options);

/// Estimation in the sense of the least sum of absolute values, the minimum of (18), by successive weighted least
/// squares (20)-(23) started from LS.
///
/// The threshold on small divisors replaces |e| by a parabola near 0. A step that no longer lowers (18) itself is
/// therefore not taken, and ends the iteration: the criterion never increases. What the threshold costs is at most
/// eps_min / 2 per row, or eps_min / 2 of the criterion with the relative rule.
/// Source: Eq. (18)-(23).
/// Assumes: corrupted rows weigh less than good ones. Beyond that the criterion itself breaks down.
/// @return none where batchLeastSquares() has none.
/// @throws std::invalid_argument  on a wrong option or sizes that disagree.
std::optional<BatchLeastAbsoluteEstimate> batchLeastAbsolute(const RegressionRows& rows,
                                                             const BatchLeastAbsoluteOptions& options = {});

}  // namespace suspension_health_monitor
