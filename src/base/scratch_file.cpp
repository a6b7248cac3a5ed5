#include "base/scratch_file.hpp"

#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

/// Not every file system makes files without a name: there it loses its name at once.
int open_and_unlink(const std::string& folder) {
  std::string name = folder + "/.tinsmith-XXXXXX";
  const int descriptor = mkostemp(name.data(), O_CLOEXEC);
  if (descriptor >= 0) unlink(name.c_str());
  return descriptor;
}

int open_without_name(const std::string& folder) {
  const int descriptor = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC | O_EXCL, 0600);
  return descriptor >= 0 ? descriptor : open_and_unlink(folder);
}

}  // namespace

ScratchFile::ScratchFile(const std::string& folder)
    : folder_(folder.empty() ? "." : folder), descriptor_(open_without_name(folder_)) {
  if (descriptor_ < 0)
    throw OutputError(folder_ + ": no scratch file can be made here: " + reason(errno) +
                      "; choose another folder for scratch files");
}

ScratchFile::~ScratchFile() { close(descriptor_); }

std::uint64_t ScratchFile::append(const void* bytes, std::size_t size) {
  const std::uint64_t place = size_;
  const char* next = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t written = pwrite(descriptor_, next, size, static_cast<off_t>(size_));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      throw ResourceError(folder_ + ": the scratch file can't grow beyond " + std::to_string(size_) +
                          " bytes: " + reason(errno) + "; make room, allow more memory or choose another folder");
    next += written;
    size_ += static_cast<std::uint64_t>(written);
    size -= static_cast<std::size_t>(written);
  }
  return place;
}

void ScratchFile::read(std::uint64_t place, void* bytes, std::size_t size) const {
  char* next = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t n = pread(descriptor_, next, size, static_cast<off_t>(place));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0)
      throw ResourceError(folder_ + ": the scratch file can't be read back: " +
                          (n < 0 ? reason(errno) : std::string("it ends too early")) + "; check the disk");
    next += n;
    place += static_cast<std::uint64_t>(n);
    size -= static_cast<std::size_t>(n);
  }
}

}  // namespace tinsmith
