#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace suspension_health_monitor {

inline constexpr std::size_t kMostStreams = 3;  ///< of one strut, see Side

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

/// How a grid brings the streams of sensors together.
struct GridOptions {
  Alignment alignment = Alignment::kPaired;
  int fill_samples = 120;  ///< in a row that make one row of the regression; kAuto judges by it
};

}  // namespace suspension_health_monitor
