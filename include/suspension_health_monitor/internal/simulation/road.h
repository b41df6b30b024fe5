#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace suspension_health_monitor {

/// The road under the wheel at one instant, and how it changes as the wheel rolls on.
struct RoadPoint {
  double height = 0.0;        ///< mu [m], up positive
  double rate = 0.0;          ///< mu' [m/s]
  double acceleration = 0.0;  ///< mu'' [m/s^2]
};

RoadPoint operator+(const RoadPoint& a, const RoadPoint& b);

/// The road as the wheel meets it, by time t [s] since the start of the drive. The derivatives belong to the height.
/// A road may keep a cache: use one copy per thread.
using Road = std::function<RoadPoint(double t)>;

/// Paper, equation (31): mu = sum G_i (1 - cos(2 pi t / T_i)), G = 1, 2, 3, 4 cm, T = 1.3, 1.9, 2.5, 2.8 s.
/// The T_i are periods; at t = 0 height and rate are 0.
RoadPoint paperRoad(double t);

/// Paper, equation (32): delta = sum H exp(-alpha (t - tau_i)^2), H = 15 cm, alpha = 22.2 1/s^2, tau = 85 s and 110 s.
RoadPoint paperBumps(double t);

/// ISO 8608:2016 gives roads by the power spectral density of their height over spatial frequency n,
///   Gd(n) = Gd(n0) (n / n0)^-2,   n0 = 0.1 cycles/m,
/// and sets the classes A (smooth) to H by the geometric means Gd(n0) = 16e-6 * 4^k m^3, k = 0..7.
/// @param road_class  'A'..'H'.
/// @param spatial_frequency  n > 0 [cycles/m].
/// @return one-sided Gd(n) [m^3].
/// @throws std::invalid_argument  on another letter.
double isoDisplacementDensity(char road_class, double spatial_frequency);

/// A random road of one ISO 8608 class, driven over at constant speed.
///
/// Height is a sum of kComponents sinusoids with random phases. The band [kLowest, kHighest] is cut into as many
/// intervals of equal width in log n; each holds one sinusoid at a random place in it that carries the interval's whole
/// variance, integral Gd(n) dn. The frequencies have no common multiple, so the profile does not repeat.
/// Between the points of a grid (kPointsPerWave to the shortest wave, exact values there) height is a quintic that
/// meets height, rate and acceleration at both ends; rate and acceleration are its derivatives, so the three always
/// agree.
///
/// Lines of the same surface belong together as on an isotropic one (Dodds and Robson, "The description of road surface
/// roughness", J. Sound Vib. 31, 1973): its two-sided density over both wave numbers depends on their length alone, and
/// Gd ~ n^-2 along a line comes from S(n, m) ~ (n^2 + m^2)^(-3/2). So a wave that goes as n along the line goes across
/// it as m, of density n^2 / (2 (n^2 + m^2)^(3/2)), which m = n s / sqrt(1 - s^2) has, s uniform in (-1, 1). Lines at
/// the distance b then have the same spectrum, and of the cross spectrum the share
///   E cos(2 pi m b) = x K_1(x),  x = 2 pi n b.
///
/// Error of the acceleration: at most (2 pi / kPointsPerWave)^4 / 1920 = 5.1e-6 of the shortest sinusoid's, and
/// as n^4 less for longer ones. Cost: kPointsPerWave * kComponents phasor steps to the shortest wave, in blocks as time
/// goes on; memory is constant.
class IsoRoad {
 public:
  static constexpr double kLowest = 0.011;  ///< [cycles/m], the range of ISO 8608's straight-line fit
  static constexpr double kHighest = 2.83;  ///< [cycles/m]
  static constexpr int kComponents = 512;
  static constexpr int kPointsPerWave = 20;

  /// @param road_class  'A'..'H'.
  /// @param speed  > 0 [m/s].
  /// @param seed  same seed, same profile over distance, whatever class (up to scale) and speed.
  /// @param lateral  where the wheel's line lies on the surface [m].
  /// @param surface  another number, another surface with the same statistics.
  /// @throws std::invalid_argument  on another letter or speed.
  IsoRoad(char road_class, double speed, int seed, double lateral = 0.0, unsigned surface = 0);

  /// @param t  [s], any time; quick when times are near the last one.
  RoadPoint operator()(double t);

 private:
  void tabulate(long block);

  Eigen::VectorXd amplitude_;  // [m], one entry per component, as below
  Eigen::VectorXd omega_;      // [rad/s]
  Eigen::VectorXd phase_;      // [rad]
  Eigen::VectorXd cosine_step_, sine_step_;
  double grid_step_;           // [s]
  std::optional<long> block_;  // number of the one in the table
  std::vector<RoadPoint> table_;
};

}  // namespace suspension_health_monitor
