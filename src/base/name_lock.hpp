#pragma once
// One holder at a time for a name in a folder, whether there is such a file or not.

#include <string>

namespace tinsmith {

/// The lock is on the folder itself, at a byte that stands for the name: it leaves nothing behind, however the
/// process ends. Where the file system has no locks, or the folder can't be read, everyone holds it.
class NameLock {
 public:
  NameLock(const std::string& folder, const std::string& name);
  NameLock(const NameLock&) = delete;
  NameLock& operator=(const NameLock&) = delete;
  ~NameLock();

  /// False: somebody else does.
  bool is_held() const { return is_held_; }

 private:
  int descriptor_;
  bool is_held_ = true;
};

}  // namespace tinsmith
