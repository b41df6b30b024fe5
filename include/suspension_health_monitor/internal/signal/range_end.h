#pragma once

#include <optional>

namespace suspension_health_monitor {

/// What a sensor's readings are like as a rule.
struct UsualReadings {
  double mean = 0.0, deviation = 0.0;  ///< deviation: mean distance from the mean
  double finest_step = 0.0;            ///< smallest step other than 0 from one reading to the next
  double span = 0.0;                   ///< highest less lowest
  double repeated = 0.0;               ///< share of readings that equal the one before, in [0, 1]
  bool known = false;                  ///< from enough readings
};

/// The upper or the lower end of what one sensor has read: do its readings stop there because its range does?
///
/// Signs of a range that ends: flat tops, kFlatTop equal readings in a row or more, at the very extreme; and more
/// readings at the extreme than within a narrow band below it. Of a signal that turns by itself the band holds more,
/// however coarsely it is quantised: a parabola stays in the kBandSteps steps of resolution below its top
/// sqrt(1 + kBandSteps) - 1 times as long as in the top one. Far from the mean one flat top is enough; near it, where
/// heavy clipping has its limit, kAgain are, since a sensor may be stuck anywhere. One flat top that lasts is no limit
/// but a sensor that is stuck. A sensor that repeats its readings must show tops that are flat for it.
/// Cost per reading: O(1), no allocation.
class RangeEnd {
 public:
  static constexpr int kStuck = 20;  ///< equal readings in a row; fewer occur where the resolution is coarse

  /// @param sign  1: the upper end, -1: the lower one.
  explicit RangeEnd(double sign) : sign_(sign) {}

  /// Takes in the next reading.
  /// @param equal_in_a_row  readings of this value without a break, this one included.
  /// @param usual  of the readings so far, this one included.
  void add(double reading, int equal_in_a_row, const UsualReadings& usual);

  /// @return the farthest reading so far; none before the first one.
  const std::optional<double>& extreme() const { return extreme_; }

  /// @return where the range ends, as long as no reading goes beyond.
  const std::optional<double>& limit() const { return limit_; }

 private:
  static constexpr int kFlatTop = 3;
  static constexpr int kAgain = 5;

  void count(double reading, double band);
  void countFlatTops(double reading, int equal_in_a_row, double repeated);

  double sign_;
  std::optional<double> extreme_, limit_;
  double at_ = 0.0, near_ = 0.0;  // readings at the extreme; within the band below
  int flat_tops_ = 0;             // counts up to kAgain
  bool in_flat_top_ = false;
};

}  // namespace suspension_health_monitor
