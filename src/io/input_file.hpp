#pragma once
// A mesh file being read: never past its end, every complaint with its place.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tinsmith {

/// Whether a file of lines may end without a line end, as other programs' files do.
enum class LastLine { kNeedsEnd, kMayLackEnd };

/// Sequential buffered reading of a regular file, as bytes or line by line. Every failure is an InputError
/// that names the path and the byte at which it was noticed.
class InputFile {
 public:
  explicit InputFile(const std::string& path);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  std::uint64_t size() const { return size_; }
  std::uint64_t position() const { return position_; }
  std::uint64_t left() const { return size_ - position_; }

  void read(void* bytes, std::size_t size);
  template <class T>
  T read() {
    T value;
    read(&value, sizeof value);
    return value;
  }

  /// Goes on reading at this byte, at most size().
  void seek(std::uint64_t position);

  /// The next line without its end; it lives until the next call. False at the end of the file. A last line
  /// without an end is a file cut short, unless it may lack one.
  bool read_line(std::string_view& line, LastLine last_line = LastLine::kNeedsEnd);

  [[noreturn]] void fail(const std::string& what) const;

 private:
  bool refill();

  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;  // of the next byte handed out
  std::vector<char> buffer_;
  std::size_t begin_ = 0;  // of the bytes in the buffer that are not handed out yet
  std::size_t end_ = 0;
};

/// Reads n records of so many bytes, makes each a T, and visits these in blocks.
template <class T, class Make>
void visit_records(InputFile& file, std::uint64_t n, std::size_t record_bytes, Make make,
                   const std::function<void(std::span<const T>)>& visit) {
  constexpr std::uint64_t kBlock = 4096;
  std::vector<char> bytes;
  std::vector<T> block;
  for (std::uint64_t left = n; left > 0; left -= block.size()) {
    block.resize(std::min(left, kBlock));
    bytes.resize(block.size() * record_bytes);
    file.read(bytes.data(), bytes.size());
    for (std::size_t i = 0; i < block.size(); ++i) block[i] = make(bytes.data() + i * record_bytes);
    visit(block);
  }
}

}  // namespace tinsmith
