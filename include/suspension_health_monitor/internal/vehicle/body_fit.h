#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/vehicle/top_rows.h"

namespace suspension_health_monitor {

/// Why the rows of the struts do not tell how the body's mass is spread.
enum class InertiaDoubt {
  kNone,
  kNoPositions,  ///< it is not known where every strut stands
  kOnOneLine,    ///< fewer than three struts, or all on one line: they do not see the body turn about it
  kUncertain,    ///< the rows are too uncertain, or do not fit the positions
};

/// How a rigid body's mass is spread.
struct BodyInertia {
  Measured mass_to_pitch_inertia;  ///< M/Iyy [1/m^2]
  Measured mass_to_roll_inertia;   ///< M/Ixx [1/m^2]
  Measured x, y;                   ///< of the centre of gravity, from where positions count [m]
};

struct BodyInertiaResult {
  std::optional<BodyInertia> body;
  InertiaDoubt doubt = InertiaDoubt::kNone;
};

/// By strut x ahead and y to the left of the strut's top, from any one point of the body [m].
using StrutPlaces = std::vector<std::array<double, 2>>;

/// Two struts that an anti-roll bar may join.
using StrutPair = std::pair<std::size_t, std::size_t>;

/// @return struts side by side: as far ahead as one another, to a tenth of the wheelbase, on both sides of the middle.
std::vector<StrutPair> pairsOf(const StrutPlaces& places);

/// A rigid body on struts, as far as its rows tell.
struct BodyFitResult {
  enum class Bars { kNone, kStiffness, kStiffnessAndDamping };
  struct Bar {
    StrutPair struts;
    /// a_ii times the bar's, over the body's mass at the first and at the second strut [1/s^2], [1/s].
    std::array<Measured, 2> stiffness, damping;
  };

  double phi = 0.0;              ///< error of the model per coefficient, over the largest of its kind in its row [-]
  Bars bars = Bars::kNone;       ///< that are named
  std::vector<Bar> found;        ///< these
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
BodyInertiaResult inertiaOf(const std::optional<BodyFitResult>& fit, const StrutPlaces& places);

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
class BodyFit {
 public:
  /// @param places  by strut, from any point of the body; empty: not known. Then forces at any two tops move one
  /// another alike, no more.
  BodyFit(std::size_t struts, const StrutPlaces& places);

  /// @param halves  rows of two sets of blocks that share no reading, by which bars must agree; empty: no bar is named.
  /// @return nothing if the solver fails.
  std::optional<BodyFitResult> fit(const BodyRows& rows, const std::vector<BodyRows>& halves = {}) const;

 private:
  struct Solution {
    BodyFitResult::Bars bars;
    double phi;
    Eigen::VectorXd parameters;  ///< as RigidBody has them
    Eigen::MatrixXd covariance;
    double chi2 = 0.0;
  };

  std::optional<Solution> solve(const BodyRows& rows, BodyFitResult::Bars bars, double phi,
                                const Eigen::VectorXd& start) const;
  std::optional<Solution> solve(const BodyRows& rows, BodyFitResult::Bars bars) const;
  bool hasNegativeBar(const Solution& solution) const;
  bool isVehicle(const Eigen::Vector4d& inertia) const;
  bool isNamed(const Solution& without, const Solution& with, const std::vector<BodyRows>& halves) const;
  /// @return M/Iyy, M/Ixx, x and y of the centre of gravity.
  Eigen::Vector4d inertia(const Eigen::MatrixXd& s) const;
  BodyFitResult describe(const Solution& solution) const;

  Eigen::MatrixXd q_;                                                                   // struts by motions, scaled
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero(), scale_ = Eigen::Vector2d::Ones();  // of x, y
  bool sees_pitch_ = false, sees_roll_ = false;
  std::vector<StrutPair> pairs_;  // that a bar may join
};

}  // namespace suspension_health_monitor
