#include "base/disk.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "tinsmith/error.hpp"

namespace tinsmith {

namespace {

// Closes what it opened.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags) : number_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

[[noreturn]] void fail_to_write(const std::string& path, int error) {
  throw OutputError(
      path + ": can't be written: " + std::generic_category().message(error) +
      "; make room, or choose another folder with --tmp, and run the same command again: it goes on from here");
}

}  // namespace

std::uint64_t append_to_file(const std::string& path, std::string_view bytes) {
  const Descriptor file(path, O_WRONLY | O_CREAT);
  const off_t start = file.number() < 0 ? -1 : lseek(file.number(), 0, SEEK_END);
  if (start < 0) fail_to_write(path, errno);
  while (!bytes.empty()) {
    const ssize_t written = write(file.number(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      // What fitted would look like damage to the next run; where this fails too, checksums find it.
      [[maybe_unused]] const int shortened = ftruncate(file.number(), start);
      fail_to_write(path, error);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return static_cast<std::uint64_t>(start);
}

std::string read_from_file(const std::string& path, std::uint64_t offset, std::uint64_t size) {
  const Descriptor file(path, O_RDONLY);
  if (file.number() < 0) return {};
  std::string bytes(size, '\0');
  std::size_t n = 0;
  while (n < bytes.size()) {
    const ssize_t got = pread(file.number(), bytes.data() + n, bytes.size() - n, static_cast<off_t>(offset + n));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    n += static_cast<std::size_t>(got);
  }
  bytes.resize(n);
  return bytes;
}

bool is_named(int descriptor, const std::string& name) {
  struct stat file {};
  struct stat named {};
  return fstat(descriptor, &file) == 0 && lstat(name.c_str(), &named) == 0 && file.st_dev == named.st_dev &&
         file.st_ino == named.st_ino;
}

std::uint64_t file_size_or_zero(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

}  // namespace tinsmith
