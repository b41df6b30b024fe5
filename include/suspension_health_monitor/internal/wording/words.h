#pragma once

#include <string>
#include <vector>

namespace suspension_health_monitor {

/// @return the names that are not empty one after the other with `separator` between them.
std::string join(const std::vector<std::string>& names, const std::string& separator = ", ");

/// @return what the records are called, in their order.
template <class Records>
std::vector<std::string> namesOf(const Records& records) {
  std::vector<std::string> names;
  for (const auto& record : records) names.push_back(record.name);
  return names;
}

/// @return the text that std::printf would write.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// @return the size of a change in whole percent, whatever its sign: "12 %".
std::string sizeInPercent(double change);

/// @return a share in percent, with one decimal below 1 %: "12 %".
std::string percent(double share);

/// @param seconds  of driving that give enough samples, whatever else may be wrong with them.
/// @return to be read after what is too short.
std::string describeEnough(double seconds);

/// Writes numbers of one kind so that they read well: three digits at most, no exponent, all with the same SI prefix.
class ReadableUnit {
 public:
  /// The prefix that brings `typical` between 1 and 1000, e.g. mm for the travel of a car.
  /// @param unit  without prefix, e.g. "m".
  ReadableUnit(double typical, const std::string& unit);

  /// The same, but without a prefix as long as `typical` is between 0.01 and 100 000: m/s^2, Hz, s.
  static ReadableUnit plain(double typical, const std::string& unit);

  /// @return number and unit, e.g. "21.3 mm".
  std::string operator()(double value) const { return number(value) + " " + unit_; }

  /// @return the number alone, in unit().
  std::string number(double value) const;

  const std::string& unit() const { return unit_; }

 private:
  ReadableUnit(double typical, double prefixed, const std::string& unit);

  std::string unit_;
  double size_ = 1.0;  // of the unit, in the one without prefix
  int most_decimals_ = 3;
};

}  // namespace suspension_health_monitor
