// tinsmith simplify: any triangle mesh in, the same surface with fewer triangles out.

#include "tinsmith/simplify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>

#include "choose.hpp"
#include "edge_list.hpp"
#include "inputs.hpp"
#include "progress_bar.hpp"
#include "report.hpp"
#include "simplify_summary.hpp"
#include "text.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/progressive.hpp"
#include "tinsmith/version.hpp"
#include "verbs.hpp"

namespace tinsmith::cli {
namespace {

constexpr const char* kManual = R"(tinsmith simplify: any triangle mesh with fewer triangles, by edge collapse.

usage: tinsmith simplify MESH OUTPUT [options]
       tinsmith simplify MESH.tspm OUTPUT [--triangles N]   restores a progressive mesh, in full or at most so fine

MESH and OUTPUT are .ply, .obj, .stl or .glb; OUTPUT's format is that of its extension. Colours, normals and other
values at the vertices are simplified together with the shape (.stl holds none; .obj and .glb hold colours and normals
only). Borders and features are simplified along themselves; corners, where they meet or turn sharply, stay. What is
wrong with the input (triangles that are there twice or face against their neighbours, edges with more than two
triangles, ...) is counted, mended where that loses nothing, else cut apart there and locked in its place.

when to stop, at the first that is reached; without any, when no edge can be collapsed:
  --triangles N          at most N triangles
  --ratio R              the same as a fraction of the input's triangles, above 0, at most 1
  --max-cost C           no collapse that costs more: mean squared distance, in square units of the mesh; 0 or more

options:
  --placement P          where a vertex may lie: optimal (anywhere), segment (on the collapsed edge) or subset
                         (every vertex is one of the input) (default optimal)
  --no-area-weights      all triangles count the same; otherwise by their area and twice the mean area, so that thin
                         parts made of small triangles stay
  --no-half-space        let triangles turn over (faster, and wrong; to see what the test prevents)
  --no-fit               leave out the last step of optimal placement, which moves the vertices that are left, and
                         their values, to where they fit the input's vertices best, flips edges to that end, and
                         gives the places that are farthest from the input vertices of their own
  --quadric Q            how shape and values at the vertices make up the cost: separate (a quadric each, as in the
                         paper), combined (one in six dimensions: the shape and the colour, or the normals of a mesh
                         without; other values follow and cost nothing) or gradient (values as linear functions of
                         the place) (default {})
  --attribute-weight A   how much the values at the vertices count beside the shape, whose largest extent is 1; 0: they
                         follow (default: 1 for separate, 3e-7 for combined; gradient: the more, the fewer triangles
                         are to be left and the rougher the shape is, 3e-7 when their number is open)
  --crease D             edges whose triangles meet at more than D degrees are features; 0 to 180 (default: none)
  --no-seams             edges along which colours or normals differ are no features
  --feature-edges FILE   more features: text, one edge a line as two vertex numbers of the input, from 0 in the order
                         of the file (.stl: in which the places first come); what follows # is a comment
  --drop-attributes      the shape only: without colours, normals, other values, and seams
  --progressive FILE     also write a progressive mesh (.tspm): every resolution between OUTPUT's and the input's can
                         be restored from it; takes --placement subset
  --json FILE            the report as one JSON object; - prints it to standard output and nothing else
  --quiet                no progress bar, no remarks
  --verbose              every number of the report

The bytes written depend on the input and options only.

examples:
  tinsmith simplify scan.ply small.ply --ratio 0.05
  tinsmith simplify part.stl part.glb --triangles 20000 --crease 40
  tinsmith simplify scan.ply scan_1mm.ply --max-cost 1e-6 --json report.json
  tinsmith simplify scan.ply base.ply --ratio 0.01 --progressive scan.tspm
  tinsmith simplify scan.tspm half.ply --triangles 100000

exit codes: 0 done; 2 wrong usage; 3 an input can't be used; 4 an output can't be written; 5 memory or the format
does not suffice; 130 interrupted. Unless the exit code is 0, what stood at OUTPUT before still stands there.
)";

const std::map<std::string, QuadricForm>& quadrics() {
  static const std::map<std::string, QuadricForm> quadrics_by_word{{"separate", QuadricForm::kSeparate},
                                                                   {"combined", QuadricForm::kCombined},
                                                                   {"gradient", QuadricForm::kGradient}};
  return quadrics_by_word;
}

std::string word_of(QuadricForm form) {
  for (const auto& [word, known] : quadrics())
    if (known == form) return word;
  return "";
}

struct Flags {
  std::string mesh;
  std::string output;
  SimplifySurfaceOptions options;  // what needs no words
  std::string placement;           // empty: optimal, and subset for a progressive mesh
  std::string quadric = word_of(SimplifySurfaceOptions().quadric);
  std::optional<double> attribute_weight;
  bool no_area_weights = false;
  bool no_half_space = false;
  bool no_fit = false;
  bool no_seams = false;
  std::string feature_edges;
  bool drop_attributes = false;
  std::string progressive;
  std::string json;
  bool quiet = false;
  bool verbose = false;
};

/// Written in words as the option's manual has them; NaN is never in range.
void require_that(bool is_in_range, const char* option, double value, const char* range) {
  if (!is_in_range) throw UsageError(fmt::format("{} {}: must be {}", option, value, range));
}

void require_ranges(const Flags& flags) {
  const SimplifySurfaceOptions& o = flags.options;
  if (o.triangles)
    require_that(*o.triangles >= 0 && std::isfinite(*o.triangles) && *o.triangles == std::floor(*o.triangles),
                 "--triangles", *o.triangles, "a whole number, 0 or more");
  if (o.ratio) require_that(*o.ratio > 0 && *o.ratio <= 1, "--ratio", *o.ratio, "above 0 and at most 1");
  if (o.max_cost)
    require_that(*o.max_cost >= 0 && std::isfinite(*o.max_cost), "--max-cost", *o.max_cost, "0 or more");
  if (o.crease) require_that(*o.crease >= 0 && *o.crease <= 180, "--crease", *o.crease, "0 to 180 degrees");
  const double weight = flags.attribute_weight.value_or(0);
  require_that(weight >= 0 && std::isfinite(weight), "--attribute-weight", weight, "0 or more");
}

void require_agreement(const Flags& flags) {
  if (flags.drop_attributes && flags.attribute_weight)
    throw UsageError("simplify: --attribute-weight weighs what --drop-attributes drops; give only one of them");
  if (!flags.progressive.empty() && !flags.placement.empty() && flags.placement != "subset")
    throw UsageError(fmt::format(
        "simplify: --progressive needs --placement subset: a split brings a vertex of the input back; leave out "
        "--placement {}",
        flags.placement));
}

SimplifySurfaceOptions to_options(const Flags& flags) {
  require_ranges(flags);
  require_agreement(flags);
  SimplifySurfaceOptions options = flags.options;
  if (!flags.placement.empty()) options.placement = choose_placement(flags.placement);
  options.quadric = choose("--quadric", flags.quadric, quadrics());
  options.area_weights = !flags.no_area_weights;
  options.half_space = !flags.no_half_space;
  options.fit = !flags.no_fit;
  options.keep_seams = !flags.no_seams && !flags.drop_attributes;  // without values, nothing differs along a seam
  if (flags.attribute_weight) options.attribute_weight = *flags.attribute_weight;
  return options;
}

std::string extension_of(const std::string& path) {
  std::string text = std::filesystem::path(path).extension().string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

void require_surface_extension(const std::string& path) {
  for (const char* known : {".ply", ".obj", ".stl", ".glb"})
    if (extension_of(path) == known) return;
  throw UsageError(
      fmt::format("{}: '{}' is no extension of a surface; use .ply, .obj, .stl or .glb", path, extension_of(path)));
}

bool is_progressive(const std::string& path) { return extension_of(path) == ".tspm"; }

void require_usable_progressive(const Flags& flags) {
  if (flags.progressive.empty()) return;
  if (!is_progressive(flags.progressive))
    throw UsageError(fmt::format("--progressive {}: the extension must be .tspm", flags.progressive));
  require_writable(flags.progressive);
}

// All that can be found wrong with the outputs before the work.
void require_usable_outputs(const Flags& flags) {
  std::vector<std::string> inputs{flags.mesh};
  if (!flags.feature_edges.empty()) inputs.push_back(flags.feature_edges);
  require_surface_extension(flags.output);
  require_apart({flags.output, flags.progressive, flags.json}, inputs);
  require_writable(flags.output);
  require_usable_progressive(flags);
  if (!flags.json.empty() && flags.json != "-") require_writable(flags.json);
}

/// What the format of the output can't hold of the surface.
std::vector<std::string> remarks_on(const Surface& surface, const std::string& output) {
  const std::string extension = extension_of(output);
  const char* const advice = "left out; --drop-attributes leaves them out of the cost too";
  if (extension == ".stl" && !surface.attributes.empty())
    return {fmt::format("{}: .stl holds no colours, normals or other values; they are {}", output, advice)};
  if ((extension == ".obj" || extension == ".glb") && surface.find(AttributeKind::kScalar) != nullptr)
    return {fmt::format("{}: {} holds colours and normals only; other values are {}", output, extension, advice)};
  return {};
}

/// Combined quadrics weigh the first colour or normal only.
std::vector<std::string> remarks_on_weights(const Surface& surface, const SimplifySurfaceOptions& options) {
  const auto is_wide = [](const SurfaceAttribute& attribute) { return attribute.kind != AttributeKind::kScalar; };
  const bool has_wide = std::any_of(surface.attributes.begin(), surface.attributes.end(), is_wide);
  if (options.quadric != QuadricForm::kCombined || surface.attributes.size() <= (has_wide ? 1U : 0U)) return {};
  return {
      fmt::format("--quadric combined: {} of the {} kinds of values at the vertices counts, the others follow; "
                  "--quadric gradient and separate weigh all",
                  has_wide ? "one" : "none", surface.attributes.size())};
}

const char* word_of(SimplifyStop stop) {
  if (stop == SimplifyStop::kNoCandidates) return "no candidates";
  return stop == SimplifyStop::kTriangles ? "triangles" : "cost";
}

/// More triangles than asked for, as a number or as a ratio of the input's.
std::vector<std::string> remarks_on_size(const Flags& flags, const Surface& result, double n_input,
                                         const char* why) {
  const auto n_triangles = static_cast<double>(result.triangles.size());
  const double asked = std::max(flags.options.triangles.value_or(0), flags.options.ratio.value_or(0) * n_input);
  if (asked == 0 || n_triangles <= asked) return {};
  return {fmt::format("{}: {} triangles, not the {:.0f} asked for: {}", flags.output, result.triangles.size(),
                      std::floor(asked), why)};
}

Json report_of(const Flags& flags, const SimplifySurfaceReport& simplified, const Surface& result) {
  Json report;
  report["input"] = flags.mesh;
  report["output"] = flags.output;
  report["input_vertices"] = simplified.input_vertices;
  report["input_triangles"] = simplified.input_triangles;
  report["vertices"] = result.position.size();
  report["triangles"] = result.triangles.size();
  report["components"] = simplified.components;
  report["border_edges"] = simplified.border_edges;
  report["feature_edges"] = simplified.feature_edges;
  report["collapses"] = simplified.collapses;
  report["refused_topology"] = simplified.refused_topology;
  report["refused_half_space"] = simplified.refused_half_space;
  report["last_cost"] = simplified.last_cost;
  add_defects(report, simplified.defects);
  const Resources used = resources_so_far();
  report["seconds"] = used.seconds;
  report["peak_memory_bytes"] = used.peak_memory_bytes;
  report["bytes"] = std::filesystem::file_size(flags.output);
  report["version"] = version();
  return report;
}

int restore_mesh(const Flags& flags) {
  const SimplifySurfaceOptions& o = flags.options;
  if (o.ratio || o.max_cost || o.crease || !flags.progressive.empty())
    throw UsageError(fmt::format(
        "{}: a progressive mesh is restored, not simplified; give --triangles N or nothing", flags.mesh));
  require_ranges(flags);
  require_usable_outputs(flags);
  const double triangles = o.triangles.value_or(std::numeric_limits<double>::infinity());
  const Surface result = restore(read_progressive(flags.mesh, triangles), triangles);
  print_remarks(remarks_on(result, flags.output), flags.quiet);
  write_surface(flags.output, result);
  print_remarks(remarks_on_size(flags, result, 0, "the progressive mesh begins with so many"), flags.quiet);
  const Json report = report_of(flags, {}, result);
  if (!flags.json.empty()) write_json(report, flags.json);
  if (flags.json != "-")
    fmt::print("{}: {} triangles, {} vertices\n", flags.output, result.triangles.size(), result.position.size());
  return 0;
}

// And keeps how it was done, if asked for.
Surface simplified_surface(const Surface& surface, const SimplifySurfaceOptions& options, const Flags& flags,
                           SimplifySurfaceReport& report) try {
  if (flags.progressive.empty()) return simplify_surface(surface, options, report);
  const ProgressiveSurface progressive = make_progressive(surface, options, report);
  write_progressive(flags.progressive, progressive);
  return restore(progressive, 0);
} catch (const InputError& error) {
  throw InputError(fmt::format("{}: {}", flags.mesh, error.what()));
}

int simplify_mesh(const Flags& flags) {
  if (is_progressive(flags.mesh)) return restore_mesh(flags);
  SimplifySurfaceOptions options = to_options(flags);
  require_usable_outputs(flags);
  Surface surface = read_surface(flags.mesh);
  if (!flags.feature_edges.empty())
    options.feature_edges = read_edge_list(flags.feature_edges, surface.position.size());
  if (flags.drop_attributes) surface.attributes.clear();
  print_remarks(remarks_on(surface, flags.output), flags.quiet);
  print_remarks(remarks_on_weights(surface, options), flags.quiet);
  options.progress = make_progress(choose_progress("bar", flags.quiet), 0);
  SimplifySurfaceReport simplified;
  const double start = resources_so_far().seconds;
  const Surface result = simplified_surface(surface, options, flags, simplified);
  const double end = resources_so_far().seconds;
  options.progress = {};  // ends the line of the bar
  write_surface(flags.output, result);
  if (simplified.stopped_by == SimplifyStop::kNoCandidates)
    print_remarks(remarks_on_size(flags, result, static_cast<double>(simplified.input_triangles),
                                  "no edge is left that can be collapsed; features and borders hold many: see "
                                  "--crease, --no-seams, --feature-edges"),
                  flags.quiet);
  Json report = report_of(flags, simplified, result);
  report["simplify_seconds"] = end - start;
  report["stopped_by"] = word_of(simplified.stopped_by);
  if (!flags.json.empty()) write_json(report, flags.json);
  if (flags.json != "-") print_simplify_summary(report, flags.verbose);
  return 0;
}

}  // namespace

void add_simplify(CLI::App& program, Run& run) {
  CLI::App& verb = *program.add_subcommand("simplify");
  auto flags = std::make_shared<Flags>();
  set_manual(verb, fmt::format(kManual, flags->quadric));
  verb.add_option("MESH", flags->mesh)->required();
  verb.add_option("OUTPUT", flags->output)->required();
  verb.add_option("--triangles", flags->options.triangles);
  verb.add_option("--ratio", flags->options.ratio);
  verb.add_option("--max-cost", flags->options.max_cost);
  verb.add_option("--placement", flags->placement);
  verb.add_flag("--no-area-weights", flags->no_area_weights);
  verb.add_flag("--no-half-space", flags->no_half_space);
  verb.add_flag("--no-fit", flags->no_fit);
  verb.add_option("--quadric", flags->quadric);
  verb.add_option("--progressive", flags->progressive);
  verb.add_option("--attribute-weight", flags->attribute_weight);
  verb.add_option("--crease", flags->options.crease);
  verb.add_flag("--no-seams", flags->no_seams);
  verb.add_option("--feature-edges", flags->feature_edges);
  verb.add_flag("--drop-attributes", flags->drop_attributes);
  verb.add_option("--json", flags->json);
  verb.add_flag("--quiet", flags->quiet);
  verb.add_flag("--verbose", flags->verbose);
  verb.callback([flags, &run] { run = [flags] { return simplify_mesh(*flags); }; });
}

}  // namespace tinsmith::cli
