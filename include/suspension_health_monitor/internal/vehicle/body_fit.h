#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// What the rows of all tops say: how much the travel rate and the travel of every strut, and every known force, moves
/// every top, and how sure that is:
///     z_i'' = sum_j (b1_ij d_j' + b0_ij d_j) + sum_k c_ik f_k,  d_j = w_j - z_j.
struct BodyRows {
  Eigen::MatrixXd rate, travel;             ///< b1_ij [1/s], b0_ij [1/s^2], tops by struts
  Eigen::MatrixXd force;                    ///< c_ik [m/s^2 per unit of the force], tops by known forces
  Eigen::MatrixXd force_stddev;             ///< of c_ik; like the covariance empty in a model
  std::vector<Eigen::MatrixXd> covariance;  ///< by top that of its rates, then its travels
  bool is_by_body = false;  ///< one IMU of the body tells of all tops: no more rows are independent than it has motions

  Eigen::Index size() const { return rate.rows(); }

  /// @return rho_ij, the share of what strut j does to its own top that it does to top i: the mean of b1_ij / b1_jj and
  /// b0_ij / b0_jj, weighted by their variances. Of a rigid body without anti-roll bars it is a_ij / a_jj.
  Measured ratio(Eigen::Index i, Eigen::Index j) const;
  /// @return true if every ratio is known well enough to take the other struts out.
  bool areKnown() const;
  /// @return the linear struts.
  std::vector<StrutModel> models() const {
    std::vector<StrutModel> models;
    for (Eigen::Index i = 0; i < size(); ++i) models.push_back({rate(i, i), travel(i, i), {}, {}});
    return models;
  }
};

/// Why the rows of the struts do not tell how the body's mass is spread.
enum class InertiaDoubt {
  kNone,
  kNoPositions,  ///< it is not known where every strut stands
  kOnOneLine,    ///< fewer than three struts, or all on one line: they do not see the body turn about it
  kUncertain,    ///< the rows are too uncertain, or do not fit the positions
};

/// How a rigid body's mass is spread.
struct BodyInertia {
  InertiaDoubt doubt = InertiaDoubt::kUncertain;  ///< kNone: what follows is known
  Measured mass_to_pitch_inertia{};               ///< M/Iyy [1/m^2]
  Measured mass_to_roll_inertia{};                ///< M/Ixx [1/m^2]
  Measured x{}, y{};                              ///< of the centre of gravity, from where positions count [m]
};

/// By strut x ahead and y to the left of the strut's top, from any one point of the body [m].
using StrutPlaces = std::vector<std::array<double, 2>>;

/// Two struts that an anti-roll bar may join.
using StrutPair = std::pair<std::size_t, std::size_t>;

/// @return struts side by side: as far ahead as one another, to a tenth of the wheelbase, on both sides of the middle.
std::vector<StrutPair> pairsOf(const StrutPlaces& places);

/// A rigid body on struts, as far as its rows tell.
struct BodyFitResult {
  struct Bar {
    StrutPair struts;
    /// a_ii times the bar's, over the body's mass at the first and at the second strut [1/s^2], [1/s].
    std::array<Measured, 2> stiffness, damping;
  };

  double phi = 0.0;              ///< error of the model per coefficient, over the largest of its kind in its row [-]
  std::vector<Bar> found;        ///< that are named
  std::vector<Measured> b1, b0;  ///< by strut, its own column at its own top with its share of bars [1/s], [1/s^2]

  /// @param own  b1, b0 of a strut's estimate.
  /// @param friction_damping  what friction counts as in b1, TopEstimate::frictionDamping(): a damper that is not
  /// linear looks like friction, in part or as a whole.
  /// @return the variances that the model's error adds to those of b1 and b0 as absolute values, as far as the rows of
  /// all tops leave it in the strut's own column. A change has none of it.
  Eigen::Array2d modelVariances(std::size_t strut, const Eigen::Vector2d& own, double friction_damping) const;

  Eigen::MatrixXd rate, travel;  ///< the rows that the body has, tops by struts [1/s], [1/s^2]

  /// @return the rows by all that is known: the mean of each coefficient and that of the body, whose error is phi,
  /// weighted by their variances.
  BodyRows combined(const BodyRows& rows) const;

  BodyInertia inertia{};  ///< infinite stddev: not seen
};

/// @param fit  of the rows of all struts; nothing: not known.  @param places  by strut; empty: not known.
BodyInertia inertiaOf(const std::optional<BodyFitResult>& fit, const StrutPlaces& places);

/// Minimum-distance fit of a rigid body on linear struts and anti-roll bars to the rows of its tops, (B23) in
/// doc/equations.md:
///     B1 = Q S Q' (diag(c) + sum of c_p L_p),  B0 = Q S Q' (diag(k) + sum of k_p L_p),
/// where row i of Q is (1, x_i, y_i), S (symmetric, S_11 = 1) is what the body's mass and inertia make of a force, c
/// and k are over its mass, and L_p is the difference that a bar resists. Rows have noise, and a model error of phi
/// times the largest coefficient of their kind: links, side forces of tyres and laws that are not linear are not in the
/// model, and neither blocks nor bands disagree about them, but no rigid body has such rows. phi is what makes chi2
/// equal to its degrees of freedom. Sources: minimum distance: G. Chamberlain, Panel data, Handbook of Econometrics 2
/// (1984), 3.; a common error that chi2 tells: R. T. Birge, The calculation of errors by the method of least squares
/// (1932).
/// @param places  by strut, from any point of the body; empty: not known. Then forces at any two tops move one another
/// alike, no more.
/// @param halves  rows of two sets of blocks that share no reading, by which bars must agree; empty: no bar is named.
/// @return nothing if the solver fails.
std::optional<BodyFitResult> fitRigidBody(const BodyRows& rows, const StrutPlaces& places,
                                          const std::vector<BodyRows>& halves = {});

}  // namespace suspension_health_monitor
