#pragma once

#include <array>
#include <cstddef>

#include "suspension_health_monitor/internal/identification/running_mean.h"
#include "suspension_health_monitor/internal/signal/stream_timing.h"

namespace suspension_health_monitor {

/// When the readings of a stream were taken if they were taken regularly: the straight line through their stamps, least
/// squares of the newest kMemory readings, by the alpha-beta filter whose gains are theirs, which no stamp moves by
/// more than three usual distances. A line through N stamps is off by 2 / sqrt(N) of what a stamp is. It begins with
/// kFewest readings, whose times are their stamps: either none of them got lost, or their rate is that of the highest
/// peak of the stamps' periodogram, for which it does not matter how many did; whichever makes them the likelier.
///
/// Which period a reading belongs to is the state of a hidden Markov chain (Rabiner, Proc. IEEE 77 (1989), 257-286,
/// forward algorithm): the number of periods that the count is short of. Readings get lost, one or several; seldom
/// is one found not to have been lost. A stamp is off by chance, or, as of a message that waited in a queue, by
/// anything. How often readings get lost and stamps are off by anything is learned. A reading's period is the likeliest
/// one. Cost per reading: O(1), no allocation.
class RegularTimes {
 public:
  RegularTimes() : means_(StreamTiming::kMemory) {}

  /// Takes in the stamp of the next reading [s], later than the one before.
  /// @return the time by the line [s]; earlier than the last one if that was of an earlier period than it seemed.
  double next(double stamp);

  /// A reading is left out.
  void passOver() { expected_ += 1.0; }

  /// The next reading belongs to another series.
  void interrupt() { readings_ = 0; }

  int inRow() const { return in_row_; }                     ///< readings, the newest included, of which none is missing
  double spacing() const { return spacing_; }               ///< by the line [s]
  double variance() const { return means_.mean(kSquare); }  ///< of stamps about the line [s^2]

 private:
  static constexpr double kMemory = 1.0 / (1.0 - StreamTiming::kMemory);  // readings
  static constexpr int kFewest = 256;
  static constexpr int kReach = 16;  // periods that a count may be short of, or have too many
  static constexpr std::size_t kStates = 2 * kReach + 1;

  enum Mean : std::size_t { kSquare, kUsual, kNumMeans };

  /// What is known of a reading's period: by how many the count is short of it.
  struct Count {
    int short_by = 0;
    double astray = 0.0;      // chance that the stamp is off by anything
    double likelihood = 1.0;  // of the stamp [1/period]; of one that leaves no doubt it is not told
  };

  /// A line: its spacing, its time one before the first reading, and the variance of stamps about it [s, s, s^2]; as
  /// good as one through so many readings.
  struct Line {
    double spacing, time, variance;
    int readings;
  };

  double begin(double stamp);
  double startFrom(const Line& line);                  ///< @return ln of the likelihood of the first stamps
  double follow(double stamp, bool tells_likelihood);  ///< @return Count::likelihood
  Line noneLost() const;
  Line likeliestPeriod() const;
  Count count(double off, bool tells_likelihood);
  Count infer(double off);
  void beSureOfCount();
  double usualSquare() const;
  double lossShare() const;
  double astrayShare() const;

  double time_ = 0.0, spacing_ = 0.0;
  int readings_ = 0;                     // that the line rests on
  std::array<double, kFewest> first_{};  // their stamps
  double expected_ = 1.0;                // periods to the next reading, if none gets lost
  int in_row_ = 0, out_of_step_ = 0;
  RunningMeans<kNumMeans> means_;
  std::array<double, kStates> chances_{};                // of the states, after the newest reading
  double losses_ = 0.0, astray_ = 0.0, followed_ = 0.0;  // times that readings got lost; stamps, readings
};

}  // namespace suspension_health_monitor
