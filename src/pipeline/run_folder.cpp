#include "pipeline/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <functional>
#include <system_error>

#include "base/disk.hpp"
#include "base/hash.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {

namespace {

namespace fs = std::filesystem;

constexpr const char* kIdentity = "run";
constexpr const char* kLock = "lock";

fs::path target_of(const std::string& output) { return fs::weakly_canonical(fs::absolute(output)); }

std::string in_use(const std::string& output) {
  return fmt::format("{}: another run is at work on it; wait for it, or choose another output", output);
}

std::string folder_for(const fs::path& target, const std::string& tmp) {
  if (tmp.empty()) return (target.parent_path() / ("." + target.filename().string() + ".tinsmith")).string();
  return (fs::path(tmp) / fmt::format("{}-{:016x}.tinsmith", target.filename().string(), hash_of(target.string())))
      .string();
}

std::string text_of(const Identity& identity) { return fmt::format("{}\n", fmt::join(identity, "\n")); }

Identity lines_of(const std::string& text) {
  Identity lines;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find('\n', i), text.size());
    lines.push_back(text.substr(i, end - i));
    i = end + 1;
  }
  return lines;
}

// The first line that differs, as "was, is now".
std::string difference(const Identity& was, const Identity& now) {
  const std::size_t n = std::min(was.size(), now.size());
  const auto [a, b] = std::mismatch(was.begin(), was.begin() + static_cast<std::ptrdiff_t>(n), now.begin());
  if (a == was.begin() + static_cast<std::ptrdiff_t>(n)) return "other inputs";
  return fmt::format("'{}' then, '{}' now", *a, *b);
}

}  // namespace

RunFolder::RunFolder(const std::string& output, const std::string& tmp, const Identity& identity, bool fresh)
    : output_lock_(target_of(output).parent_path().string(), target_of(output).filename().string()),
      path_(folder_for(target_of(output), tmp)) {
  if (!output_lock_.is_held()) throw OutputError(in_use(output));
  do {
    std::error_code error;
    fs::create_directories(path_, error);
    if (error)
      throw OutputError(
          fmt::format("{}: can't be made: {}; choose another folder with --tmp", path_, error.message()));
    lock_.emplace(path_ + "/" + kLock, output);
  } while (!lock_->is_there());
  take_over(identity, fresh);
}

RunFolder::Lock::Lock(const std::string& file, const std::string& output)
    : file_(file), descriptor_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0)
    throw OutputError(fmt::format("{}: can't be written: {}; choose another folder with --tmp", file,
                                  std::generic_category().message(errno)));
  // Any other failure: a file system without locks.
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(descriptor_);
  throw OutputError(in_use(output));
}

RunFolder::Lock::~Lock() { close(descriptor_); }

bool RunFolder::Lock::is_there() const { return is_named(descriptor_, file_); }

void RunFolder::take_over(const Identity& identity, bool fresh) {
  const std::string file = path_ + "/" + kIdentity;
  const std::string was = read_from_file(file, 0, file_size_or_zero(file));
  const std::string now = text_of(identity);
  if (was == now && !fresh) return;
  if (was != now && !fresh && has_work()) {
    const std::string what =
        was.empty() ? "options that can't be read any more" : difference(lines_of(was), lines_of(now));
    throw UsageError(
        fmt::format("{}: holds the work of an unfinished run with {}; give --fresh to throw that away, or what it "
                    "was given to go on",
                    path_, what));
  }
  make_empty();
  append_to_file(file, now);
}

bool RunFolder::has_work() const {
  std::error_code error;
  for (fs::directory_iterator entry(path_, error); !error && entry != fs::end(entry); entry.increment(error)) {
    if (entry->is_directory(error) && entry->path().filename() != kIdentity) return true;
  }
  return false;
}

void RunFolder::make_empty() {
  std::error_code error;
  for (fs::directory_iterator entry(path_, error); !error && entry != fs::end(entry); entry.increment(error)) {
    if (entry->path().filename() != kLock) fs::remove_all(entry->path(), error);
    if (error) break;
  }
  if (error)
    throw OutputError(fmt::format("{}: an earlier run's work can't be removed: {}; remove this folder yourself",
                                  path_, error.message()));
}

RunFolder::~RunFolder() {
  if (!has_work()) remove();
}

std::string RunFolder::subfolder(const std::string& name) const {
  const fs::path folder = fs::path(path_) / name;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(fmt::format("{}: can't be made: {}", folder.string(), error.message()));
  return folder.string();
}

std::uint64_t RunFolder::size_bytes() const {
  std::error_code error;
  std::uint64_t size = 0;
  for (fs::recursive_directory_iterator entry(path_, error); !error && entry != fs::end(entry);
       entry.increment(error))
    size += file_size_or_zero(entry->path().string());
  return size;
}

void RunFolder::remove_subfolder(const std::string& name) const {
  std::error_code error;  // what can't be removed only takes room
  fs::remove_all(fs::path(path_) / name, error);
}

void RunFolder::remove() {
  std::error_code error;  // what can't be removed is in nobody's way
  fs::remove_all(path_, error);
}

}  // namespace tinsmith
