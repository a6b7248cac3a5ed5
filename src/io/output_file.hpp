#pragma once
// A file that appears under its name only when it is whole.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tinsmith {

/// Writes to a temporary file in the folder of `path`. commit() puts it in the place of `path`; without it
/// the destructor removes the temporary file, and what stood at `path` before still stands there. Every
/// failure is an OutputError with the path and the system's reason. A link is followed, its target replaced.
///
/// A writer that is killed leaves its temporary file. The name of that tells the target, and its writer holds a
/// lock (flock) on it; so the next writer of the same target removes those that nobody holds any more.
class OutputFile {
 public:
  /// Throws OutputError when the folder can't be written or `path` is there and not a regular file.
  explicit OutputFile(const std::string& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  void write(const void* bytes, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }

  /// Brings all bytes to the disk; nothing may be written afterwards. For several files that belong together:
  /// finish() all of them before the first commit().
  void finish();

  /// finish(), then renames: after a power cut the old or the new file is there, whole. The name of a large file is
  /// brought to the disk, too.
  void commit();

 private:
  [[noreturn]] void fail(int error) const;
  void open_temporary();
  void flush();

  std::string path_;
  std::string target_;
  std::string temporary_;  // empty: none there
  std::string buffer_;
  int descriptor_ = -1;  // with the lock
};

/// Writes each element as a record of so many bytes, which put(element, bytes) fills.
template <class T, class Put>
void write_records(OutputFile& file, std::span<const T> elements, std::size_t record_bytes, Put put) {
  std::vector<char> bytes(elements.size() * record_bytes);
  for (std::size_t i = 0; i < elements.size(); ++i) put(elements[i], bytes.data() + i * record_bytes);
  file.write(bytes.data(), bytes.size());
}

}  // namespace tinsmith
