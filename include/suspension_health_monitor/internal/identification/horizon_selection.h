#pragma once

namespace suspension_health_monitor {

/// |G(j omega)| of the strut (27) from wheel to body (positions or accelerations alike),
///   G(s) = (b1 s + b0) / (s^2 + b1 s + b0).
/// @param damping_to_mass  b1 > 0 [1/s].  @param stiffness_to_mass  b0 > 0 [1/s^2].  @param frequency_hz  >= 0.
double transmissibility(double damping_to_mass, double stiffness_to_mass, double frequency_hz);

/// White noise on w'' through G beside noise on z'': 1 + r T (b1^2 + b0) / (2 b1).
/// @param period  T [s].  @param wheel_to_body  r, the variance of the noise on w'' over that on z''.  @return variance
/// of both together over that of the noise on z''.
double noiseOfBothSensors(double damping_to_mass, double stiffness_to_mass, double period, double wheel_to_body = 1.0);

/// |I_0^2| / h^2 = sinc^2(omega h / 2) of the strut's integral filter (8), 1 at frequency 0, 0 at 1/h.
/// @param horizon  h > 0 [s].
double integralFilterMagnitude(double horizon, double frequency_hz);

/// @param damping_to_mass  b1 > 0 [1/s].  @param stiffness_to_mass  b0 > 0 [1/s^2].
/// @return the frequency above its resonance where the strut is 3 dB below its maximum [rad/s].
/// @throws std::invalid_argument  naming the parameter, its value and what is allowed.
double bandwidth(double damping_to_mass, double stiffness_to_mass);

/// Proposes the horizon from rough parameters: system and filter shall have the same 3 dB bandwidth, each measured from
/// its own maximum. Then h sqrt(b0) is 1.8 for a weakly, 1.55 for a usually and 1.0 for a critically damped strut.
///
/// The source asks for a match of the magnitude responses; how to measure it was decided by simulation, doc/horizon.md.
/// The minimum of the error is flat: 20 % more or less horizon changes little.
/// Source: Sagara and Zhao (1990); paper, end of sec. 2.2.
/// Time scaled by s (b1 / s, b0 / s^2) scales the proposal by s.
/// @return h [s].  @throws std::invalid_argument  as bandwidth().
double proposeHorizon(double damping_to_mass, double stiffness_to_mass);

/// @param horizon  h > 0 [s].  @param period  T > 0 [s].
/// @return the L nearest to h / T, at least 1.
/// @throws std::invalid_argument  naming horizon or sample_period, the value and what is allowed.
int horizonSamples(double horizon, double period);

}  // namespace suspension_health_monitor
