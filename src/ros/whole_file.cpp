#include "whole_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace suspension_health_monitor {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUnfinished = ".part";  // and the number of the process

[[noreturn]] void failToWrite(const std::string& path, int error) {
  throw std::runtime_error(path + ": cannot be written" +
                           (error == 0 ? " to its end" : std::string(": ") + std::strerror(error)));
}

// The names of unfinished files, where a signal handler may read them. No work of this program has more at a time; a
// file beyond is one that a second signal leaves to the next writer.
std::array<std::atomic<const char*>, 64> unfinished_files{};

void exchangeFirst(const char* expected, const char* wanted) {
  for (std::atomic<const char*>& file : unfinished_files) {
    const char* found = expected;
    if (file.compare_exchange_strong(found, wanted)) return;
  }
}

/// Removes what processes that were killed left of this file: its lock went with the process.
void removeAbandoned(const std::string& path) {
  const fs::path folder = fs::absolute(path).parent_path();
  const std::string start = fs::path(path).filename().string() + kUnfinished;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool unfinished = name.compare(0, start.size(), start) == 0 && name.size() > start.size() &&
                            name.find_first_not_of("0123456789", start.size()) == std::string::npos;
    if (!unfinished) continue;
    const int descriptor = open(entry.path().c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0) continue;
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) std::remove(entry.path().c_str());
    close(descriptor);
  }
}

}  // namespace

void removeUnfinishedFiles() noexcept {
  for (const std::atomic<const char*>& file : unfinished_files)
    if (const char* const path = file.load()) unlink(path);
}

WholeFile::WholeFile(const std::string& path) : path_(path), temporary_path_(path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (path.empty() || fs::is_directory(status)) failToWrite(path, path.empty() ? ENOENT : EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) return;
  if (fs::exists(status)) path_ = fs::canonical(path).string();
  removeAbandoned(path_);
  temporary_path_ = path_ + kUnfinished + std::to_string(getpid());
  while (!lock()) {
  }
  exchangeFirst(nullptr, temporary_path_.c_str());
}

/// @return false if somebody took the new file for an abandoned one, between its making and its locking.
bool WholeFile::lock() {
  descriptor_ = open(temporary_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor_ < 0) failToWrite(errno == EEXIST ? temporary_path_ : path_, errno);
  flock(descriptor_, LOCK_EX | LOCK_NB);  // where files cannot be locked, it goes without
  struct stat made {};
  if (fstat(descriptor_, &made) != 0 || made.st_nlink > 0) return true;
  close(std::exchange(descriptor_, -1));
  return false;
}

WholeFile::~WholeFile() {
  if (descriptor_ < 0) return;
  std::remove(temporary_path_.c_str());
  exchangeFirst(temporary_path_.c_str(), nullptr);
  close(descriptor_);
}

void WholeFile::commit() {
  if (descriptor_ < 0) return;
  if (fsync(descriptor_) != 0 || std::rename(temporary_path_.c_str(), path_.c_str()) != 0) failToWrite(path_, errno);
  exchangeFirst(temporary_path_.c_str(), nullptr);
  close(std::exchange(descriptor_, -1));
}

TextFile::TextFile(const std::string& path)
    : path_(path), file_(path), stream_(std::fopen(file_->temporaryPath().c_str(), "w"), &std::fclose) {
  if (stream_ == nullptr) failToWrite(path_, errno);
}

TextFile::TextFile(const std::string& name, std::FILE* stream) : path_(name), stream_(stream, &std::fclose) {
  if (stream_ == nullptr) failToWrite(path_, errno);
}

void TextFile::commit() {
  const bool failed = std::ferror(stream_.get()) != 0;
  errno = 0;
  if (std::fclose(stream_.release()) != 0 || failed) failToWrite(path_, errno);
  if (file_) file_->commit();
}

}  // namespace suspension_health_monitor
