#pragma once

#include <cstddef>
#include <vector>

namespace suspension_health_monitor {

/// Keeps some items, evenly spread, of a series of unknown length: every n-th, n doubling when there are too many.
template <class Item>
class Digest {
 public:
  /// @param wanted  of any longer series so many at least, and fewer than twice as many.
  explicit Digest(std::size_t wanted) : wanted_(wanted) {}

  void add(const Item& item) {
    if (count_++ % stride_ != 0) return;
    items_.push_back(item);
    if (items_.size() < 2 * wanted_) return;
    for (std::size_t i = 0; 2 * i < items_.size(); ++i) items_[i] = items_[2 * i];
    items_.resize(items_.size() / 2);
    stride_ *= 2;
  }

  const std::vector<Item>& items() const { return items_; }

 private:
  std::size_t wanted_;
  std::vector<Item> items_;
  std::size_t count_ = 0;
  std::size_t stride_ = 1;
};

}  // namespace suspension_health_monitor
