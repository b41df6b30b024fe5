#include "whole_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace suspension_health_monitor {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failToWrite(const std::string& path, int error) {
  throw std::runtime_error(path + ": cannot be written" +
                           (error == 0 ? " to its end" : std::string(": ") + std::strerror(error)));
}

}  // namespace

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
