#pragma once

#include <boost/program_options.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "../ros/whole_file.h"
#include "suspension_health_monitor/internal/base/option_table.h"

namespace suspension_health_monitor {

namespace po = boost::program_options;
using nlohmann::json;

struct SimulatedDrive;

/// Exit statuses of suspension_bag, as promised to scripts.
enum ExitStatus : int { kDone = 0, kFailed = 1, kWrongUsage = 2, kWrongInput = 3, kTooLittle = 4 };

/// An input file that cannot be read, or is not what it should be: exit status 3.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Input that is in order but says too little: exit status 4.
struct TooLittleError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An inspected vehicle that fails: exit status 1.
struct FailedInspection : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Arguments = std::vector<std::string>;

/// One subcommand of suspension_bag: its file, its line in the help.
/// run() gets what stands behind the subcommand's name. It throws std::invalid_argument or
/// po::error on wrong usage, InputError, TooLittleError, or FailedInspection.
struct Command {
  const char *name, *summary;
  void (*run)(const Arguments& arguments);
};

void simulate(const Arguments& arguments);
void identify(const Arguments& arguments);
void health(const Arguments& arguments);
void inspect(const Arguments& arguments);
void compare(const Arguments& arguments);
void diagnose(const Arguments& arguments);
void effects(const Arguments& arguments);
void check(const Arguments& arguments);
void horizon(const Arguments& arguments);
void options(const Arguments& arguments);

/// Parses a subcommand's arguments; prints the help and returns nothing if -h is among them.
/// @param usage  first line of the help.  @param positional  option that bare arguments belong to, or empty.
std::optional<po::variables_map> parse(const Arguments& arguments, const std::string& usage,
                                       po::options_description options, const std::string& positional = {});

/// Among the parsed values: what was typed, as text.
inline constexpr const char* kCommandLine = "command line";

/// @return the settings of the file --config, if there is one, and of --set NAME=VALUE, which override them.
/// @throws std::invalid_argument  naming what is wrong.
OptionMap gatherOptions(const po::variables_map& values);

/// The name of a file that is standard output.
inline constexpr const char* kStandardOutput = "-";

/// The option whose value is a folder, and the file that is written there.
inline constexpr const char* kReport = "report";
inline constexpr const char* kReportFile = "report.html";

/// @return the file of an option, begun; nothing: it is not given. Where the file is called "-" it is standard output,
/// which has nothing else then: what is said to people goes to standard error from now on.
/// @throws std::runtime_error  naming the file, if it cannot be written.
std::optional<TextFile> outputFile(const po::variables_map& values, const char* option);

/// Refuses to write a file that is read, too, or to write two results into one file, and a folder called "-".
/// @param inputs, outputs  names of options with a path, or several, as their value; those not given do not matter.
/// @throws std::invalid_argument  naming option and path.
void requireSeparateFiles(const po::variables_map& values, const std::vector<std::string>& inputs,
                          const std::vector<std::string>& outputs);

/// Tells people which files were written.
/// @param outputs  as above. What is no regular file (a pipe, /dev/stdout) is not named.
void printWritten(const po::variables_map& values, const std::vector<std::string>& outputs);

/// @return paths without their folders.
std::vector<std::string> fileNames(const std::vector<std::string>& paths);

/// Writes a whole simulated drive, with progress.
void writeBag(const SimulatedDrive& drive, const std::string& path);

inline constexpr const char* kBaseline = "baseline";  ///< name of an option

}  // namespace suspension_health_monitor
