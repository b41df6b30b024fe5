#pragma once

#include <array>
#include <string>

#include "input_task.h"
#include "message_pipeline.h"

namespace suspension_health_monitor {

/// The task Input of one strut: whether both IMUs deliver, how regularly and how late, and what was kept out. The
/// road's IMU is not part of it.
class InputDiagnostics : public InputTask {
 public:
  /// @param topics  of the sprung and the unsprung IMU.
  InputDiagnostics(const ShellOptions& options, const std::array<std::string, 2>& topics);

  void restart() override;
  void describe(const MessagePipeline& pipeline, Status& status);

 private:
  void describeTransforms(const MessagePipeline& pipeline, Status& status) const;

  std::string target_frame_;
  RejectHistory rejected_;
};

}  // namespace suspension_health_monitor
