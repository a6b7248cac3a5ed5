#pragma once
// What a compression will take, before it is done.

#include <cstdint>
#include <string>
#include <vector>

#include "tinsmith/options.hpp"

namespace tinsmith {

/// Counts are of windows that may hold samples; those of which the files say that there is nothing in them cost
/// next to nothing. What is "expected" is an estimate: a few windows were really compressed by one thread, and all
/// are taken to be like them. Sizes in bytes.
struct CompressPlan {
  std::int32_t width = 0;  // samples, voids included
  std::int32_t height = 0;
  std::uint64_t samples = 0;      // in the windows that may hold any
  std::uint64_t windows = 0;      // that may hold any
  std::uint64_t all_windows = 0;  // of round 0
  int rounds = 0;
  int threads = 0;
  std::uint64_t tried_windows = 0;  // what the estimates are made from

  std::uint64_t memory = 0;  // that the run may take, and how it is divided:
  std::uint64_t memory_program = 0;
  std::uint64_t memory_windows = 0;       // samples and meshes of the windows at work
  std::uint64_t memory_raster_cache = 0;  // decoded blocks of the inputs
  std::uint64_t memory_chunks = 0;        // finished windows; more of them are on the disk only
  std::uint64_t expected_peak_memory = 0;

  double tolerance = 0;  // metres; as found on the tried windows for a number or ratio of triangles
  int passes = 1;        // over all windows; for a number or ratio of triangles an estimate too
  std::uint64_t expected_triangles = 0;
  std::uint64_t expected_output = 0;
  std::uint64_t expected_scratch = 0;
  double expected_seconds = 0;  // of all passes and the writing; verification is not included

  std::string scratch_folder;
  std::uint64_t free_scratch = 0;
  std::string output_folder;
  std::uint64_t free_output = 0;
  std::vector<std::string> doubts;  // where less is free than expected, a sentence each
};

/// Does none of the work but for up to nine windows (25 where there are thousands), which lie apart from each
/// other. Throws like compress(), and ResourceError for what can't fit: the memory, the output's format when not
/// even half of the estimate fits, the disks when not even a quarter does.
CompressPlan plan(const std::vector<std::string>& inputs, const std::string& output,
                  const InputOptions& input_options, const CompressOptions& options);

}  // namespace tinsmith
