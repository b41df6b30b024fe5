#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "suspension_health_monitor/internal/simulation/road.h"
#include "suspension_health_monitor/internal/simulation/vehicle.h"

namespace suspension_health_monitor {

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
  [[noreturn]] void giveUp(const char* why, double t) const;

  Vehicle vehicle_;
  std::vector<Road> roads_;
  std::vector<RoadPoint> ground_;  // that roads_ have now
  std::vector<Signal> known_forces_;
  std::vector<double> own_mobility_;  // a_ii [1/kg]
  Eigen::Vector3d inverse_inertia_;   // 1/M, 1/Iyy, 1/Ixx; 0 where the body does not turn
  double longest_step_;               // [s]
  double sampled_step_;               // likewise, if samples are no closer [s]
  std::uint64_t evaluations_ = 0;     // of the equations
  State state_, derivative_;
  VehicleTruth truth_;
  double time_ = 0.0;
};

}  // namespace suspension_health_monitor
