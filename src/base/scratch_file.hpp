#pragma once
// A file for what memory does not hold. It has no name, so nothing is left of it however the program ends.

#include <cstddef>
#include <cstdint>
#include <string>

namespace tinsmith {

class ScratchFile {
 public:
  /// Throws OutputError, with the system's reason, when no file can be made in the folder ("" is the current one).
  explicit ScratchFile(const std::string& folder);
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ~ScratchFile();

  /// Writes behind all that was written before; gives the place of the first byte. From one thread at a time.
  /// Throws ResourceError when there is no room.
  std::uint64_t append(const void* bytes, std::size_t size);

  /// Reads what was written at a place. May be called by several threads. Throws ResourceError.
  void read(std::uint64_t place, void* bytes, std::size_t size) const;

 private:
  std::string folder_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace tinsmith
