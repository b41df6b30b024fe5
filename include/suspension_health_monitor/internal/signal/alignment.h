#pragma once

#include <boost/circular_buffer.hpp>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/signal/tuning.h"

namespace suspension_health_monitor {

/// How the readings of several sensors come onto one clock, see StreamGrid.
enum class Alignment {
  kAuto,      ///< paired as long as that does well, then resampled
  kPaired,    ///< readings whose stamps agree within half a sample, as they are
  kResampled  ///< every stream low-pass filtered and interpolated at the same instants, see StreamResampler
};
inline constexpr std::string_view kAlignmentNames = "auto paired resampled";  // in the order of the enumerators

/// @param name  one of kAlignmentNames.
/// @throws std::invalid_argument  on another name.
inline Alignment alignment(std::string_view name) {
  if (name == "auto") return Alignment::kAuto;
  if (name == "paired") return Alignment::kPaired;
  if (name == "resampled") return Alignment::kResampled;
  throw std::invalid_argument("alignment = " + std::string(name) + ", must be one of " + std::string(kAlignmentNames));
}

/// What a stream is to a StreamGrid.
struct StreamOptions {
  /// The streams of one sensor share its stamps, as the six channels of an IMU do. A sensor is still if all of its
  /// streams are: a vehicle that drives straight on turns about no axis.
  std::size_t sensor = 0;
  /// Every instant needs a reading of this stream. The grid waits for the other streams until the readings of the
  /// reference that wait span more than kMostOptionalLag.
  bool required = true;
  /// A force may rest while the vehicle moves, stay at an end of its range, and have any unit: it is not judged by what
  /// accelerations are like.
  bool is_force = false;
};
inline constexpr Stamp kMostOptionalLag = std::chrono::seconds(1);  ///< half of the usual input_timeout

/// The values of all streams of a StreamGrid at one instant.
struct GridInstant {
  Stamp stamp{};
  std::vector<double> values;  ///< by stream
  std::vector<bool> measured;  ///< by stream; false: an optional one without a reading near, whose value is old
};

/// How a grid brings the streams of sensors together.
struct GridOptions {
  Alignment alignment = Alignment::kPaired;
  int fill_samples = 120;  ///< in a row that make one row of the regression; kAuto judges by it
};

/// Watches how well the pairing of readings with those of a reference does, by their stamps alone, so that a replay
/// comes to the same judgement at the same reading. It does badly if, in 200 pairs and lone readings of one stream and
/// the reference (numbers: SignalTuning),
/// - the stamps of partners differ by more than T / 10 on average, or
/// - more than a tenth of the readings find no partner (in a row of more than 3 the rest is a silence of the other
///   sensor and does not count),
/// or if 5 interruptions of the series of instants by less than 4 T come so close together that the integral filter,
/// which needs `fill` samples in a row, would be full less than half of the time: on average fill / ln 2 samples apart,
/// as for interruptions at random. Cost per reading: O(1), no allocation.
class AlignmentJudge {
 public:
  /// @param period  T > 0.  @param fill  samples in a row that fill the integral filter.
  /// @param streams  how many there are, the reference included.
  AlignmentJudge(Stamp period, int fill, std::size_t streams) : period_(period), fill_(fill), outcomes_(streams) {}

  /// There is an instant: every stream has a partner for this reading of the reference.
  void addInstant(Stamp reference);

  /// A reading of the reference and one of the stream were paired.
  void addPair(std::size_t stream, Stamp reference, Stamp partner);

  /// A reading of the stream, or of the reference in the stream, found no partner.
  void addLone(std::size_t stream);

  /// The clock went back.
  void startNewSeries();

  enum class Verdict { kDoesWell, kApart, kLoneReadings, kInterrupted };
  Verdict verdict() const { return verdict_; }

 private:
  struct Outcomes {
    int pairs = 0, lone = 0, lone_in_a_row = 0;
    Stamp apart{};  // sum over the pairs
  };
  void judge(Outcomes& outcomes);

  Stamp period_;
  int fill_;
  Verdict verdict_ = Verdict::kDoesWell;
  std::vector<Outcomes> outcomes_;                                            // by stream
  std::optional<Stamp> last_;                                                 // instant
  boost::circular_buffer<Stamp> interruptions_{kSignalTuning.interruptions};  // the newest
};

}  // namespace suspension_health_monitor
