// tinsmith compress: DEM in, certified TIN out.

#include "tinsmith/compress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "choose.hpp"
#include "compress_summary.hpp"
#include "input_flags.hpp"
#include "inputs.hpp"
#include "io/mesh_file.hpp"
#include "plan_summary.hpp"
#include "progress_bar.hpp"
#include "report.hpp"
#include "text.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/verify.hpp"
#include "verbs.hpp"

namespace tinsmith::cli {
namespace {

constexpr const char* kManual = R"(tinsmith compress: DEM rasters into a TIN with a certified largest error.

usage: tinsmith compress INPUT... OUTPUT --max-error M | --triangles N | --ratio R [options]

INPUT are rasters that GDAL reads; several are one mosaic, if their CRS and steps match and their origins are a
whole number of steps apart. OUTPUT is a mesh, its format by extension: .ply (binary, doubles), .obj, .2dm (opens
in QGIS), .glb (glTF 2.0, Y up). Coordinates are those of the input's CRS (.glb: metres; its extras hold the CRS).
The written file is measured against every valid sample (see tinsmith verify --help), and that is reported.

when to stop, exactly one of:
  --max-error M        no sample is farther than M metres from the surface, vertically; 0 or more
  --triangles N        at most N triangles, with the least error that reaches it
  --ratio R            the same as a fraction of the full grid's triangles, above 0, at most 1

colour:
  --color FILE         a raster of 1 to 4 bands (grey, grey and alpha, RGB, RGBA) of any resolution and CRS, as the
                       colours of the vertices, in .ply, .glb and .obj (without alpha); white where it has none. What
                       colours need is kept too; --max-error is the same promise. The report has color_rmse and
                       color_max_error, in levels of 255
  --color-tolerance L  levels of 255, above 0 (default {}): no collapse makes the colours around it worse than this
                       (root mean square); less keeps more triangles

options:
  --placement P        where a vertex may lie: optimal (anywhere), segment (on the collapsed edge) or subset
                       (every vertex is a sample) (default optimal)
  --effort E           fast, default or best: how much refinement follows the first pass, for fewer triangles; best
                       takes 2.5 to 3.5 times as long as fast
  --window T           samples along a window's side (default {}); may change the result a little
  --threads N          0: as many as the machine has, if the memory holds so many windows (default 0); never changes
                       the result
  --memory SIZE        what the whole program may take, as 512M, 1.5G or bytes (default: a quarter of the machine's);
                       finished windows beyond it are on the disk only; never changes the result
  --tmp DIR            folder for unfinished work (default: a hidden folder beside OUTPUT, removed at the end)
  --fresh              throw away the unfinished work of an earlier run on the same OUTPUT with other options
  --plan               do none of it, but say what it will take: windows, memory, scratch space, triangles, bytes and
                       time, estimated from 9 windows (25 of thousands) that are compressed for that; fails with code 5
                       when it can't fit
)" TINSMITH_INPUT_MANUAL
                                R"(  --no-verify          don't measure the written file
  --json FILE          the report as one JSON object; - prints it to standard output and nothing else
)" TINSMITH_PROGRESS_MANUAL
                                R"(  --quiet              no progress bar, no remarks
  --verbose            each round's triangles and seconds, and the whole certificate

A run that was stopped (killed, disk full, interrupted) goes on with the same command, and gives the same bytes.

Cells are taken as samples at their centres; cells with a void at a corner become holes. Heights and tolerances in
the report are metres, whatever the raster's units. The bytes written depend on the inputs and options only.

examples:
  tinsmith compress dem.tif dem.ply --max-error 5
  tinsmith compress north.tif south.tif both.glb --ratio 0.01
  tinsmith compress dem.tif dem.glb --max-error 1 --color ortho.tif
  tinsmith compress @tiles.txt country.ply --max-error 1 --memory 2G --tmp /scratch --plan
  tinsmith compress dem.vrt dem.2dm --max-error 0.5 --bbox 380000 5090000 390000 5100000 --json report.json

exit codes: 0 done; 1 the certificate does not hold, or there is no such result; 2 wrong usage; 3 an input can't be
used; 4 an output can't be written; 5 memory, disks or the format don't suffice; 130 interrupted. Unless the exit code
is 0 or 1, or it says that OUTPUT is written, what stood there before still stands there.
)";

struct Flags {
  std::vector<std::string> files;
  std::optional<double> max_error;
  std::optional<double> triangles;
  std::optional<double> ratio;
  std::string color;
  std::optional<double> color_tolerance;
  std::string placement = "optimal";
  std::string effort = "default";
  int window = CompressOptions().window;
  int threads = CompressOptions().threads;
  std::string memory;
  std::string tmp;
  bool fresh = false;
  bool plan = false;
  InputFlags input;
  bool no_verify = false;
  std::string json;
  std::string progress = "bar";
  bool quiet = false;
  bool verbose = false;
};

void require_one_stop(const Flags& flags) {
  const int n_stops = (flags.max_error ? 1 : 0) + (flags.triangles ? 1 : 0) + (flags.ratio ? 1 : 0);
  if (n_stops == 0)
    throw UsageError(
        "compress: when to stop? give --max-error METRES, --triangles N or --ratio R, for example "
        "--max-error 5");
  if (n_stops > 1) throw UsageError("compress: give only one of --max-error, --triangles and --ratio");
  if (flags.max_error) require_tolerance("--max-error", *flags.max_error);
}

void set_colour(const Flags& flags, CompressOptions& options) {
  options.color = flags.color;
  if (!flags.color_tolerance) return;
  if (flags.color.empty())
    throw UsageError("--color-tolerance: says nothing without colours; give them with --color FILE");
  if (!(*flags.color_tolerance > 0 && std::isfinite(*flags.color_tolerance)))
    throw UsageError(
        fmt::format("--color-tolerance {}: give a number of levels of 255, above 0", *flags.color_tolerance));
  options.color_tolerance = *flags.color_tolerance;
}

CompressOptions to_options(const Flags& flags) {
  require_one_stop(flags);
  CompressOptions options;
  set_colour(flags, options);
  options.max_error = flags.max_error;
  options.triangles = flags.triangles;
  options.ratio = flags.ratio;
  options.placement = choose_placement(flags.placement);
  options.effort = choose<Effort>(
      "--effort", flags.effort, {{"fast", Effort::kFast}, {"default", Effort::kDefault}, {"best", Effort::kBest}});
  options.window = flags.window;
  options.threads = flags.threads;
  if (!flags.memory.empty()) options.memory = to_bytes("--memory", flags.memory);
  if (!flags.tmp.empty() && !std::filesystem::is_directory(flags.tmp))
    throw UsageError(fmt::format("--tmp {}: no such folder; make it or name another", flags.tmp));
  options.tmp = flags.tmp;
  options.fresh = flags.fresh;
  return options;
}

// All that can be found wrong with the outputs before the work.
void require_usable_outputs(const Flags& flags, const std::string& output) {
  std::vector<std::string> inputs = files_read(flags.files);
  if (!flags.color.empty()) inputs.push_back(flags.color);
  const std::string& json = flags.json;
  require_mesh_extension(output);
  if (!flags.color.empty()) require_format_holds_colour(output, 1);
  require_apart({output, json}, inputs);
  require_writable(output);
  if (!json.empty() && json != "-") require_writable(json);
}

void add_compression(Json& report, const CompressReport& compressed, const std::string& output) {
  report["samples"] = compressed.samples;
  report["vertices"] = compressed.vertices;
  report["triangles"] = compressed.triangles;
  report["tolerance"] = compressed.tolerance;
  report["windows"] = compressed.windows;
  report["bytes"] = std::filesystem::file_size(output);
  report["full_triangles"] = compressed.full_triangles;
  report["start_triangles"] = compressed.start_triangles;
  report["round_triangles"] = compressed.round_triangles;
  report["round_seconds"] = compressed.round_seconds;
  report["unreadable_inputs"] = compressed.unreadable_inputs;
  report["remarks"] = compressed.remarks;
}

// What was said of the inputs before the work, and was not said again after it.
void add_remarks(Json& report, const std::vector<std::string>& remarks) {
  Json& known = report["remarks"];
  for (const std::string& remark : remarks)
    if (std::find(known.begin(), known.end(), remark) == known.end()) known.push_back(remark);
}

int plan_run(const Flags& flags, const std::string& output, const InputOptions& input_options,
             CompressOptions& options) {
  const CompressPlan planned = plan(flags.files, output, input_options, options);
  options.progress = {};  // ends the line of the bar
  if (!flags.json.empty()) write_json(plan_report(planned, flags.files, output), flags.json);
  if (flags.json != "-") print_plan(planned, output, !flags.max_error);
  print_remarks(planned.doubts, flags.quiet);
  return 0;
}

Certificate verify_output(const Flags& flags, const std::string& output, const InputOptions& input_options,
                          const CompressOptions& options) {
  try {
    return verify(flags.files, output, input_options,
                  {flags.threads, options.memory, flags.tmp, options.progress, flags.color});
  } catch (const Interrupted&) {
    throw Interrupted(fmt::format(
        "interrupted; {} is written, but not verified yet: the same command goes on from here", output));
  }
}

std::vector<std::string> without(std::vector<std::string> remarks, const std::vector<std::string>& told) {
  std::erase_if(remarks, [&](const auto& one) { return std::find(told.begin(), told.end(), one) != told.end(); });
  return remarks;
}

// As measured over 105 million and 1.07 billion samples of which 1 % remain. Attempts are not known beforehand.
std::vector<StageShare> stages_of(const Flags& flags) {
  if (flags.plan) return {};
  std::vector<StageShare> stages{{"simplify", 0.855}, {"write", 0.01}};
  if (!flags.no_verify) stages.push_back({"verify", 0.135});
  return stages;
}

int compress_rasters(Flags flags) {
  const std::string output = flags.files.back();
  flags.files.pop_back();
  const InputOptions input_options = to_input_options(flags.input);
  CompressOptions options = to_options(flags);
  const ProgressForm progress = choose_progress(flags.progress, flags.quiet);
  require_rasters(flags.files, "tinsmith compress INPUT... OUTPUT");
  require_usable_outputs(flags, output);
  const OpenedInputs inputs = open_inputs(flags.files, input_options, flags.color);
  print_remarks(inputs.remarks, flags.quiet);
  options.progress = make_progress(progress, inputs.n_samples, stages_of(flags));
  if (flags.plan) return plan_run(flags, output, input_options, options);
  options.doubt = [&](const std::string& doubt) { print_remarks({doubt}, flags.quiet); };
  double seconds = 0;
  std::optional<Certificate> certificate;
  const CompressReport compressed =
      compress(flags.files, output, input_options, options, [&](const CompressReport&) {
        seconds = resources_so_far().seconds;
        if (!flags.no_verify) certificate = verify_output(flags, output, input_options, options);
      });
  options.progress = {};  // ends the line of the bar
  print_remarks(without(compressed.remarks, inputs.remarks), flags.quiet);
  Json report = empty_report(flags.files, output);
  report["threads"] = compressed.threads;
  report["seconds"] = seconds;
  add_compression(report, compressed, output);
  add_remarks(report, inputs.remarks);
  if (certificate) {
    add_certificate(report, *certificate, compressed.tolerance);
    report["verify_seconds"] = resources_so_far().seconds - seconds;
  }
  report["peak_memory_bytes"] = resources_so_far().peak_memory_bytes;
  if (!flags.json.empty()) write_json(report, flags.json);
  if (flags.json != "-") print_summary(report, flags.verbose);
  return flags.no_verify ? 0 : verdict(report, output);
}

}  // namespace

void add_compress(CLI::App& program, Run& run) {
  CLI::App& verb = *program.add_subcommand("compress");
  set_manual(verb, fmt::format(kManual, CompressOptions().color_tolerance, CompressOptions().window));
  auto flags = std::make_shared<Flags>();
  verb.add_option("INPUT... OUTPUT", flags->files)->required()->expected(2, CLI::detail::expected_max_vector_size);
  verb.add_option("--max-error", flags->max_error);
  verb.add_option("--triangles", flags->triangles);
  verb.add_option("--ratio", flags->ratio);
  verb.add_option("--color", flags->color);
  verb.add_option("--color-tolerance", flags->color_tolerance);
  verb.add_option("--placement", flags->placement);
  verb.add_option("--effort", flags->effort);
  verb.add_option("--window", flags->window);
  verb.add_option("--threads", flags->threads);
  verb.add_option("--memory", flags->memory);
  verb.add_option("--tmp", flags->tmp);
  verb.add_flag("--fresh", flags->fresh);
  verb.add_flag("--plan", flags->plan);
  add_input_flags(verb, flags->input);
  verb.add_flag("--no-verify", flags->no_verify);
  verb.add_option("--json", flags->json);
  verb.add_option("--progress", flags->progress);
  verb.add_flag("--quiet", flags->quiet);
  verb.add_flag("--verbose", flags->verbose);
  verb.callback([flags, &run] { run = [flags] { return compress_rasters(*flags); }; });
}

}  // namespace tinsmith::cli
