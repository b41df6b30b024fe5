#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/simulation/road.h"
#include "suspension_health_monitor/internal/simulation/vehicle.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// Ends an integration that leads nowhere, in words that name the hidden effects: one that runs away, or one that needs
/// steps so small that it would not come to an end.
class IntegrationGuard {
 public:
  static constexpr double kTolerance = 1e-10;  ///< per step of an integration, absolute [m, m/s] and relative

  /// @param hidden  effects of the strut, to be named.
  /// @param step  longest step that the strut without them lets the integration make [s].
  IntegrationGuard(const std::vector<ActiveEffect>& hidden, double step);

  /// Counts one evaluation of the equations of motion at time t [s].
  /// @throws std::invalid_argument  if there are more than kMostPerStep for each longest step that fits into 0 .. t.
  void countEvaluation(double t) {
    if (static_cast<double>(++evaluations_) > kGrace + kMostPerStep * t / step_) refuseStiffness(t);
  }

  /// @param position, rate  of body or wheel at time t [m], [m/s].
  /// @throws std::invalid_argument  if one of them is not finite, or beyond kFar.
  void checkMotion(double position, double rate, double t) const {
    if (!(position > -kFar && position < kFar && rate > -kFar && rate < kFar)) refuseMotion(t);
  }

 private:
  static constexpr double kGrace = 1e6;        // evaluations: a tenth of a second's work
  static constexpr double kMostPerStep = 1e4;  // evaluations
  static constexpr double kFar = 1e4;          // [m], [m/s]

  [[noreturn]] void refuseStiffness(double t) const;
  [[noreturn]] void refuseMotion(double t) const;

  std::string hidden_;  // in words; empty: none
  double step_;
  std::uint64_t evaluations_ = 0;
};

/// What the simulator knows and no sensor tells, at one instant.
struct DriveTruth {
  double damping_to_mass = 0.0;        ///< b1 [1/s]
  double stiffness_to_mass = 0.0;      ///< b0 [1/s^2]
  double travel = 0.0;                 ///< d = w - z [m], compression positive
  double travel_rate = 0.0;            ///< v = w' - z' [m/s]
  double road_height = 0.0;            ///< mu [m]
  double sprung_acceleration = 0.0;    ///< z'' without noise [m/s^2]
  double unsprung_acceleration = 0.0;  ///< w'' without noise [m/s^2]
  double road_acceleration = 0.0;      ///< mu'' without noise [m/s^2]
};

/// What the simulator knows of a vehicle at one instant.
struct VehicleTruth {
  /// Heave of the centre of gravity [m], pitch about y (nose down positive) and roll about x (left side up positive)
  /// [rad]; their rates and accelerations.
  Eigen::Vector3d body = Eigen::Vector3d::Zero(), body_rate = body, body_acceleration = body;

  std::vector<DriveTruth> struts;    ///< b1 and b0 are the strut's own, a_ii c_i and a_ii k_i
  std::vector<double> forces;        ///< of the struts on the body, anti-roll bars included, up positive [N]
  std::vector<double> known_forces;  ///< up positive [N]
};

/// The equations of motion of a vehicle, and their integration in time.
///
///   M z'' = sum F_i + sum G_k,  Iyy pitch'' = -sum x F,  Ixx roll'' = sum y F
///   m_i w_i'' = -F_i + k_ti (mu_i - w_i) + c_ti (mu_i' - w_i')
///   F_i = c_i(t) v_i + k_i(t) d_i + 1/a_ii (stops(d_i) + sum_j c_j f_j(d_i, v_i, t, s_j)) + anti-roll bars
///
/// with the strut's top at z_i = z - x_i pitch + y_i roll; a rigid wheel moves as the road does. The wheels start at
/// rest relative to the road, and the body in the plane that is nearest to them. Integration: Dormand-Prince 5(4) with
/// error control, 1e-10 absolute (m, m/s) and relative per step; steps are at most 1/10 of the fastest time constant,
/// stops included, so that none jumps over a contact. Its formulas are its own: estimation shares no code with it but
/// the signs.
class VehicleMotion {
 public:
  using State = std::vector<double>;
  using Signal = std::function<double(double t)>;

  /// @param roads  under every wheel.  @param known_forces  one per vehicle.known_forces [N].
  /// @param between_samples  time from one advance() to the next [s].
  /// @throws std::invalid_argument  as validate().
  VehicleMotion(const Vehicle& vehicle, std::vector<Road> roads, double between_samples,
                std::vector<Signal> known_forces = {});

  /// Integrates up to t [s]; nothing is done where that is not after the last one.
  /// @throws std::invalid_argument  naming the hidden effects, if a strut runs away or is too stiff to be integrated.
  void advance(double t);

  /// @return what is so at the time that advance() has reached.
  const VehicleTruth& truth();

  /// Heave, pitch, roll; their rates; the wheels' heights; their rates; the memories of hidden effects. For tests.
  State& state() { return state_; }

 private:
  void evaluate(const State& state, double t, State& derivative);
  void findForces(const State& state, double t);
  void accelerateBody(double t);
  void accelerateWheels(const State& state, double t, State& derivative);

  Vehicle vehicle_;
  std::vector<Road> roads_;
  std::vector<RoadPoint> ground_;  // that roads_ have now
  std::vector<Signal> known_forces_;
  std::vector<double> own_mobility_;  // a_ii [1/kg]
  Eigen::Vector3d inverse_inertia_;   // 1/M, 1/Iyy, 1/Ixx; 0 where the body does not turn
  double longest_step_;               // [s]
  State state_, derivative_;
  VehicleTruth truth_;
  IntegrationGuard guard_;
  double time_ = 0.0;
};

}  // namespace suspension_health_monitor
