#pragma once

#include <atomic>
#include <cstddef>
#include <future>
#include <vector>

namespace suspension_health_monitor {

/// Calls work(i) for i = 0 .. count - 1 on several threads, the calling one among them, and tick() on the calling
/// thread after each of its own items. What tick() throws ends the work early and passes on. work must not throw.
template <class Work, class Tick>
void forEachInParallel(std::size_t count, int threads, const Work& work, const Tick& tick) {
  std::atomic<std::size_t> next{0};
  const auto takeItems = [&](const auto& after) {
    for (std::size_t i = next++; i < count; i = next++) {
      work(i);
      after();
    }
  };
  std::vector<std::future<void>> helpers;  // their end waits for the threads
  for (int i = 1; i < threads && static_cast<std::size_t>(i) < count; ++i)
    helpers.push_back(std::async(std::launch::async, [&] { takeItems([] {}); }));
  try {
    takeItems(tick);
  } catch (...) {
    next = count;
    throw;
  }
}

}  // namespace suspension_health_monitor
