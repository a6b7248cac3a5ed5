// tinsmith verify: the certificate, measured anew.

#include "tinsmith/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include "input_flags.hpp"
#include "inputs.hpp"
#include "io/raster_field.hpp"
#include "progress_bar.hpp"
#include "report.hpp"
#include "text.hpp"
#include "tinsmith/error.hpp"
#include "verbs.hpp"

namespace tinsmith::cli {
namespace {

constexpr const char* kManual =
    R"(tinsmith verify: measures a TIN against every sample of its DEM.

usage: tinsmith verify INPUT... MESH [--max-error M] [options]

INPUT are the rasters that the mesh was made from, MESH is the .ply, .obj, .glb or .2dm file. The file is read
as it is, and nothing of what made it is trusted. Prints a table of key, value and unit, and the verdict.

options:
  --max-error M        the tolerance that no sample may exceed, in metres, 0 or more
  --color FILE         the raster that the mesh has its colours from: how far they are off is measured too
)" TINSMITH_INPUT_MANUAL
    R"(  --json FILE          the report as one JSON object; - prints it to standard output and nothing else
  --threads N          threads to use; default: all of the machine; the certificate does not depend on it
  --memory SIZE        what the program may use, such as 512M, 1G or 2GiB; default: a quarter of what there is
  --tmp DIR            folder of scratch files, for what does not fit; default: the folder of the mesh
)" TINSMITH_PROGRESS_MANUAL
    R"(  --quiet              no progress bar, no remarks

keys:
  samples              valid samples: cells of the raster, at their centres
  covered, uncovered   of those that a fully valid block of 2 x 2 samples has as a corner
  overlapped           samples inside more than one triangle
  max_error            largest |z_TIN - z_sample|, and max_error_column, max_error_row: where (from 0)
  rmse, mean_error, p99_error   root mean square, mean (bias), and what 99 % of the samples do not exceed
  folded               triangles without a positive area in plan
  non_manifold_edges, non_manifold_vertices, t_junctions
  area_plan, area_valid   of the triangles and of the valid cells, in plan, in square metres
  components           parts of the mesh that no edge connects
  rounding             what double precision alone may add to an error
  color_samples        with --color: samples with a colour, in or on a triangle
  color_rmse, color_max_error   of the differences there, over red, green, blue and alpha, in levels of 255
  Heights and errors are in metres, whatever the units of the raster.

The mesh holds when no error exceeds the tolerance (if given), every coverable sample is covered once, no
triangle is folded, the mesh is a manifold with border and without T-junctions, and its area is the valid area.

examples:
  tinsmith verify dem.tif dem.ply --max-error 10
  tinsmith verify dem.tif dem.glb --color ortho.tif
  tinsmith verify north.tif south.tif both.glb --json report.json

exit codes: 0 it holds; 1 it does not, standard error says what; 2 wrong usage; 3 an input can't be used;
4 the report or a
scratch file can't be written; 5 out of memory or of room for scratch files; 130 interrupted
)";

struct Flags {
  std::vector<std::string> files;
  std::optional<double> max_error;
  std::string color;
  InputFlags input;
  int threads = 0;
  std::string memory;
  std::string tmp;
  std::string json;
  std::string progress = "bar";
  bool quiet = false;
};

VerifyOptions to_options(const Flags& flags) {
  if (flags.threads < 0) throw UsageError(fmt::format("--threads {}: give 0 (all) or more", flags.threads));
  VerifyOptions options;
  options.threads =
      flags.threads > 0 ? flags.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  if (!flags.memory.empty()) options.memory = to_bytes("--memory", flags.memory);
  if (!flags.tmp.empty() && !std::filesystem::is_directory(flags.tmp))
    throw UsageError(fmt::format("--tmp {}: no such folder; make it or name another", flags.tmp));
  options.tmp = flags.tmp;
  options.color = flags.color;
  return options;
}

int verify_mesh(Flags flags) {
  const std::string mesh = flags.files.back();
  flags.files.pop_back();
  require_rasters(flags.files, "tinsmith verify INPUT... MESH");
  if (flags.max_error) require_tolerance("--max-error", *flags.max_error);
  const InputOptions options = to_input_options(flags.input);
  VerifyOptions verify_options = to_options(flags);
  const ProgressForm progress = choose_progress(flags.progress, flags.quiet);
  std::vector<std::string> inputs_of_all = files_read(flags.files);
  inputs_of_all.insert(inputs_of_all.end(), {mesh, flags.color});
  require_apart({flags.json}, inputs_of_all);
  if (!flags.json.empty() && flags.json != "-") require_writable(flags.json);
  if (verify_options.memory > 0) set_raster_cache(verify_options.memory / 8);
  const OpenedInputs inputs = open_inputs(flags.files, options, flags.color);
  print_remarks(inputs.remarks, flags.quiet);
  verify_options.progress = make_progress(progress, inputs.n_samples);
  const Certificate certificate = verify(flags.files, mesh, options, verify_options);
  verify_options.progress = {};  // ends the line of the bar
  Json report = empty_report(flags.files, mesh);
  add_certificate(report, certificate, flags.max_error);
  const Resources used = resources_so_far();
  report["bytes"] = std::filesystem::file_size(mesh);
  report["seconds"] = used.seconds;
  report["peak_memory_bytes"] = used.peak_memory_bytes;
  report["threads"] = verify_options.threads;
  report["remarks"] = inputs.remarks;
  if (!flags.json.empty()) write_json(report, flags.json);
  if (flags.json != "-") {
    print_table(report);
    std::printf("%-22s %s\n", "verdict", report["holds"] ? "holds" : "does not hold");
  }
  return verdict(report, mesh);
}

}  // namespace

void add_verify(CLI::App& program, Run& run) {
  CLI::App& verb = *program.add_subcommand("verify");
  set_manual(verb, kManual);
  auto flags = std::make_shared<Flags>();
  verb.add_option("INPUT... MESH", flags->files)->required()->expected(2, CLI::detail::expected_max_vector_size);
  verb.add_option("--max-error", flags->max_error);
  verb.add_option("--color", flags->color);
  add_input_flags(verb, flags->input);
  verb.add_option("--threads", flags->threads);
  verb.add_option("--memory", flags->memory);
  verb.add_option("--tmp", flags->tmp);
  verb.add_option("--json", flags->json);
  verb.add_option("--progress", flags->progress);
  verb.add_flag("--quiet", flags->quiet);
  verb.callback([flags, &run] { run = [flags] { return verify_mesh(*flags); }; });
}

}  // namespace tinsmith::cli
