#include <array>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include "command.h"
#include "long_work.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

constexpr std::array kCommands{
    Command{"simulate", "write a simulated drive into a bag", &simulate},
    Command{"check", "is the data any good, and which IMU is which", &check},
    Command{"identify", "damping/mass and stiffness/mass from recorded drives", &identify},
    Command{"health", "what the monitor would have said over recorded drives, and when", &health},
    Command{"inspect", "a verdict on a vehicle of which nothing is known beforehand", &inspect},
    Command{"compare", "how far a model is from the measurements, and where it fails", &compare},
    Command{"diagnose", "which physical effect the model misses, and how sure that is", &diagnose},
    Command{"effects", "the effects that diagnose and simulate know", &effects},
    Command{"horizon", "propose the filter's horizon for a strut and show why", &horizon},
    Command{"options", "all settings of the monitor or the simulator of a strut or vehicle", &options},
};

void printHelp(std::FILE* out) {
  std::fputs("usage: suspension_bag COMMAND [ARGUMENT]...\n       suspension_bag help COMMAND | --version\n\n", out);
  for (const Command& command : kCommands) std::fprintf(out, "  %-10s %s\n", command.name, command.summary);
  std::fputs(
      "\nsuspension_bag help COMMAND tells more. Tables go to standard output, messages to standard error.\n"
      "Exit status: 0 done, 1 inspect: the vehicle fails, 2 wrong usage, 3 unreadable or wrong input, 4 too little or "
      "too poor input.\n",
      out);
}

int fail(const std::string& command, const std::exception& error, ExitStatus status) {
  std::fprintf(stderr, "suspension_bag %s: %s\n", command.c_str(), error.what());
  return status;
}

int run(const Command& command, const Arguments& arguments) {
  try {
    command.run(arguments);
    if (std::fflush(stdout) != 0) throw std::runtime_error("standard output: cannot be written");
    return kDone;
  } catch (const Interrupted& interrupted) {
    std::fprintf(stderr, "suspension_bag %s: interrupted, files that were not finished are removed\n", command.name);
    std::signal(interrupted.signal, SIG_DFL);
    std::raise(interrupted.signal);   // ends the program as whoever sent the signal expects
    return 128 + interrupted.signal;  // as shells do, should the signal be blocked
  } catch (const TooLittleError& error) {
    return fail(command.name, error, kTooLittle);
  } catch (const FailedInspection& failed) {
    return fail(command.name, failed, kFailed);
  } catch (const std::invalid_argument& error) {
    return fail(command.name, error, kWrongUsage);
  } catch (const po::invalid_option_value& error) {  // of those with a type, and that is always a number
    return fail(command.name, std::invalid_argument(error.what() + std::string(", must be a number")), kWrongUsage);
  } catch (const po::error& error) {
    return fail(command.name, error, kWrongUsage);
  } catch (const std::exception& error) {  // InputError, a full disk, a bag that breaks off while it is read
    return fail(command.name, error, kWrongInput);
  }
}

int refuseCommand(const std::string& name) {
  std::fprintf(stderr, "suspension_bag: unknown command %s%s\n", shortened(name).c_str(),
               suggestNearest(name, namesOf(kCommands)).c_str());
  printHelp(stderr);
  return kWrongUsage;
}

}  // namespace

}  // namespace suspension_health_monitor

int main(int argc, char** argv) {
  using namespace suspension_health_monitor;
  Arguments arguments(argv + 1, argv + argc);
  if (arguments.size() > 1 && arguments.front() == "help") arguments = {arguments[1], "--help"};
  if (!arguments.empty() && arguments.front() == "--version") {
    std::puts("suspension_bag " PACKAGE_VERSION);
    return kDone;
  }
  if (arguments.empty() || arguments.front() == "help" || arguments.front() == "-h" || arguments.front() == "--help") {
    printHelp(arguments.empty() ? stderr : stdout);
    return arguments.empty() ? kWrongUsage : kDone;
  }
  for (const Command& command : kCommands)
    if (arguments.front() == command.name) return run(command, {arguments.begin() + 1, arguments.end()});
  return refuseCommand(arguments.front());
}
