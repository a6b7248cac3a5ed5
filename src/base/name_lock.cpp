#include "base/name_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdint>

#include "base/hash.hpp"

namespace tinsmith {

namespace {

struct flock lock_at(const std::string& name, short type) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(hash_of(name) >> 2);  // within the range of off_t, and one more
  lock.l_len = 1;
  return lock;
}

}  // namespace

// A folder can't be opened for writing, so that only shared locks can be put on its bytes: whoever asks for an
// exclusive one learns of them. The lock on the whole folder makes asking and putting one step.
NameLock::NameLock(const std::string& folder, const std::string& name)
    : descriptor_(open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0 || flock(descriptor_, LOCK_EX) != 0) return;
  struct flock found = lock_at(name, F_WRLCK);
  if (fcntl(descriptor_, F_OFD_GETLK, &found) == 0) is_held_ = found.l_type == F_UNLCK;
  struct flock own = lock_at(name, F_RDLCK);
  if (is_held_) fcntl(descriptor_, F_OFD_SETLK, &own);
  flock(descriptor_, LOCK_UN);
}

NameLock::~NameLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace tinsmith
