#include "suspension_health_monitor/internal/base/text.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>

namespace suspension_health_monitor {
namespace {

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

constexpr int kDigits = 3;
constexpr int kSmallest = -4;  // thousands: pico
constexpr std::array kPrefixes{"p", "n", "u", "m", "", "k", "M", "G", "T"};

/// @return digits before the point, 0 or less for numbers below 1.
int digitsBefore(double size) {
  return size > 0.0 && std::isfinite(size) ? static_cast<int>(std::floor(std::log10(size))) + 1 : 1;
}

}  // namespace

std::string suggestNearest(const std::string& name, const std::vector<std::string>& known) {
  const auto begins = [&](const std::string& other) { return other.compare(0, name.size(), name) == 0; };
  const bool is_cut_short = std::count_if(known.begin(), known.end(), begins) == 1;
  const auto difference = [&](const std::string& other) {  // share of the letters
    if (is_cut_short && begins(other)) return 0.0;
    return static_cast<double>(editDistance(name, other)) / static_cast<double>(std::max(name.size(), other.size()));
  };
  const auto nearest = std::min_element(known.begin(), known.end(),
                                        [&](const auto& a, const auto& b) { return difference(a) < difference(b); });
  if (nearest == known.end() || difference(*nearest) > 0.5) return {};
  return "; the nearest known name is " + *nearest;
}

std::string join(const std::vector<std::string>& names, const std::string& separator) {
  std::string text;
  for (const std::string& name : names)
    if (!name.empty()) text += (text.empty() ? "" : separator) + name;
  return text;
}

std::string formatted(const char* format, ...) {
  std::va_list values, again;
  va_start(values, format);
  va_copy(again, values);
  std::string text(static_cast<std::size_t>(std::vsnprintf(nullptr, 0, format, values)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  va_end(values);
  return text;
}

std::string sizeInPercent(double change) { return formatted("%ld %%", std::lround(100.0 * std::abs(change))); }

std::string sideInPercent(double change) { return sizeInPercent(change) + (change < 0.0 ? " below" : " above"); }

std::string percent(double share) { return formatted("%.*f %%", share < 0.01 ? 1 : 0, 100.0 * share); }

std::string describeEnough(double seconds) {
  if (!(seconds < kDay)) return "";
  return formatted(" (%.3g s in one piece are enough)", std::ceil(10.0 * seconds) / 10.0);
}

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
