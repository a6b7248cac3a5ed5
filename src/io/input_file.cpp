#include "io/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

// Also the longest line. The longest that we write is a CRS, some kilobytes.
constexpr std::size_t kBufferBytes = 1 << 20;

}  // namespace

InputFile::InputFile(const std::string& path) : path_(path) {
  // O_NONBLOCK: opening a pipe by mistake must not wait for its writer.
  descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0)
    throw InputError(fmt::format("{}: can't be opened: {}; check the name of the mesh", path,
                                 std::generic_category().message(errno)));
  struct stat status {};
  if (fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
    close(descriptor_);
    throw InputError(fmt::format("{}: is not a regular file; name a mesh file", path));
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
  buffer_.resize(std::min<std::uint64_t>(size_ + 1, kBufferBytes));
}

InputFile::~InputFile() { close(descriptor_); }

void InputFile::fail(const std::string& what) const {
  throw InputError(fmt::format("{}: {} (at byte {} of {}); write the mesh again", path_, what, position_, size_));
}

bool InputFile::refill() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  ssize_t got = -1;
  do {
    got = ::read(descriptor_, buffer_.data() + end_, buffer_.size() - end_);
  } while (got < 0 && errno == EINTR);
  if (got < 0) fail("can't be read: " + std::generic_category().message(errno));
  end_ += static_cast<std::size_t>(got);
  return got > 0;
}

void InputFile::read(void* bytes, std::size_t size) {
  char* to = static_cast<char*>(bytes);
  while (size > 0) {
    if (begin_ == end_ && !refill()) fail("ends too early");
    const std::size_t n = std::min(size, end_ - begin_);
    std::memcpy(to, buffer_.data() + begin_, n);
    begin_ += n;
    position_ += n;
    to += n;
    size -= n;
  }
}

void InputFile::seek(std::uint64_t position) {
  if (lseek(descriptor_, static_cast<off_t>(position), SEEK_SET) < 0)
    fail("can't be read: " + std::generic_category().message(errno));
  position_ = position;
  begin_ = end_ = 0;
}

bool InputFile::read_line(std::string_view& line, LastLine last_line) {
  std::size_t searched = 0;
  while (true) {
    const std::string_view ready(buffer_.data() + begin_, end_ - begin_);
    const std::size_t length = ready.find('\n', searched);
    if (length != std::string_view::npos) {
      line = ready.substr(0, length);
      if (line.ends_with('\r')) line.remove_suffix(1);
      begin_ += length + 1;
      position_ += length + 1;
      return true;
    }
    searched = ready.size();
    if (ready.size() == buffer_.size()) fail("a line is too long to be one of a mesh");
    if (refill()) continue;
    if (begin_ == end_) return false;
    if (last_line == LastLine::kNeedsEnd) fail("the last line is cut short");
    line = std::string_view(buffer_.data() + begin_, end_ - begin_);
    position_ += line.size();
    begin_ = end_;
    return true;
  }
}

}  // namespace tinsmith
