#include "whole_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace suspension_health_monitor {
namespace {

[[noreturn]] void failToWrite(const std::string& path) {
  throw std::runtime_error(path + ": cannot be written: " + std::strerror(errno));
}

}  // namespace

WholeFile::WholeFile(const std::string& path)
    : path_(path), temporary_path_(path + ".part" + std::to_string(getpid())) {}

WholeFile::~WholeFile() {
  if (!committed_) std::remove(temporary_path_.c_str());
}

void WholeFile::commit() {
  if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0) failToWrite(path_);
  committed_ = true;
}

TextFile::TextFile(const std::string& path) : file_(path), stream_(std::fopen(file_.temporaryPath().c_str(), "w")) {
  if (stream_ == nullptr) failToWrite(path);
}

TextFile::~TextFile() {
  if (stream_ != nullptr) std::fclose(stream_);
}

void TextFile::commit() {
  const bool failed = std::ferror(stream_) != 0;
  if (std::fclose(std::exchange(stream_, nullptr)) != 0 || failed) failToWrite(file_.temporaryPath());
  file_.commit();
}

}  // namespace suspension_health_monitor
