#pragma once

#include <cstddef>
#include <future>
#include <utility>
#include <vector>

#include "bag_file.h"

namespace suspension_health_monitor {

/// Chunks of a bag, one after the other: while the messages of one are used, another thread reads and decompresses the
/// next, which takes a third of the time of `identify`. Without that thread it is done when they are wanted.
class ChunksAhead {
 public:
  /// @param file  outlives this, which alone reads it from now on.
  /// @param chunks  the chunks, in the order in which they are wanted.
  ChunksAhead(BagFile& file, std::vector<BagChunk> chunks, bool in_a_thread)
      : file_(file), chunks_(std::move(chunks)), launch_(in_a_thread ? std::launch::async : std::launch::deferred) {
    start({});
  }

  /// @return the chunk that next() reads; nullptr after the last.
  const BagChunk* coming() const { return next_.valid() ? &chunks_[place_] : nullptr; }

  /// Waits for the chunk that is coming(), and begins with the one after it.
  /// @param spare  storage that is no longer needed, used again.
  /// @throws InputError  as BagFile::read().
  ChunkContents next(ChunkContents spare) {
    ChunkContents contents = next_.get();
    ++place_;
    start(std::move(spare));
    return contents;
  }

 private:
  void start(ChunkContents storage) {
    if (place_ == chunks_.size()) return;
    next_ = std::async(launch_, [this, place = place_, contents = std::move(storage)]() mutable {
      file_.read(chunks_[place], contents);
      return std::move(contents);
    });
  }

  BagFile& file_;
  std::vector<BagChunk> chunks_;
  std::launch launch_;
  std::size_t place_ = 0;
  std::future<ChunkContents> next_;  // last: its thread, which uses all else, is waited for first
};

}  // namespace suspension_health_monitor
