#pragma once

#include <boost/noncopyable.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

namespace suspension_health_monitor {

/// A file that appears under its name whole or not at all: it is written beside it and renamed by commit().
/// Without commit() (an error on the way) nothing is left, and a file that was there before stays as it was.
/// A process that is killed leaves the file under its name as it was, and its unfinished one beside it, which is
/// removed when that file is written next. After commit() the content outlives a loss of power, too. A link stays a
/// link; what is no regular file (a pipe, /dev/null) is written to as it is. The unfinished file is made anew, never
/// one that is there already: a link that somebody has put in its place is not followed.
class WholeFile : boost::noncopyable {
 public:
  /// @throws std::runtime_error  naming the file, if it cannot be written.
  explicit WholeFile(const std::string& path);
  ~WholeFile();

  /// Where to write until commit().
  const std::string& temporaryPath() const { return temporary_path_; }

  /// @throws std::runtime_error  naming the file, if it cannot be put in place.
  void commit();

 private:
  bool lock();

  std::string path_, temporary_path_;
  int descriptor_ = -1;  // of the unfinished file: locked as long as this process lives
};

/// Removes the unfinished files of this process, which is about to end without their destructors. It may be called in a
/// signal handler.
void removeUnfinishedFiles() noexcept;

/// Writes lines of text into a WholeFile, or into a stream that is open.
class TextFile {
 public:
  /// @throws std::runtime_error  naming the file, if it cannot be written.
  explicit TextFile(const std::string& path);
  /// @param name  of the stream, for messages.  @param stream  is closed by commit(), or in the end; nullptr: it could
  /// not be opened.
  /// @throws std::runtime_error  if it could not.
  TextFile(const std::string& name, std::FILE* stream);

  std::FILE* stream() { return stream_.get(); }

  /// @throws std::runtime_error  naming the file, if anything could not be written.
  void commit();

  /// Writes all that there is to write, and commits it.
  void commit(const std::string& text) {
    std::fputs(text.c_str(), stream());
    commit();
  }

 private:
  std::string path_;
  std::optional<WholeFile> file_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_;
};

}  // namespace suspension_health_monitor
