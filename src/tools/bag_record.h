#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

namespace suspension_health_monitor {

/// A bag is a sequence of records: a header of name=value fields, and data. Integers are little-endian.
/// Everything here answers nothing where the bytes do not have that form; it never reads past them.

/// @return the integer that the bytes hold.
template <class Integer>
std::optional<Integer> toInteger(std::optional<std::string_view> bytes) {
  Integer value;
  if (!bytes || bytes->size() != sizeof(value)) return std::nullopt;
  std::memcpy(&value, bytes->data(), sizeof(value));
  return value;
}

/// Cuts a block, a 32 bit length and that many bytes, off the front of `rest`.
inline std::optional<std::string_view> takeBlock(std::string_view& rest) {
  const auto size = toInteger<std::uint32_t>(rest.substr(0, sizeof(std::uint32_t)));
  if (!size || *size > rest.size() - sizeof(*size)) return std::nullopt;
  const std::string_view block = rest.substr(sizeof(*size), *size);
  rest.remove_prefix(sizeof(*size) + *size);
  return block;
}

/// @param name  without '='.
/// @return the value of the field `name` of a record's header.
inline std::optional<std::string_view> findField(std::string_view header, std::string_view name) {
  while (const std::optional<std::string_view> field = takeBlock(header)) {
    const bool is_it =
        field->size() > name.size() && (*field)[name.size()] == '=' && field->substr(0, name.size()) == name;
    if (is_it) return field->substr(name.size() + 1);
  }
  return std::nullopt;
}

struct BagRecord {
  std::string_view header, body;

  std::optional<std::uint8_t> operation() const { return toInteger<std::uint8_t>(findField(header, "op")); }
  template <class Integer>
  std::optional<Integer> field(std::string_view name) const {
    return toInteger<Integer>(findField(header, name));
  }
  /// A time field, seconds and nanoseconds of 32 bit each, in [ns].
  std::optional<std::uint64_t> time(std::string_view name) const {
    const auto both = field<std::uint64_t>(name);
    if (!both) return std::nullopt;
    return (*both & 0xffffffffU) * 1000000000U + (*both >> 32U);
  }
};

/// Cuts a record off the front of `rest`.
inline std::optional<BagRecord> takeRecord(std::string_view& rest) {
  const std::optional<std::string_view> header = takeBlock(rest);
  const std::optional<std::string_view> body = header ? takeBlock(rest) : std::nullopt;
  if (!body) return std::nullopt;
  return BagRecord{*header, *body};
}

}  // namespace suspension_health_monitor
