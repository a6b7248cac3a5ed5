// Compresses a hill in memory and says what came of it.

#include <cstdio>
#include <vector>

#include "tinsmith/compress.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/version.hpp"

namespace {

constexpr int kSide = 101;

std::vector<double> hill() {
  std::vector<double> heights;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double dx = column - 50;
      const double dy = row - 50;
      heights.push_back(500 - 0.1 * (dx * dx + dy * dy));
    }
  }
  return heights;
}

}  // namespace

int main() {
  const std::vector<double> heights = hill();
  tinsmith::CompressOptions options;
  options.max_error = 2;
  options.threads = 1;
  tinsmith::CompressReport report;
  try {
    const tinsmith::Tin tin = tinsmith::compress({kSide, kSide, heights.data(), 10, 10}, options, &report);
    std::printf("tinsmith %s: %d samples became %zu triangles over %zu vertices\n", tinsmith::version(),
                kSide * kSide, tin.triangles.size(), tin.vertices.size());
    const bool is_plausible = !tin.triangles.empty() && tin.triangles.size() < report.full_triangles / 10;
    return is_plausible ? 0 : 1;
  } catch (const tinsmith::Error& error) {
    std::fprintf(stderr, "example: %s\n", error.what());
    return error.exit_code();
  }
}
