#pragma once

#include <cstddef>
#include <vector>

namespace suspension_health_monitor {

/// @param uniform  random numbers in [0, 1).
/// @param bias  probability that the next one is of a, as long as both have some left.
/// @return all messages of a and b; those of either in their order.
template <class Message, class Uniform>
std::vector<Message> interleaved(const std::vector<Message>& a, const std::vector<Message>& b, double bias,
                                 const Uniform& uniform) {
  std::vector<Message> all;
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    const bool take_a = j == b.size() || (i < a.size() && uniform() < bias);
    all.push_back(take_a ? a[i++] : b[j++]);
  }
  return all;
}

}  // namespace suspension_health_monitor
