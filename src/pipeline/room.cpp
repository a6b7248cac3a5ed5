#include "pipeline/room.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

#include "tinsmith/error.hpp"

namespace tinsmith {

namespace {

namespace fs = std::filesystem;

// The estimate of triangles was seen up to twice too high, at very coarse tolerances; twice that is certain.
constexpr std::uint64_t kCertain = 4;

struct Need {
  const std::string& folder;
  const char* what;
  const char* remedy;
  std::uint64_t expected;  // bytes
  std::uint64_t free;
};

std::string folder_of(const std::string& file) { return fs::absolute(file).parent_path().string(); }

std::uint64_t free_space(const std::string& folder) {
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  if (error)
    throw OutputError(
        fmt::format("{}: can't be used: {}; make the folder or choose another", folder, error.message()));
  return space.available;
}

bool are_on_one_disk(const std::string& a, const std::string& b) {
  struct stat of_a {};
  struct stat of_b {};
  return stat(a.c_str(), &of_a) == 0 && stat(b.c_str(), &of_b) == 0 && of_a.st_dev == of_b.st_dev;
}

std::string megabytes(std::uint64_t bytes) { return fmt::format("{} MB", (bytes + 999999) / 1000000); }

std::optional<std::string> doubt_about(const Need& need) {
  if (need.expected <= need.free) return {};
  const std::string doubt =
      fmt::format("{}: about {} of {} are expected and {} are free; make room, {}", need.folder,
                  megabytes(need.expected), need.what, megabytes(need.free), need.remedy);
  if (need.expected / kCertain > need.free) throw ResourceError(doubt);
  return doubt;
}

}  // namespace

void look_for_room(const std::string& output, const std::string& tmp, CompressPlan& plan) {
  plan.output_folder = folder_of(output);
  plan.scratch_folder = tmp.empty() ? plan.output_folder : tmp;
  plan.free_scratch = free_space(plan.scratch_folder);
  plan.free_output = free_space(plan.output_folder);
}

// The unfinished work goes when the output is written, and verified.
std::vector<std::string> require_room(const CompressPlan& plan, std::uint64_t work_there) {
  const std::uint64_t scratch = plan.expected_scratch - std::min(work_there, plan.expected_scratch);
  std::vector<std::string> doubts;
  const auto need = [&](const Need& one) {
    if (auto doubt = doubt_about(one)) doubts.push_back(std::move(*doubt));
  };
  const char* const elsewhere = "or choose another folder for unfinished work with --tmp";
  if (are_on_one_disk(plan.scratch_folder, plan.output_folder)) {
    need({plan.scratch_folder, "unfinished work and output", elsewhere, scratch + plan.expected_output,
          plan.free_scratch});
  } else {
    need({plan.scratch_folder, "unfinished work", elsewhere, scratch, plan.free_scratch});
    need({plan.output_folder, "output", "or write elsewhere", plan.expected_output, plan.free_output});
  }
  return doubts;
}

}  // namespace tinsmith
