#pragma once

#include <string>

namespace suspension_health_monitor {

/// A progress bar on standard error, drawn only if that is a terminal.
class Progress {
 public:
  /// @param total  amount of work, in any unit.
  Progress(std::string label, double total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param done  amount of work done so far, 0 .. total.
  void update(double done);

 private:
  std::string label_;
  double total_;
  bool visible_;
  int drawn_percent_ = -1;
};

}  // namespace suspension_health_monitor
