#include <algorithm>
#include <array>
#include <cmath>

#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

constexpr int kDigits = 3;
constexpr int kSmallest = -4;  // thousands: pico
constexpr std::array kPrefixes{"p", "n", "u", "m", "", "k", "M", "G", "T"};

/// @return digits before the point, 0 or less for numbers below 1.
int digitsBefore(double size) {
  return size > 0.0 && std::isfinite(size) ? static_cast<int>(std::floor(std::log10(size))) + 1 : 1;
}

}  // namespace

ReadableUnit::ReadableUnit(double typical, const std::string& unit) : ReadableUnit(typical, typical, unit) {}

ReadableUnit ReadableUnit::plain(double typical, const std::string& unit) {
  const double size = std::abs(typical);
  return {typical, size >= 0.01 && size < 1e5 ? 1.0 : typical, unit};
}

/// @param prefixed  what the prefix is chosen by.
ReadableUnit::ReadableUnit(double typical, double prefixed, const std::string& unit) : unit_(unit) {
  if (!(std::abs(typical) > 0.0) || !std::isfinite(typical)) return;
  const int thousands = std::clamp(static_cast<int>(std::floor(std::log10(std::abs(prefixed)) / 3.0 + 1e-12)),
                                   kSmallest, kSmallest + static_cast<int>(kPrefixes.size()) - 1);
  unit_ = kPrefixes[static_cast<std::size_t>(thousands - kSmallest)] + unit;
  size_ = std::pow(10.0, 3 * thousands);
  most_decimals_ = std::max(0, kDigits + 1 - digitsBefore(std::abs(typical) / size_));
}

std::string ReadableUnit::number(double value) const {
  const double scaled = value / size_;
  const int decimals = std::clamp(kDigits - digitsBefore(std::abs(scaled)), 0, most_decimals_);
  std::string result = formatted("%.*f", decimals, scaled);
  if (decimals == 0) return result;
  result.erase(result.find_last_not_of('0') + 1);
  if (result.back() == '.') result.pop_back();
  return result == "-0" ? "0" : result;
}

}  // namespace suspension_health_monitor
