#include "whole_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <utility>

namespace suspension_health_monitor {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failToWrite(const std::string& path, int error) {
  throw std::runtime_error(path + ": cannot be written" +
                           (error == 0 ? " to its end" : std::string(": ") + std::strerror(error)));
}

std::vector<std::string> paths(const boost::program_options::variables_map& values, const std::string& option) {
  if (values.count(option) == 0) return {};
  if (const auto* path = boost::any_cast<std::string>(&values[option].value())) return {*path};
  return values[option].as<std::vector<std::string>>();
}

}  // namespace

void requireSeparateFiles(const boost::program_options::variables_map& values, const std::vector<std::string>& inputs,
                          const std::vector<std::string>& outputs) {
  std::error_code error;
  std::set<fs::path> taken;
  for (const std::string& option : inputs)
    for (const std::string& path : paths(values, option)) taken.insert(fs::weakly_canonical(path, error));
  taken.erase("");  // an option that was not given
  for (const std::string& option : outputs)
    for (const std::string& path : paths(values, option)) {
      const fs::path full = fs::weakly_canonical(path, error);
      const bool is_new = full.empty() || taken.insert(full).second;
      if (!is_new && (fs::is_regular_file(path, error) || !fs::exists(path, error)))
        throw std::invalid_argument("--" + option + " " + path + ", must be a file of its own: it is used already");
    }
}

WholeFile::WholeFile(const std::string& path) : path_(path), temporary_path_(path), temporary_(false) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (path.empty() || fs::is_directory(status)) failToWrite(path, path.empty() ? ENOENT : EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) return;
  if (fs::exists(status)) path_ = fs::canonical(path).string();
  temporary_path_ = path_ + ".part" + std::to_string(getpid());
  std::FILE* file = std::fopen(temporary_path_.c_str(), "w");
  if (file == nullptr) failToWrite(path, errno);
  std::fclose(file);
  temporary_ = true;
}

WholeFile::~WholeFile() {
  if (temporary_) std::remove(temporary_path_.c_str());
}

void WholeFile::commit() {
  if (!temporary_) return;
  if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0) failToWrite(path_, errno);
  temporary_ = false;
}

TextFile::TextFile(const std::string& path)
    : path_(path), file_(path), stream_(std::fopen(file_.temporaryPath().c_str(), "w")) {
  if (stream_ == nullptr) failToWrite(path_, errno);
}

TextFile::~TextFile() {
  if (stream_ != nullptr) std::fclose(stream_);
}

void TextFile::commit() {
  const bool failed = std::ferror(stream_) != 0;
  errno = 0;
  if (std::fclose(std::exchange(stream_, nullptr)) != 0 || failed) failToWrite(path_, errno);
  file_.commit();
}

}  // namespace suspension_health_monitor
