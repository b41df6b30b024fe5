#include "suspension_health_monitor/discrepancy/readable_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace suspension_health_monitor {
namespace {

constexpr int kDigits = 3;
constexpr int kSmallest = -4;  // thousands: pico
constexpr std::array kPrefixes{"p", "n", "u", "m", "", "k", "M", "G", "T"};

}  // namespace

ReadableUnit::ReadableUnit(double typical, const std::string& unit) : unit_(unit) {
  const double size = std::abs(typical);
  if (!(size > 0.0) || !std::isfinite(size)) return;
  const int thousands = std::clamp(static_cast<int>(std::floor(std::log10(size) / 3.0 + 1e-12)), kSmallest,
                                   kSmallest + static_cast<int>(kPrefixes.size()) - 1);
  unit_ = kPrefixes[static_cast<std::size_t>(thousands - kSmallest)] + unit;
  size_ = std::pow(10.0, 3 * thousands);
}

ReadableUnit ReadableUnit::plain(double typical, const std::string& unit) {
  const double size = std::abs(typical);
  return size >= 0.01 && size < 1e5 ? ReadableUnit(1.0, unit) : ReadableUnit(typical, unit);
}

std::string ReadableUnit::number(double value) const {
  const double scaled = value / size_;
  const double size = std::abs(scaled);
  // Of 0.00012 in a unit where things are of order 1 nobody wants to see more than that it is small.
  const int before = size > 0.0 && std::isfinite(size) ? static_cast<int>(std::floor(std::log10(size))) + 1 : 1;
  char text[32];
  std::snprintf(text, sizeof(text), "%.*f", std::clamp(kDigits - before, 0, 2 * kDigits), scaled);
  return text;
}

}  // namespace suspension_health_monitor
