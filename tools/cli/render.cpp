// tinsmith render: pictures of terrain and of meshes.

#include "tinsmith/render.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <memory>

#include "input_flags.hpp"
#include "inputs.hpp"
#include "io/mesh_file.hpp"
#include "progress_bar.hpp"
#include "report.hpp"
#include "text.hpp"
#include "tinsmith/error.hpp"
#include "verbs.hpp"

namespace tinsmith::cli {
namespace {

constexpr const char* kManual = R"(tinsmith render: draws terrain and meshes as a PNG.

usage: tinsmith render INPUT... OUT.png
       tinsmith render MESH OUT.png
       tinsmith render INPUT... MESH OUT.png      (INPUT and MESH in any order)

Draws panels side by side, north up, each with a caption:
  hillshade   of the samples, or of the mesh when no raster is given: sun in the north-west, 45 degrees high,
              over a tint by height, or over the mesh's colours if it has some; flat land is exaggerated
  wireframe   the edges of the mesh over the hillshade, outlines in red
  error       z_TIN - z_sample in metres from blue (the mesh is too low) to red (too high), with a legend; each
              pixel shows the largest error under it
Voids are grey.

options:
  --panels A,B,...     which, from left to right (default: all that the arguments allow)
  --width PIXELS       of one panel, 16 to 16384 (default 800); the height follows from the ground
  --scale M            metres at the ends of the error scale (default: the largest error)
)" TINSMITH_INPUT_MANUAL
                                R"(  --quiet              no progress bar

examples:
  tinsmith render dem.tif dem.png
  tinsmith render dem.tif dem.ply dem.png --panels wireframe,error --scale 10
  tinsmith render dem.glb dem.png --width 2000 --bbox 7.6 45.9 7.8 46.05

exit codes: 0 done; 2 wrong usage; 3 an input can't be used; 4 the picture can't be written; 5 out of memory or
the picture is too large; 130 interrupted
)";

struct Flags {
  std::vector<std::string> files;
  std::vector<std::string> panels;
  int width = RenderOptions().panel_width;
  std::optional<double> scale;
  InputFlags input;
  bool quiet = false;
};

std::vector<Panel> to_panels(const std::vector<std::string>& names) {
  static const std::map<std::string, Panel> panels_by_name{
      {"hillshade", Panel::kHillshade}, {"wireframe", Panel::kWireframe}, {"error", Panel::kError}};
  std::vector<Panel> panels;
  for (const std::string& name : names) {
    const auto panel = panels_by_name.find(name);
    if (panel == panels_by_name.end())
      throw UsageError(fmt::format("--panels {}: no such panel; there are hillshade, wireframe and error", name));
    panels.push_back(panel->second);
  }
  return panels;
}

int draw(Flags flags) {
  const std::string png = flags.files.back();
  flags.files.pop_back();
  require_apart({png}, files_read(flags.files));
  std::vector<std::string> rasters;
  std::string mesh;
  for (const std::string& file : flags.files) {
    if (!is_mesh_path(file)) {
      rasters.push_back(file);
    } else if (mesh.empty()) {
      mesh = file;
    } else {
      throw UsageError(fmt::format("{}: a second mesh; draw one mesh at a time", file));
    }
  }
  RenderOptions options;
  options.panels = to_panels(flags.panels);
  options.panel_width = flags.width;
  options.scale = flags.scale;
  options.input = to_input_options(flags.input);
  options.progress = make_progress(choose_progress("bar", flags.quiet), 0);
  render(rasters, mesh, png, options);
  return 0;
}

}  // namespace

void add_render(CLI::App& program, Run& run) {
  CLI::App& verb = *program.add_subcommand("render");
  set_manual(verb, kManual);
  auto flags = std::make_shared<Flags>();
  verb.add_option("INPUT... MESH OUT.png", flags->files)
      ->required()
      ->expected(2, CLI::detail::expected_max_vector_size);
  verb.add_option("--panels", flags->panels)->delimiter(',')->allow_extra_args(false);
  verb.add_option("--width", flags->width);
  verb.add_option("--scale", flags->scale);
  add_input_flags(verb, flags->input);
  verb.add_flag("--quiet", flags->quiet);
  verb.callback([flags, &run] { run = [flags] { return draw(*flags); }; });
}

}  // namespace tinsmith::cli
