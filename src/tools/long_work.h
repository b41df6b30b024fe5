#pragma once

#include <array>
#include <boost/noncopyable.hpp>
#include <csignal>
#include <string>

namespace suspension_health_monitor {

/// SIGINT, SIGTERM or SIGHUP came. No std::exception: nobody on the way takes it for an error of his own.
struct Interrupted {
  int signal;
};

/// Made before a file is begun. While it lives, a signal that asks the program to end is only noted, and check() throws
/// it out of the loop that does the work, so that unfinished files are removed on the way. A second one ends the
/// program at once. What the parent has ignored (nohup) stays ignored. One at a time.
class Interruption : boost::noncopyable {
 public:
  Interruption();
  ~Interruption();

  /// @throws Interrupted  if a signal has come.
  static void check();

 private:
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

  std::array<struct sigaction, kSignals.size()> before_{};
};

/// A progress bar on standard error, drawn only if that is a terminal.
class Progress : boost::noncopyable {
 public:
  /// @param total  amount of work, in any unit.
  Progress(std::string label, double total);
  ~Progress();

  /// @param done  amount of work done so far, 0 .. total.
  /// @throws Interrupted  as Interruption::check().
  void update(double done);

  /// Takes the bar off, before anything else is said; the next update() draws it again.
  void clear();

 private:
  std::string label_;
  double total_;
  bool visible_;
  int drawn_percent_ = -1;
};

}  // namespace suspension_health_monitor
