#pragma once

#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

namespace suspension_health_monitor {

/// @return the number as short as it can be told from its neighbours that somebody would write: "0.02", "1e+300".
inline std::string numberText(double value) {
  if (std::isnan(value)) return "nan";  // of either sign
  char text[32];
  std::snprintf(text, sizeof text, "%.15g", value);
  return text;
}

/// @return what somebody else has written, for a message of one line: without control characters, and cut, with its
/// length, if it is longer than any message should be.
inline std::string shortened(std::string text, std::size_t most = 120) {
  const std::size_t length = text.size();
  const bool cut = length > most;
  if (cut) {
    std::size_t end = most / 2;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // no part of a UTF-8 letter
    text.resize(end);
  }
  for (char& letter : text)
    if (static_cast<unsigned char>(letter) < ' ' || letter == '\x7F') letter = ' ';
  return cut ? text + "... (" + std::to_string(length) + " characters)" : text;
}

/// Refuses a number.
/// @param unit  empty: the message has none.  @param wanted  what is allowed: the message ends with it after "must be".
[[noreturn]] inline void refuse(std::string_view name, double value, std::string_view unit, const std::string& wanted) {
  throw std::invalid_argument(std::string(name) + " = " + numberText(value) +
                              (unit.empty() ? "" : " [" + std::string(unit) + ']') + ", must be " + wanted);
}

/// @throws std::invalid_argument  outside the range; NaN is outside of every one.
inline void requireIn(std::string_view name, double value, std::string_view unit, double least, double most) {
  if (!(value >= least && value <= most))
    refuse(name, value, unit, "in [" + numberText(least) + ", " + numberText(most) + ']');
}

/// @throws std::invalid_argument  also if the value is not finite.
inline void requireAboveZero(std::string_view name, double value, std::string_view unit,
                             double most = std::numeric_limits<double>::max()) {
  const bool has_limit = most < std::numeric_limits<double>::max();
  if (!(value > 0.0 && value <= most))
    refuse(name, value, unit, "above 0 and " + (has_limit ? "at most " + numberText(most) : std::string("finite")));
}

}  // namespace suspension_health_monitor
