#pragma once

#include <boost/noncopyable.hpp>
#include <cstddef>

#include "long_work.h"

namespace suspension_health_monitor {

/// While it lives, what the tools do on this thread (src/tools/long_work.h) is part of a long work of Python.
class ToolsWork : boost::noncopyable {
 public:
  /// @param bags  number of bags whose reading the callback reports; 0: it reports something else.
  explicit ToolsWork(LongWork& work, std::size_t bags = 0);
  ~ToolsWork();

  /// From now on the callback reports the reading of so many bags.
  void tellReading(std::size_t bags);

  void beginBar() { ++begun_; }
  void update(double share);
  void step() { work_.step(); }

 private:
  LongWork& work_;
  std::size_t bags_, begun_ = 0;
  ToolsWork* before_;
};

}  // namespace suspension_health_monitor
