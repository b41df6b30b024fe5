#pragma once

#include <stdexcept>

namespace suspension_health_monitor {

/// Exit statuses of suspension_bag, as promised to scripts.
enum ExitStatus : int { kDone = 0, kWrongUsage = 2, kWrongInput = 3, kTooLittle = 4 };

/// An input file that cannot be read, or is not what it should be: exit status 3.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Input that is in order but says too little: exit status 4.
struct TooLittleError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace suspension_health_monitor
