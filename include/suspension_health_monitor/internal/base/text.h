#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace suspension_health_monitor {

inline constexpr double kDay = 86400.0;  ///< [s]; nobody drives for longer: a message names no such time

/// What names are made of.
inline const std::string kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
inline const std::string kNameCharacters = kLetters + "0123456789_";

/// For a message that refuses an unknown name.
/// @return "; the nearest known name is ...": the only one that begins like this, or the one with the smallest share of
/// letters to change (Levenshtein's distance); empty if that is more than half of them.
std::string suggestNearest(const std::string& name, const std::vector<std::string>& known);

/// @return the text that std::printf would write.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// @return the number as short as it can be told from its neighbours that somebody would write: "0.02", "1e+300".
inline std::string numberText(double value) {
  return std::isnan(value) ? "nan" : formatted("%.15g", value);  // NaN of either sign
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

/// @return what work() returns; the words of a std::invalid_argument that it throws get `prefix` in front.
template <class Work>
auto prefixed(const std::string& prefix, const Work& work) {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(prefix + error.what());
  }
}

/// @return the names that are not empty one after the other with `separator` between them.
std::string join(const std::vector<std::string>& names, const std::string& separator = ", ");

/// @param make  a function of an item, or a member of it.
/// @return what it makes of every item, in their order.
template <class Items, class Make>
auto mapped(const Items& items, const Make& make) {
  std::vector<std::decay_t<decltype(std::invoke(make, *std::begin(items)))>> made;
  for (const auto& item : items) made.push_back(std::invoke(make, item));
  return made;
}

/// @return what the records are called, in their order.
template <class Records>
std::vector<std::string> namesOf(const Records& records) {
  return mapped(records, [](const auto& record) -> std::string { return record.name; });
}

/// Takes the items out of a list for which keep(item) is false.  @return them, in their order.
template <class Item, class Keep>
std::vector<Item> takeUnless(std::vector<Item>& items, const Keep& keep) {
  const auto first = std::stable_partition(items.begin(), items.end(), keep);
  std::vector<Item> taken(first, items.end());
  items.erase(first, items.end());
  return taken;
}

/// @return the size of a change in whole percent, whatever its sign: "12 %".
std::string sizeInPercent(double change);

/// @return the same and to which side: "12 % below", "12 % above".
std::string sideInPercent(double change);

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
