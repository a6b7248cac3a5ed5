#include "io/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "base/disk.hpp"
#include "base/hash.hpp"
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

const char* advice(int error) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return "make the folder first or choose another";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder that you may write";
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "make room or choose another folder";
    default:
      return "choose another folder";
  }
}

constexpr std::string_view kSuffix = ".tmp";

/// What the names of the target's temporary files begin with, without the folder; then come process, number and
/// suffix. Short, so that a long name of the target can't make it too long for the file system.
std::string temporary_prefix(const std::string& target) {
  constexpr std::size_t kLongest = 64;
  const std::string name = std::filesystem::path(target).filename().string();
  return name.size() <= kLongest ? fmt::format(".tinsmith-{}-", name)
                                 : fmt::format(".tinsmith-{}~{:016x}-", name.substr(0, kLongest), hash_of(name));
}

std::string temporary_name(const std::string& target) {
  static std::atomic<unsigned> count{0};
  const auto folder = std::filesystem::path(target).parent_path();
  return (folder / fmt::format("{}{}-{}{}", temporary_prefix(target), getpid(), count++, kSuffix)).string();
}

/// Two numbers have to follow the prefix: that of "a" also begins the names for a target "a-1".
bool is_temporary(std::string_view name, std::string_view prefix) {
  if (name.size() < prefix.size() + kSuffix.size() || !name.starts_with(prefix) || !name.ends_with(kSuffix))
    return false;
  const std::string_view numbers = name.substr(prefix.size(), name.size() - prefix.size() - kSuffix.size());
  return numbers.find_first_not_of("0123456789-") == std::string_view::npos &&
         std::count(numbers.begin(), numbers.end(), '-') == 1;
}

/// Removes the file unless a writer holds it. Only who has the lock renames or removes a temporary file, hence the
/// look at the name under the lock.
void remove_if_abandoned(const std::string& temporary) {
  const int descriptor = open(temporary.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0 && is_named(descriptor, temporary)) unlink(temporary.c_str());
  close(descriptor);
}

/// Whatever can't be seen or removed here stays: that is no reason not to write.
void remove_abandoned(const std::string& target) {
  const std::string prefix = temporary_prefix(target);
  const auto parent = std::filesystem::path(target).parent_path();
  std::error_code error;
  std::filesystem::directory_iterator files(parent.empty() ? "." : parent, error);
  for (; !error && files != std::filesystem::directory_iterator(); files.increment(error))
    if (is_temporary(files->path().filename().string(), prefix)) remove_if_abandoned(files->path().string());
}

/// For a file of fewer bytes the folder is not synced: a power cut may then take back its name, not tear it.
/// Syncing took 4 ms, of the tenths of a second that such a file takes.
constexpr std::uint64_t kWorthKeepingName = 16 << 20;

/// So that the new name survives a power cut, too. A folder that can't be synced has the old or the new one.
void sync_folder_of(const std::string& target) {
  const std::string folder = std::filesystem::path(target).parent_path().string();
  const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path), target_(resolve(path)) {
  struct stat status {};
  if (stat(target_.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    throw OutputError(fmt::format("{}: is there and is not a regular file; choose another output", path));
  remove_abandoned(target_);
  do open_temporary();
  while (descriptor_ < 0);
  buffer_.reserve(kBufferBytes);
}

/// Without a descriptor afterwards when the name was in use, or another writer of the target took the file for an
/// abandoned one, before it was locked. Where there are no locks nobody does.
void OutputFile::open_temporary() {
  const std::string name = temporary_name(target_);
  const int descriptor = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0 && errno != EEXIST) fail(errno);
  if (descriptor < 0) return;
  while (flock(descriptor, LOCK_EX) != 0 && errno == EINTR) continue;
  if (!std::filesystem::exists(name)) {
    close(descriptor);
    return;
  }
  descriptor_ = descriptor;
  temporary_ = name;
}

OutputFile::~OutputFile() {
  if (!temporary_.empty()) unlink(temporary_.c_str());
  if (descriptor_ >= 0) close(descriptor_);
}

void OutputFile::fail(int error) const {
  throw OutputError(fmt::format("{}: can't be written: {}; {}", path_, reason(error), advice(error)));
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
  flush();
  if (fsync(descriptor_) != 0) fail(errno);
}

void OutputFile::commit() {
  finish();
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
  if (file_size_or_zero(target_) >= kWorthKeepingName) sync_folder_of(target_);
  // Not before, since this gives up the lock; what it could say, fsync has said.
  close(descriptor_);
  descriptor_ = -1;
}

}  // namespace tinsmith
