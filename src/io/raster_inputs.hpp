#pragma once
// The rasters of a field as files: what can be read of them and what can't.

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/raster_dataset.hpp"
#include "io/raster_source.hpp"

namespace tinsmith {

/// What was left as a void because it can't be read.
struct Unreadable {
  std::vector<std::string> paths;  // files that can't be opened, then files some samples of which can't be read
  std::uint64_t n_samples = 0;     // of files that were opened, as far as they were asked for
};

/// Reads heights of each raster by many threads. Columns and rows are the raster's own.
class RasterInputs {
 public:
  explicit RasterInputs(bool skip_unreadable) : skip_(skip_unreadable) {}

  /// Opens the next raster. Returns false for one that can't be opened and is skipped. Throws like open_raster and
  /// read_source.
  bool add(const std::string& path, const InputOptions& options);

  const std::vector<RasterSource>& sources() const { return sources_; }
  RasterSource& last() { return sources_.back(); }

  bool is_surely_void(std::size_t input, const GridRect& rect) const;

  /// Like read_heights; no heights at all when the rectangle is surely void. Samples that can't be read throw
  /// UnreadableError, or are void when they are to be skipped, together with all of their block: so the same ones
  /// are, whatever was read before and by whom.
  std::vector<double> read(std::size_t input, const GridRect& rect) const;

  /// So far.
  Unreadable unreadable() const;

 private:
  using Corner = std::pair<std::int32_t, std::int32_t>;  // column, row
  struct Damage {
    std::set<Corner> readable;  // blocks
    std::set<Corner> unreadable;
  };

  template <typename Ask>
  auto noting_damage(std::size_t input, Ask ask) const;
  std::vector<double> read_stripes(std::size_t input, const GridRect& rect) const;
  std::vector<double> read_sound_blocks(std::size_t input, const GridRect& rect) const;
  bool is_readable(std::size_t input, const GridRect& block) const;
  bool is_damaged(std::size_t input) const;

  bool skip_;
  std::vector<std::string> unopened_;
  std::vector<RasterSource> sources_;
  mutable DatasetPool pool_;
  mutable std::mutex mutex_;
  mutable std::map<std::size_t, Damage> damage_;  // of the inputs that have any
};

}  // namespace tinsmith
