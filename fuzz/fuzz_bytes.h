#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace suspension_health_monitor {

/// Numbers taken off the front of arbitrary bytes; zeros behind their end.
class FuzzBytes {
 public:
  FuzzBytes(const std::uint8_t* bytes, std::size_t size) : bytes_(bytes), left_(size) {}

  bool empty() const { return left_ == 0; }

  template <class Number>
  Number take() {
    Number value{};
    const std::size_t size = left_ < sizeof(value) ? left_ : sizeof(value);
    if (size > 0) std::memcpy(&value, bytes_, size);
    bytes_ += size;
    left_ -= size;
    return value;
  }

  /// @return one of 0 .. count - 1.
  std::size_t choose(std::size_t count) { return take<std::uint8_t>() % count; }

 private:
  const std::uint8_t* bytes_;
  std::size_t left_;
};

}  // namespace suspension_health_monitor
