#pragma once

#include <cstddef>

#include "long_work.h"

namespace suspension_health_monitor {

/// While it lives, what the tools do on this thread (src/tools/long_work.h) is part of a long work of Python.
class ToolsWork {
 public:
  /// @param bags  whose reading is what the callback is told of; 0: reading is not, but something else.
  ToolsWork(LongWork& work, std::size_t bags);
  ~ToolsWork();
  ToolsWork(const ToolsWork&) = delete;
  ToolsWork& operator=(const ToolsWork&) = delete;

  /// From now on the reading of so many bags is told of.
  void tellReading(std::size_t bags);

  void beginBar();
  void update(double share);
  void step() { work_.step(); }

 private:
  LongWork& work_;
  std::size_t bags_, begun_ = 0;
  ToolsWork* before_;
};

}  // namespace suspension_health_monitor
