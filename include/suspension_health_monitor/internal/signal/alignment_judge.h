#pragma once

#include <boost/circular_buffer.hpp>
#include <cstddef>
#include <optional>

#include "suspension_health_monitor/internal/corner_sample.h"

namespace suspension_health_monitor {

/// Watches how well the pairing of readings does, by their stamps alone, so that a replay comes to the same judgement
/// at the same reading. It does badly if, in kOutcomes pairs and lone readings,
/// - the stamps of partners differ by more than kMostOffset T on average, or
/// - more than kMostLone of the readings find no partner (in a row of more than kLongestRow the rest is a silence of
///   the other sensor and does not count),
/// or if kInterruptions interruptions of the series by less than kLongestLoss T come so close together that the
/// integral filter, which needs `fill` samples in a row, would be full less than half of the time: on average
/// fill / ln 2 samples apart, as for interruptions at random.
class AlignmentJudge {
 public:
  static constexpr int kOutcomes = 200;
  static constexpr double kMostOffset = 0.1;
  static constexpr double kMostLone = 0.1;
  static constexpr int kLongestRow = 3;
  static constexpr std::size_t kInterruptions = 5;
  static constexpr int kLongestLoss = 4;

  /// @param period  T > 0.  @param fill  samples in a row that fill the integral filter.
  AlignmentJudge(Stamp period, int fill) : period_(period), fill_(fill) {}

  /// Two readings were paired.
  void addPair(Stamp sprung, Stamp unsprung);

  /// A reading found no partner.
  void addLone();

  /// The clock went back.
  void startNewSeries();

  enum class Verdict { kDoesWell, kApart, kLoneReadings, kInterrupted };
  Verdict verdict() const { return verdict_; }

 private:
  void judgeInterruption(Stamp sprung);
  void judgeOutcomes();

  Stamp period_;
  int fill_;
  Verdict verdict_ = Verdict::kDoesWell;
  int pairs_ = 0, lone_ = 0, lone_in_a_row_ = 0;
  Stamp apart_{};                                                // sum over the pairs
  std::optional<Stamp> last_;                                    // pair
  boost::circular_buffer<Stamp> interruptions_{kInterruptions};  // the newest
};

}  // namespace suspension_health_monitor
