#include "command.h"

#include <unistd.h>

#include <boost/algorithm/string/replace.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <set>

#include "../ros/yaml_settings.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

namespace fs = std::filesystem;
std::vector<std::string> paths(const po::variables_map& values, const std::string& option) {
  if (values.count(option) == 0) return {};
  if (const auto* path = boost::any_cast<std::string>(&values[option].value())) return {*path};
  return values[option].as<std::vector<std::string>>();
}

/// "; the nearest known name is --NAME", of options other than that of bare arguments.
std::string suggestOption(const std::string& unknown, const po::options_description& options,
                          const std::string& positional) {
  std::vector<std::string> names;
  for (const auto& option : options.options())
    if (option->long_name() != positional) names.push_back("--" + option->long_name());
  return suggestNearest(unknown, names);
}

/// A word as a shell takes it.
std::string shellQuoted(const std::string& word) {
  const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./+:=,@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  return "'" + boost::replace_all_copy(word, "'", "'\\''") + "'";
}

/// The file that an output option with this value makes.
fs::path writtenBy(const std::string& option, const std::string& value) {
  return option == kReport ? fs::path(value) / kReportFile : fs::path(value);
}

}  // namespace

std::optional<po::variables_map> parse(const Arguments& arguments, const std::string& usage,
                                       po::options_description options, const std::string& positional) {
  options.add_options()("help,h", "show this help");
  po::positional_options_description bare;
  if (!positional.empty()) bare.add(positional.c_str(), -1);
  po::variables_map values;
  // No guessing: an abbreviated option would change its meaning when a new option appears.
  const auto style = po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
  try {  // what is wrong is said in the words of the usage: nobody types --bag
    po::store(po::command_line_parser(arguments).options(options).positional(bare).style(style).run(), values);
    if (values.count("help") == 0) po::notify(values);
  } catch (const po::unknown_option& error) {
    throw std::invalid_argument(error.what() + suggestOption(error.get_option_name(), options, positional));
  } catch (const po::required_option& error) {
    const bool is_bare = error.get_option_name() == "--" + positional;
    throw std::invalid_argument((is_bare ? "no bag is given" : error.get_option_name() + " is missing") +
                                "; usage: suspension_bag " + usage);
  } catch (const po::too_many_positional_options_error&) {
    throw std::invalid_argument("options only, no other words; usage: suspension_bag " + usage);
  }
  if (values.count("help") != 0) {
    std::cout << "usage: suspension_bag " << usage << "\n" << options;
    return std::nullopt;
  }
  std::string line = "suspension_bag " + usage.substr(0, usage.find(' '));
  for (const std::string& word : arguments) line += ' ' + shellQuoted(word);
  values.emplace(kCommandLine, po::variable_value(line, true));
  return values;
}

OptionMap gatherOptions(const po::variables_map& values) {
  OptionMap options;
  if (const auto file = values["config"].as<std::string>(); !file.empty()) options = readYaml(file);
  for (const std::string& assignment : values["set"].as<std::vector<std::string>>()) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0)
      throw std::invalid_argument("--set " + shortened(assignment) + ", must be NAME=VALUE");
    options[assignment.substr(0, equals)] = assignment.substr(equals + 1);
  }
  return options;
}

std::optional<TextFile> outputFile(const po::variables_map& values, const char* option) {
  if (values.count(option) == 0) return std::nullopt;
  const auto path = values[option].as<std::string>();
  if (path != kStandardOutput) return std::optional<TextFile>(std::in_place, path);
  std::fflush(stdout);
  const int output = dup(STDOUT_FILENO);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  return std::optional<TextFile>(std::in_place, "standard output", output < 0 ? nullptr : fdopen(output, "w"));
}

void requireSeparateFiles(const po::variables_map& values, const std::vector<std::string>& inputs,
                          const std::vector<std::string>& outputs) {
  std::error_code error;
  std::set<fs::path> taken;
  for (const std::string& option : inputs)
    for (const std::string& path : paths(values, option)) taken.insert(fs::weakly_canonical(path, error));
  taken.erase("");  // an option that was not given
  for (const std::string& option : outputs)
    for (const std::string& path : paths(values, option)) {
      if (option == kReport && path == kStandardOutput)
        throw std::invalid_argument("--" + option + " -, must be a folder; ./- is one that is called so");
      const fs::path file = writtenBy(option, path);
      const fs::path full = fs::weakly_canonical(file, error);
      const bool is_new = full.empty() || taken.insert(full).second;
      if (!is_new && (fs::is_regular_file(file, error) || !fs::exists(file, error)))
        throw std::invalid_argument("--" + option + " " + path + ", must be a file of its own: it is used already");
    }
}

void printWritten(const po::variables_map& values, const std::vector<std::string>& outputs) {
  std::error_code error;
  std::vector<std::string> written;
  for (const std::string& option : outputs)
    for (const std::string& path : paths(values, option))
      if (const fs::path file = writtenBy(option, path); path != kStandardOutput && fs::is_regular_file(file, error))
        written.push_back(file);
  if (!written.empty()) std::printf("wrote %s\n", join(written).c_str());
}

std::vector<std::string> fileNames(const std::vector<std::string>& paths) {
  return mapped(paths, [](const std::string& path) { return fs::path(path).filename().string(); });
}

}  // namespace suspension_health_monitor
