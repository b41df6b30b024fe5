#pragma once

namespace suspension_health_monitor {

/// The numbers that decide in the block estimator.
struct BlockTuning {
  double length = 2.0;  ///< T of the first blocks [s]; then it follows the bounce by factors of two
  /// relative standard deviation of b1 and b0 that needs no more blocks [-]: 0.15, the change that warns, over 4, the
  /// standard deviations that prove it
  double enough = 0.0375;
  double gain_stddev = 0.1;  ///< prior of the difference of both sensors' gains: 0.8 to 1.25 are within 2.5 of it [-]
  double delay_stddev = 0.005;  ///< prior of the clocks' difference [s]
  double usable = 0.35;         ///< of the rate: the anti-alias filters of two IMUs differ beyond
  /// Share of the power of the body from which a delay or a gain is that of a sensor: a law with memory, and whatever
  /// is missing, looks like one, but leaves more unexplained: 4 % and more on measured and simulated records.
  double nearly_all = 0.97;
  /// delay between two clocks that is one [s]: twice what the phase of links and rubber looks like
  double least_delay = 0.0025;
  /// of a delay of a vehicle, in the last bin [rad]: links, rubber and the side forces of tyres turn the phase of its
  /// struts as a delay does, by up to 0.07 rad at 20 Hz on recorded multibody vehicles. What a delay then takes from
  /// b0 at high frequencies is as much as 17 % of it.
  double least_phase = 0.15;
  /// damping ratio below which a damper is as good as none [-]; that of a healthy strut is 0.2 to 0.5
  double least_damping = 0.1;
  double least_share = 0.02;   ///< of r and of 1 - r: at 0 and 1 the instruments know no noise of one sensor
  double share_mean = 0.5;     ///< of r: uniform in (0, 1)
  double share_stddev = 0.29;  ///< likewise: 1 / sqrt(12)
  /// of a block: a gap costs as much of its information, and the rule across it is noise that is measured
  double longest_spacing = 1.0 / 32.0;
  int most_lost = 3;          ///< readings in a row that are interpolated: as many as the grid of LS and LA bridges
  int spacings_of_mean = 32;  ///< spacings, whose mean is taken: one that is lost moves it by no more than a thirtieth
  double full = 10.0;         ///< times the median power, up to which a block counts in full
  int weightings = 3;         ///< of the blocks; and with each of them of the noise and parameters
  double least_friction = 0.002;  ///< of the rms of the wheel: then the direction is that of the rate, nearly
  /// power of the body over that of its wheel: 1 + 1 / (4 zeta^2) of a strut with zeta = 0.115
  double most_amplified = 20.0;
  double excess = 1.5;  ///< power that a fit leaves of a block, over the median: that of its 39 bins varies by a sixth
  double lost = 0.3;    ///< relative standard deviation from which there is no estimate to linearise at
  double says_nothing = 0.5;  ///< relative standard deviation of blocks that say nothing of the strut
  double held = 1e-9;        ///< standard deviation of a delay [s] or gain that is held at none, also without any noise
  double stale = 0.02;       ///< relative change of b1 or b0 since the linearisation
  double stale_phase = 0.1;  ///< likewise of the phase that the delay makes in the last bin [rad]
  double stale_share = 0.2;  ///< likewise of r
  int slow_every = 4;  ///< blocks, between fits of what changes slowly: all blocks then have changed by a sixteenth
  double slow_factor = 1.5;     ///< by which the standard deviations of what changes slowly grow for fewer blocks
  int start_blocks = 8;         ///< that one reading has time to linearise
  int start_steps = 8;          ///< of a fit, that one reading has time for
  int vehicle_start_steps = 3;  ///< likewise of a vehicle; the blocks after it go on
};

inline constexpr BlockTuning kBlockTuning;

}  // namespace suspension_health_monitor
