#include "io/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr std::size_t kBufferBytes = 1 << 20;

std::string reason(int error) { return std::generic_category().message(error); }

/// The file that writing to `path` replaces: the end of its chain of links. A dangling link stays as it is.
std::string resolve(const std::string& path) {
  std::error_code error;
  const auto target = std::filesystem::canonical(path, error);
  return error ? path : target.string();
}

/// A short name of its own, so that a long name of the target can't make it too long for the file system.
std::string temporary_name(const std::string& target) {
  static std::atomic<unsigned> count{0};
  const auto folder = std::filesystem::path(target).parent_path();
  return (folder / fmt::format(".tinsmith-{}-{}.tmp", getpid(), count++)).string();
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path), target_(resolve(path)) {
  struct stat status {};
  if (stat(target_.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    throw OutputError(fmt::format("{}: is there and is not a regular file; choose another output", path));
  do {
    temporary_ = temporary_name(target_);
    descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) {
    const int error = errno;
    temporary_.clear();
    fail(error);
  }
  buffer_.reserve(kBufferBytes);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void OutputFile::fail(int error) const {
  throw OutputError(
      fmt::format("{}: can't be written: {}; make room or choose another folder", path_, reason(error)));
}

void OutputFile::flush() {
  const char* next = buffer_.data();
  std::size_t left = buffer_.size();
  while (left > 0) {
    const ssize_t written = ::write(descriptor_, next, left);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    next += written;
    left -= static_cast<std::size_t>(written);
  }
  buffer_.clear();
}

void OutputFile::write(const void* bytes, std::size_t size) {
  if (buffer_.size() + size > kBufferBytes) flush();
  buffer_.append(static_cast<const char*>(bytes), size);
}

void OutputFile::finish() {
  if (descriptor_ < 0) return;
  flush();
  if (fsync(descriptor_) != 0) fail(errno);
  const int failed = close(descriptor_);
  descriptor_ = -1;
  if (failed != 0) fail(errno);
}

void OutputFile::commit() {
  finish();
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

}  // namespace tinsmith
