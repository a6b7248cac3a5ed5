#include "io/colour_raster.hpp"

#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_utils.h>
#include <gdalwarper.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include "io/raster_dataset.hpp"
#include "samples/grid_rect.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

// The height field's grid.
struct Target {
  GridFrame frame;
  std::int32_t width = 0;
  std::int32_t height = 0;
};

// What has to be known of the raster.
struct ColourSource {
  std::vector<int> bands;  // GDAL's numbers of the channels
  int alpha_band = 0;      // 0: none
  double levels_per_value = 1;
  GDALResampleAlg resampling = GRA_Bilinear;
};

// A dataset and what is made of it, closed in the reverse order.
struct Warped {
  GDALDatasetUniquePtr file;
  GDALDatasetUniquePtr expanded;  // when there is a palette
  GDALDatasetUniquePtr warped;    // the channels, then how much of each sample is covered

  GDALDataset& source() const { return expanded ? *expanded : *file; }
  ~Warped() {
    warped.reset();
    expanded.reset();
  }
  Warped() = default;
  Warped(Warped&&) = default;
  Warped& operator=(Warped&&) = delete;
};

GDALDatasetUniquePtr expand_palette(GDALDataset& file, const std::string& path) {
  if (file.GetRasterBand(1)->GetColorTable() == nullptr) return nullptr;
  CPLStringList arguments;
  for (const char* word : {"-of", "VRT", "-expand", "rgba"}) arguments.AddString(word);
  GDALTranslateOptions* options = GDALTranslateOptionsNew(arguments.List(), nullptr);
  GDALDatasetUniquePtr expanded(GDALDataset::FromHandle(GDALTranslate("", &file, options, nullptr)));
  GDALTranslateOptionsFree(options);
  if (expanded) return expanded;
  throw InputError(fmt::format("{}: its palette can't be read{}; see what gdalinfo says", path, gdal_reason()));
}

Warped open_source(const std::string& path) {
  Warped source;
  source.file = open_raster(path);
  const QuietGdal quiet;
  source.expanded = expand_palette(*source.file, path);
  return source;
}

// Where samples of the grid lie in the raster; and where the warp looks.
class Transformer {
 public:
  Transformer(GDALDataset& source, const Target& target, const std::string& path) {
    const bool has_both = source.GetSpatialRef() != nullptr && !target.frame.crs_wkt.empty();
    CPLStringList options;
    options.SetNameValue("SRC_METHOD", "GEOTRANSFORM");
    if (has_both) options.SetNameValue("DST_SRS", target.frame.crs_wkt.c_str());
    if (!has_both) options.SetNameValue("SRC_SRS", "");
    argument_ = GDALCreateGenImgProjTransformer2(&source, nullptr, options.List());
    if (argument_ == nullptr) {
      throw InputError(fmt::format(
          "{}: there is no way from its CRS to that of the terrain{}; warp it with gdalwarp", path, gdal_reason()));
    }
    GDALSetGenImgProjTransformerDstGeoTransform(argument_, target.frame.geotransform.data());
  }
  ~Transformer() {
    if (argument_ != nullptr) GDALDestroyGenImgProjTransformer(argument_);
  }
  Transformer(const Transformer&) = delete;
  Transformer& operator=(const Transformer&) = delete;

  // Columns and rows of the raster; none where there is no way.
  std::optional<std::array<double, 2>> to_source(double column, double row) const {
    double x = column;
    double y = row;
    double z = 0;
    int is_done = 0;
    if (GDALGenImgProjTransform(argument_, TRUE, 1, &x, &y, &z, &is_done) == 0 || is_done == 0) return std::nullopt;
    return std::array{x, y};
  }

  void* release() { return std::exchange(argument_, nullptr); }

 private:
  void* argument_;
};

// Looks at a net of samples: cells of the raster to a step of the grid, where they meet; none: nowhere.
std::optional<double> source_cells_per_step(GDALDataset& source, const Target& target,
                                            const Transformer& transformer) {
  constexpr int kNet = 64;
  double most = 0;
  for (int j = 0; j <= kNet; ++j) {
    for (int i = 0; i <= kNet; ++i) {
      const double column = static_cast<double>(target.width) * i / kNet;
      const double row = static_cast<double>(target.height) * j / kNet;
      const auto here = transformer.to_source(column, row);
      const auto there = transformer.to_source(column + 1, row + 1);
      if (!here || !there) continue;
      const auto [x, y] = *here;
      if (x < 0 || y < 0 || x > source.GetRasterXSize() || y > source.GetRasterYSize()) continue;
      most = std::max(most, std::hypot((*there)[0] - x, (*there)[1] - y) / std::sqrt(2.0));
    }
  }
  return most > 0 ? std::optional(most) : std::nullopt;
}

double full_scale(double largest) {
  for (const double scale : {1.0, 255.0, 1023.0, 2047.0, 4095.0, 8191.0, 16383.0, 32767.0, 65535.0}) {
    if (largest <= scale) return scale;
  }
  return largest;
}

double levels_per_value(GDALDataset& source, const ColourSource& colours, const std::string& path) {
  double largest = 0;
  const QuietGdal quiet;  // of bands without a value
  bool is_byte = true;
  for (const int b : colours.bands) {
    GDALRasterBand& band = *source.GetRasterBand(b);
    if (band.GetRasterDataType() == GDT_Byte) continue;
    is_byte = false;
    std::array<double, 2> range{};
    if (band.ComputeRasterMinMax(TRUE, range.data()) == CE_None) largest = std::max(largest, range[1]);
  }
  if (is_byte) return 1;
  if (std::isfinite(largest)) return 255 / full_scale(largest);
  throw InputError(fmt::format("{}: holds infinite values, not colours; see what gdalinfo -stats says", path));
}

ColourSource describe(GDALDataset& source, const std::string& path) {
  ColourSource colours;
  for (int b = 1; b <= source.GetRasterCount(); ++b) {
    GDALRasterBand& band = *source.GetRasterBand(b);
    if (band.GetColorInterpretation() == GCI_AlphaBand) {
      colours.alpha_band = b;
    } else {
      colours.bands.push_back(b);
    }
    if (GDALDataTypeIsComplex(band.GetRasterDataType()) == 0) continue;
    throw InputError(fmt::format("{}: band {} holds complex numbers, not colours; name another raster", path, b));
  }
  if (colours.bands.empty() || colours.bands.size() > kMaxChannels) {
    throw InputError(fmt::format("{}: has {} bands besides alpha, not 1 to {}; choose some with gdal_translate -b",
                                 path, colours.bands.size(), kMaxChannels));
  }
  std::array<double, 6> g{};
  if (source.GetGeoTransform(g.data()) != CE_None) {
    throw InputError(
        fmt::format("{}: has no geotransform, so nobody knows where its colours lie; place it with "
                    "gdal_edit.py -a_ullr or gdalwarp",
                    path));
  }
  colours.levels_per_value = levels_per_value(source, colours, path);
  return colours;
}

void set_nodata(GDALWarpOptions& options, GDALDataset& source, const ColourSource& colours) {
  std::vector<double> nodata;
  for (const int b : colours.bands) {
    int is_there = 0;
    const double value = source.GetRasterBand(b)->GetNoDataValue(&is_there);
    if (is_there != 0) nodata.push_back(value);
  }
  if (nodata.size() != colours.bands.size()) return;
  options.padfSrcNoDataReal = static_cast<double*>(CPLMalloc(nodata.size() * sizeof(double)));
  std::copy(nodata.begin(), nodata.end(), options.padfSrcNoDataReal);
  // A pixel is void where all of its bands are: 0, 0, 200 is blue, though 0 be nodata.
  options.papszWarpOptions = CSLSetNameValue(options.papszWarpOptions, "UNIFIED_SRC_NODATA", "YES");
}

using WarpOptions = std::unique_ptr<GDALWarpOptions, decltype(&GDALDestroyWarpOptions)>;

// The alpha of the result says where there are colours.
WarpOptions warp_options(GDALDataset& source, const ColourSource& colours, Transformer& transformer) {
  WarpOptions options(GDALCreateWarpOptions(), GDALDestroyWarpOptions);
  const auto n = static_cast<int>(colours.bands.size());
  options->hSrcDS = &source;
  options->eResampleAlg = colours.resampling;
  options->eWorkingDataType = GDT_Float32;
  options->nBandCount = n;
  options->panSrcBands = static_cast<int*>(CPLMalloc(colours.bands.size() * sizeof(int)));
  options->panDstBands = static_cast<int*>(CPLMalloc(colours.bands.size() * sizeof(int)));
  for (int i = 0; i < n; ++i) {
    options->panSrcBands[i] = colours.bands[static_cast<std::size_t>(i)];
    options->panDstBands[i] = i + 1;
  }
  options->nSrcAlphaBand = colours.alpha_band;
  options->nDstAlphaBand = n + 1;
  options->papszWarpOptions = CSLSetNameValue(options->papszWarpOptions, "INIT_DEST", "0");
  set_nodata(*options, source, colours);
  options->pfnTransformer = GDALGenImgProjTransform;
  options->pTransformerArg = transformer.release();
  return options;
}

// Warps block by block as it is read; GDAL's blocks are the same for all, so that each sample has one colour.
void warp(Warped& chain, const ColourSource& colours, const Target& target, const std::string& path) {
  const QuietGdal quiet;
  Transformer transformer(chain.source(), target, path);
  const WarpOptions options = warp_options(chain.source(), colours, transformer);
  std::array<double, 6> geotransform = target.frame.geotransform;
  chain.warped.reset(GDALDataset::FromHandle(
      GDALCreateWarpedVRT(&chain.source(), target.width, target.height, geotransform.data(), options.get())));
  if (chain.warped) return;
  throw InputError(
      fmt::format("{}: can't be warped onto the terrain{}; warp it with gdalwarp", path, gdal_reason()));
}

}  // namespace

struct ColourRaster::Impl {
  std::string path;
  Target target;
  ColourSource colours;
  bool has_crs = false;
  mutable std::mutex mutex;
  mutable std::vector<Warped> idle;  // a GDALDataset may serve one thread at a time

  Warped take() const {
    {
      const std::lock_guard lock(mutex);
      if (!idle.empty()) {
        Warped warped = std::move(idle.back());
        idle.pop_back();
        return warped;
      }
    }
    Warped chain = open_source(path);
    warp(chain, colours, target, path);
    return chain;
  }

  std::vector<float> read_band(GDALDataset& dataset, int band, const GridRect& rect) const {
    const QuietGdal quiet;
    std::vector<float> values(static_cast<std::size_t>(rect.area()));
    const CPLErr status =
        dataset.GetRasterBand(band)->RasterIO(GF_Read, rect.x0, rect.y0, rect.width, rect.height, values.data(),
                                              rect.width, rect.height, GDT_Float32, 0, 0, nullptr);
    if (status == CE_None && CPLGetLastErrorType() < CE_Failure) return values;
    throw InputError(
        fmt::format("{}: the colours of the terrain's columns {} to {}, rows {} to {} can't be read{}; "
                    "the file seems damaged or cut short, get it again",
                    path, rect.x0, rect.x0 + rect.width - 1, rect.y0, rect.y0 + rect.height - 1, gdal_reason()));
  }
};

ColourRaster::ColourRaster(const std::string& path, const GridFrame& frame, std::int32_t width, std::int32_t height)
    : impl_(std::make_unique<Impl>()) {
  impl_->path = path;
  impl_->target = {frame, width, height};
  Warped chain = open_source(path);
  impl_->colours = describe(chain.source(), path);
  impl_->has_crs = chain.source().GetSpatialRef() != nullptr;
  {
    const QuietGdal quiet;
    const Transformer transformer(chain.source(), impl_->target, path);
    const auto cells = source_cells_per_step(chain.source(), impl_->target, transformer);
    if (!cells) {
      throw InputError(
          fmt::format("{}: has no colours where the terrain lies; check the CRS and extent of both with "
                      "gdalinfo",
                      path));
    }
    constexpr double kAlike = 1.1;
    if (*cells > kAlike) impl_->colours.resampling = GRA_Average;
  }
  warp(chain, impl_->colours, impl_->target, path);
  impl_->idle.push_back(std::move(chain));
}

ColourRaster::~ColourRaster() {
  const QuietGdal quiet;
  impl_->idle.clear();
}

std::optional<std::string> ColourRaster::remark() const {
  const bool has_terrain_crs = !impl_->target.frame.crs_wkt.empty();
  if (impl_->has_crs == has_terrain_crs) return std::nullopt;
  return impl_->has_crs
             ? fmt::format("{}: the terrain has no CRS; its coordinates are taken to be those of the colours",
                           impl_->path)
             : fmt::format("{}: has no CRS; its coordinates are taken to be those of the terrain", impl_->path);
}

int ColourRaster::n_channels() const { return static_cast<int>(impl_->colours.bands.size()); }

ColourGrid ColourRaster::read(const GridRect& rect) const {
  ColourGrid grid{rect, std::vector<HeightGrid>(impl_->colours.bands.size(), void_grid(rect))};
  const GridRect inside = intersection(rect, {0, 0, impl_->target.width, impl_->target.height});
  if (is_empty(inside)) return grid;
  Warped chain = impl_->take();
  const int n = n_channels();
  const std::vector<float> cover = impl_->read_band(*chain.warped, n + 1, inside);
  for (int c = 0; c < n; ++c) {
    const std::vector<float> values = impl_->read_band(*chain.warped, c + 1, inside);
    std::vector<double>& levels = grid.channels[static_cast<std::size_t>(c)].z;
    std::size_t from = 0;
    for (std::int32_t y = inside.y0; y < inside.y0 + inside.height; ++y) {
      for (std::int32_t x = inside.x0; x < inside.x0 + inside.width; ++x, ++from) {
        if (!(cover[from] > 0) || std::isnan(values[from])) continue;
        const std::int64_t to = static_cast<std::int64_t>(y - rect.y0) * rect.width + (x - rect.x0);
        levels[static_cast<std::size_t>(to)] =
            std::clamp(values[from] * impl_->colours.levels_per_value, 0.0, 255.0);
      }
    }
  }
  const std::lock_guard lock(impl_->mutex);
  impl_->idle.push_back(std::move(chain));
  return grid;
}

}  // namespace tinsmith
