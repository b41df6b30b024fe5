#pragma once

#include <Eigen/Core>
#include <vector>

#include "suspension_health_monitor/internal/blocks/block_bins.h"

namespace suspension_health_monitor {

/// Vectors and matrices over parameters, without the heap.
inline constexpr int kMostBlockParameters = 40;
using BlockVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostBlockParameters, 1>;
using BlockMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostBlockParameters, kMostBlockParameters>;

/// Parameters of a strut's block equations; those of the columns follow.
enum BlockParameter : int {
  kBlockDamping,     ///< b1 [1/s]
  kBlockStiffness,   ///< b0 [1/s^2]
  kBlockDelay,       ///< tau by which the wheel's readings are stamped late [s]
  kBlockWheelShare,  ///< r: the wheel sensor's share of what is unexplained [-], in (0, 1)
  kBlockGain,        ///< gamma: the gain of the body's sensor over that of the wheel's is 1 + gamma [-]
  kNumBlockParameters
};

/// How many columns the equations of one strut top have beside b1, b0, tau, r and gamma.
struct BlockColumns {
  int forces = 1;  ///< known shapes of a force over the body's mass, on the wheel's stamps: dry friction, or effects
  int neighbours = 0;         ///< travel rates and travels of the other struts of the body
  bool has_friction = false;  ///< the first force is dry friction

  int numParameters() const { return kNumBlockParameters + forces + neighbours; }
  int firstForce() const { return kNumBlockParameters; }
  int firstNeighbour() const { return kNumBlockParameters + forces; }
};

/// One block of one strut top: its spectra, and its equations linearised at `at`.
struct StrutBlock {
  double end = 0.0;                       ///< time at which it ends [s]
  Eigen::ArrayXcd wheel;                  ///< integrals of w'', bins first - 1 .. last + 1
  Eigen::ArrayXXcd forces;                ///< those of the force columns
  Eigen::ArrayXXcd body;                  ///< H_0, H_1, H_2 of z'' at the strut's top, bins first .. last
  Eigen::ArrayXXcd neighbours;            ///< H_1, H_0 of the others' w'' - z''
  Eigen::ArrayXXcd predicted_neighbours;  ///< the same as the model has them, driven by the wheels
  Eigen::ArrayXcd predicted_travel;       ///< H_0 of the own w'' - z'' likewise; empty: a strut alone

  /// Sums over the bins of one band, Re(a* b) of complex columns: Z instruments, R regressors, both at theta = at, and
  /// c = e + R at (but for r) what is left of the residual e at theta = 0. So blocks add up, whatever they were
  /// linearised at: e = c - R theta.
  struct Band {
    Eigen::MatrixXd information;  ///< Z'R
    Eigen::MatrixXd instruments;  ///< Z'Z
    Eigen::VectorXd score;        ///< Z'c
    Eigen::VectorXd share;        ///< Z'R of r, times r
    Eigen::MatrixXd moments;      ///< R'R with c as the last column
    /// |W^|^2, |H_0(Y)|^2, |H_0(X)|^2, |H_1(X - Y)|^2 / |s|^4, |H_0(X - Y)|^2 / |s|^4.
    enum Power { kWheel, kBody, kMoving, kRate, kTravel, kNumPowers };
    using Powers = Eigen::Array<double, kNumPowers, 1>;
    Powers powers;

    explicit Band(Eigen::Index parameters);
    void setZero();
    void add(double weight, const Band& other);
  };
  BlockVector at;
  std::vector<Band> bands;
  long version = 0;  ///< of the linearisation: no two of an estimator are alike
};

/// The equations of a strut top in the bins of one block. With y = z'', x = (1 + gamma) w'' (delayed by tau), s =
/// j w_k,
///     H_2(y) = b1 H_1(x - y) + b0 H_0(x - y) + sum c_m H_2(f_m) + sum of neighbours' columns
/// holds exactly in every bin, whatever the initial states. With A = s^2 + b1 s + b0, g = b1 s + b0 and G = g / A the
/// residual counts as an output's, e = (left - right) / A. A share r of its power is the wheel sensor's, so that
///     W^ = H_0(x) + rho e / G,  rho = r |g|^2 / (r |g|^2 + (1 - r) |A|^2)
/// is the wheel's motion without the part that is in e: the instruments Z are the derivatives of G W^, the regressors R
/// those of -e. Source: R. Pintelon, J. Schoukens, System Identification: A Frequency Domain Approach, 2012, ch. 9
/// (errors in variables, known noise structure).
class StrutEquations {
 public:
  StrutEquations(const BlockBand& band, const BlockColumns& columns);

  /// @return a block of the right shape, to be filled.
  StrutBlock makeBlock() const;

  /// Computes the sums of a block's bands at theta. Cost: O(bins * parameters^2), no allocation.
  void linearise(const BlockVector& theta, StrutBlock& block);

  /// @return a start: b1, b0, the neighbours' columns and, if it is asked for, gamma of weighted least squares over
  /// blocks; all else 0.
  BlockVector start(const std::vector<const StrutBlock*>& blocks, bool with_gain = false);

  const BlockBand& band() const { return band_; }
  const NoiseBands& noiseBands() const { return noise_bands_; }
  const BlockColumns& columns() const { return columns_; }
  const Modulation& undelayed() const { return undelayed_; }

 private:
  void sumBands(StrutBlock& block) const;

  BlockBand band_;
  NoiseBands noise_bands_;
  BlockColumns columns_;
  Modulation undelayed_, delayed_;
  long versions_ = 0;
  Eigen::ArrayXcd s_;
  Eigen::ArrayXcd a_, g_, gain_, wheel_, e_over_g_;
  Eigen::ArrayXXcd x_;  // H_0, H_1, H_2 of x
  Eigen::ArrayXd rho_, rho_slope_;
  Eigen::MatrixXcd instruments_, regressors_;  // bins by parameters; the residual is the regressors' last column
};

}  // namespace suspension_health_monitor
