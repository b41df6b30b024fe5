#pragma once

#include <cmath>
#include <cstdio>
#include <string>

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

}  // namespace suspension_health_monitor
