#include "tinsmith/render.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "geodesy/crs.hpp"
#include "io/mesh_file.hpp"
#include "io/output_file.hpp"
#include "io/raster_field.hpp"
#include "render/page.hpp"
#include "render/panels.hpp"
#include "render/pixel_grid.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr int kNarrowest = 16;
constexpr int kWidest = 16384;

// What there is to draw, and the ground that it lies on.
struct Scene {
  std::unique_ptr<RasterField> field;  // empty: no raster
  std::optional<Tin> tin;
  std::vector<Levels> colours;  // of the mesh's vertices; empty: it has none, or a raster is drawn
  GridFrame frame;              // of the raster, else made for the mesh
  View view;
  std::vector<Panel> panels;
};

void require_sensible(const std::vector<std::string>& raster, const std::string& mesh, const std::string& png,
                      const RenderOptions& options) {
  if (raster.empty() && mesh.empty()) throw UsageError("render: nothing to draw; name a raster, a mesh or both");
  std::string extension = std::filesystem::path(png).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension != ".png")
    throw UsageError(fmt::format("render: {}: pictures are PNG; let the name end in .png", png));
  if (options.panel_width < kNarrowest || options.panel_width > kWidest)
    throw UsageError(fmt::format("render: a panel can't be {} pixels wide; use {} to {}", options.panel_width,
                                 kNarrowest, kWidest));
  if (options.scale && !(*options.scale > 0 && std::isfinite(*options.scale)))
    throw UsageError(
        fmt::format("render: the error scale can't end at {} m; use a number above 0", *options.scale));
}

std::vector<Panel> panels_for(const std::vector<Panel>& wanted, bool has_raster, bool has_mesh) {
  if (wanted.empty()) {
    if (!has_mesh) return {Panel::kHillshade};
    if (!has_raster) return {Panel::kHillshade, Panel::kWireframe};
    return {Panel::kHillshade, Panel::kWireframe, Panel::kError};
  }
  for (const Panel panel : wanted) {
    if (panel == Panel::kWireframe && !has_mesh)
      throw UsageError("render: a wireframe needs a mesh; name one or leave the wireframe out of the panels");
    if (panel == Panel::kError && !(has_mesh && has_raster))
      throw UsageError("render: an error map needs a mesh and its raster; name both or leave it out of the panels");
  }
  return wanted;
}

Extent extent_of(const Tin& tin) {
  Extent e = no_extent();
  for (const auto& v : tin.vertices) e = grown(e, {v[0], v[1]});
  return e;
}

Extent crop(const Extent& e, const std::optional<std::array<double, 4>>& bbox) {
  if (!bbox) return e;
  return {std::max(e[0], (*bbox)[0]), std::max(e[1], (*bbox)[1]), std::min(e[2], (*bbox)[2]),
          std::min(e[3], (*bbox)[3])};
}

// A grid of one CRS unit per step: all that a picture asks of a frame is metres per unit.
GridFrame frame_of(const Tin& tin, const std::string& path, const InputOptions& options) {
  const CrsUnits units = crs_units(tin.crs_wkt, path);
  GridFrame frame;
  frame.geotransform = {0, 1, 0, 0, 0, -1};
  frame.crs_wkt = tin.crs_wkt;
  frame.is_geographic = units.is_geographic;
  frame.metres_per_horizontal_unit = units.metres_per_horizontal_unit;
  frame.radians_per_unit = units.radians_per_unit;
  frame.equatorial_radius = units.equatorial_radius;
  frame.flattening = units.flattening;
  frame.metres_per_vertical_unit = metres_per_height(tin, units, options);
  return frame;
}

Scene make_scene(const std::vector<std::string>& raster, const std::string& mesh, const RenderOptions& options) {
  Scene scene;
  scene.panels = panels_for(options.panels, !raster.empty(), !mesh.empty());
  if (!mesh.empty()) scene.tin = read_mesh(mesh, raster.empty() ? &scene.colours : nullptr);
  Extent extent;
  if (!raster.empty()) {
    scene.field = std::make_unique<RasterField>(raster, options.input);
    scene.frame = scene.field->frame();
    extent = grid_extent(scene.frame, scene.field->width(), scene.field->height());
  } else {
    scene.frame = frame_of(*scene.tin, mesh, options.input);
    extent = crop(extent_of(*scene.tin), options.input.bbox);
  }
  if (!(extent[0] < extent[2] && extent[1] < extent[3]))
    throw InputError(fmt::format("{}: nothing to draw there; the mesh has no area within the bbox", mesh));
  scene.view = make_view(scene.frame, extent, options.panel_width);
  return scene;
}

// What the relief is drawn from.
struct Ground {
  PixelGrid heights;
  std::optional<PixelColours> colours;
};

// Of the samples, or of the mesh when there are none, in the stages from the first on.
Ground make_ground(const Scene& scene, Stage stage) {
  if (scene.field) return {sample_heights(scene.view, *scene.field, stage), std::nullopt};
  Ground ground{mesh_heights(scene.view, *scene.tin, scene.frame.metres_per_vertical_unit, stage), std::nullopt};
  ++stage.number;
  if (!scene.colours.empty()) ground.colours = mesh_colours(scene.view, *scene.tin, scene.colours, stage);
  return ground;
}

// "176 to 4487 m"
std::string height_range(const PixelGrid& heights) {
  if (heights.lowest > heights.highest) return "no heights";
  const int decimals = heights.highest - heights.lowest < 10 ? 2 : 0;
  return fmt::format("{:.{}f} to {:.{}f} m", heights.lowest, decimals, heights.highest, decimals);
}

// 1234567 as "1 234 567".
std::string grouped(std::size_t number) {
  std::string digits = std::to_string(number);
  for (auto i = static_cast<std::ptrdiff_t>(digits.size()) - 3; i > 0; i -= 3)
    digits.insert(static_cast<std::size_t>(i), 1, ' ');
  return digits;
}

CaptionedPanel hillshade_panel(const Scene& scene, const Ground& ground) {
  const std::string what =
      scene.field ? fmt::format("{} x {} samples", grouped(scene.field->width()), grouped(scene.field->height()))
                  : fmt::format("{} triangles", grouped(scene.tin->triangles.size()));
  return {draw_hillshade(scene.view, scene.frame, ground.heights, ground.colours), scene.field ? "Samples" : "TIN",
          fmt::format("{}, {}", what, height_range(ground.heights)), std::nullopt,
          metres_per_pixel(scene.view, scene.frame, scene.view.height / 2)[0]};
}

CaptionedPanel wireframe_panel(const Scene& scene, const Ground& ground) {
  CaptionedPanel panel{draw_hillshade(scene.view, scene.frame, ground.heights, ground.colours), "TIN, wireframe",
                       fmt::format("{} triangles, {} vertices", grouped(scene.tin->triangles.size()),
                                   grouped(scene.tin->vertices.size())),
                       std::nullopt, std::nullopt};
  draw_wireframe(panel.picture, scene.view, *scene.tin);
  return panel;
}

CaptionedPanel error_panel(const PixelGrid& errors, std::optional<double> scale) {
  double largest = 0;
  for (const double e : errors.value)
    if (!std::isnan(e)) largest = std::max(largest, std::abs(e));
  // Without any error the scale still needs a width: a millimetre.
  const double ends = scale.value_or(std::max(largest, 1e-3));
  return {draw_errors(errors, ends), "Error", fmt::format("z_TIN - z_sample, largest {:.4g} m", largest), ends,
          std::nullopt};
}

}  // namespace

void render(const std::vector<std::string>& raster, const std::string& mesh, const std::string& png,
            const RenderOptions& options) {
  require_sensible(raster, mesh, png, options);
  const OutputFile probe(png);  // a folder that can't be written is found before the work, not after it
  const Scene scene = make_scene(raster, mesh, options);
  const bool has_error = std::count(scene.panels.begin(), scene.panels.end(), Panel::kError) > 0;
  const int n_stages = has_error || !scene.colours.empty() ? 2 : 1;
  const Ground ground = make_ground(scene, {&options.progress, 0, n_stages});
  std::vector<CaptionedPanel> drawn;
  for (const Panel panel : scene.panels) {
    switch (panel) {
      case Panel::kHillshade:
        drawn.push_back(hillshade_panel(scene, ground));
        break;
      case Panel::kWireframe:
        drawn.push_back(wireframe_panel(scene, ground));
        break;
      case Panel::kError:
        drawn.push_back(error_panel(
            largest_errors(scene.view, *scene.field, *scene.tin, {&options.progress, 1, n_stages}), options.scale));
        break;
    }
  }
  write_png(lay_out_page(drawn), png);
}

}  // namespace tinsmith
