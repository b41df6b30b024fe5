#pragma once

#include <cstddef>

namespace suspension_health_monitor {

/// The numbers that decide how readings become samples.
struct SignalTuning {
  // Readings that cannot be true: StreamGate.
  int stuck = 20;  ///< equal readings in a row of a dead sensor; fewer occur where the resolution is coarse
  double fewest_for_means = 100.0;  ///< readings that tell mean and spread of a sensor
  int flat_top = 3;                 ///< equal readings in a row at the end of a range; a sine has two
  int flat_tops = 5;                ///< flat tops that are needed near the mean, where heavy clipping has its limit
  double far_out = 1.5;             ///< mean deviations from the mean: as far as the peak of a sine
  double fine = 0.02;       ///< of the span: a band at its end, and the step below which repeated values mean something
  double band_steps = 8.5;  ///< steps of resolution: eight, however their differences are rounded
  /// time in which the median size follows by a factor of e at most: ten times in half a minute [s]
  double fold_time = 13.0;
  /// of the logarithm; then 5/2, 5/3, ..: a first reading of 1e12 is forgotten after 200 more
  double first_step = 5.0;
  double fewest_for_size = 10.0;  ///< readings that tell the median size
  int believed_again = 10;  ///< readings after an absurd one: what stands between absurd ones is as wrong as they are
  /// [m/s^2]; a hundred g is an impact that breaks wheels, bumps into the stops are a few hundred m/s^2
  double most_of_a_vehicle = 1000.0;
  double absurd_over_median = 100.0;  ///< beyond that a reading is absurd, whatever its unit
  double most_in_any_unit = 1e9;      ///< [m/s^2]: that of a vehicle in micro-g

  // When readings were taken: StreamClock, SamplingTest.
  double near = 1.5;          ///< periods that a stamp may be off: one lost reading, and jitter
  int longest_batch = 16;     ///< readings that come at once: a longer spacing is a pause
  double of_one_stamp = 0.6;  ///< share of the evidence for a lost reading that one stamp can give: two are needed
  int other_period = 64;  ///< readings that do not follow by a period, more than those that do: the period is another
  int miscount = 5;       ///< readings that do follow which one that does not outweighs

  // Paired or resampled: AlignmentJudge.
  int outcomes = 200;             ///< pairs and lone readings that are judged together
  int longest_row = 3;            ///< lone readings in a row; more are a silence of the other sensor
  std::size_t interruptions = 5;  ///< of the series of samples that are judged together
  int longest_loss = 4;           ///< periods; a longer interruption is none of the pairing

  // Filters: MotionFilter, StreamResampler.
  /// Bodies move on their struts below this, wheels shake them up to it [Hz]; slower sampling ends it sooner.
  double body_band = 15.0;
  double same_filter = 10.0;  ///< weight of the relation between both filters of a MotionFilter
  /// Of the rate: pass and stop band of a filter of kInterpolationReach samples to either side; those
  /// of a longer one are narrower by as much.
  double widest_flat = 0.24, widest_stop = 0.42;
  double penalty = 4e-6;        ///< lambda of the spline: 0.1 % of what a reading weighs, for the fastest motion
  double longest_bridge = 4.5;  ///< periods: three lost readings in a row, and jitter
  double slowest = 10.0;        ///< [T]; the period of a stream counts as no longer for that
  /// -6 dB [cycles per period of the grid]. Nearly half of the power passes at half the rate of the grid, and what is
  /// folded back makes up for it: white noise stays white.
  double cutoff = 0.516;
  double kaiser = 4.0;  ///< shape of the window: ripple 2e-3
};

inline constexpr SignalTuning kSignalTuning;

}  // namespace suspension_health_monitor
