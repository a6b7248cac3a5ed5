// Rasters come in compressed blocks, and decoding them may take longer than all else.

#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>

#include "io/raster_fixture.hpp"
#include "pipeline/memory_plan.hpp"
#include "tinsmith/compress.hpp"

namespace tinsmith {
namespace {

std::atomic<std::uint64_t> n_bytes_read = 0;

/// Files below it are those of the path that follows, and what is read of them is counted.
constexpr const char* kCounted = "/vsicounted/";

void install_counted_files() {
  VSIFilesystemPluginCallbacksStruct* calls = VSIAllocFilesystemPluginCallbacksStruct();
  calls->stat = [](void*, const char* path, VSIStatBufL* found, int flags) {
    return VSIStatExL(path, found, flags);
  };
  calls->open = [](void*, const char* path, const char* access) -> void* { return VSIFOpenL(path, access); };
  calls->tell = [](void* file) { return VSIFTellL(static_cast<VSILFILE*>(file)); };
  calls->seek = [](void* file, vsi_l_offset offset, int whence) {
    return VSIFSeekL(static_cast<VSILFILE*>(file), offset, whence);
  };
  calls->read = [](void* file, void* buffer, std::size_t size, std::size_t count) {
    n_bytes_read += size * count;
    return VSIFReadL(buffer, size, count, static_cast<VSILFILE*>(file));
  };
  calls->eof = [](void* file) { return VSIFEofL(static_cast<VSILFILE*>(file)); };
  calls->close = [](void* file) { return VSIFCloseL(static_cast<VSILFILE*>(file)); };
  ASSERT_EQ(VSIInstallPluginHandler(kCounted, calls), 0);
  VSIFreeFilesystemPluginCallbacksStruct(calls);
}

class Decoding : public RasterTest {
 protected:
  static void SetUpTestSuite() { install_counted_files(); }

  // Flat, in tiles of 256 x 256; sparse: without any that is written, all void.
  std::string write_flat(int width, int height, bool is_sparse) const {
    CPLStringList creation;
    for (const char* option : {"TILED=YES", "COMPRESS=DEFLATE"}) creation.AddString(option);
    if (is_sparse) creation.AddString("SPARSE_OK=TRUE");
    std::string file = path("flat" + std::to_string(width) + ".tif");
    const std::unique_ptr<GDALDataset> raster(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        file.c_str(), width, height, 1, GDT_Float32, creation.List()));
    if (!is_sparse) EXPECT_EQ(raster->GetRasterBand(1)->Fill(100), CE_None);
    return file;
  }

  std::uint64_t cache_of(int width) const {
    const RasterField field({write_flat(width, 3000, true)}, {});
    return plan_memory(field, {192, 2, std::uint64_t{6} << 30, 0}).raster_cache;
  }
};

TEST_F(Decoding, TakesEveryBlockButTwiceWhereAFewRowsOfThemFit) {
  // The least of caches does not hold three rows of its windows.
  const std::string file = write_flat(10241, 1281, false);
  CompressOptions options;
  options.max_error = 1;
  for (const int threads : {1, 2}) {
    options.threads = threads;
    n_bytes_read = 0;
    compress({kCounted + file}, path("wide.ply"), {}, options);
    // Once for the typical area of triangles, which knows no rows.
    EXPECT_LE(n_bytes_read, 2 * std::filesystem::file_size(file)) << threads;
    EXPECT_GE(n_bytes_read, std::filesystem::file_size(file) / 2) << threads;
  }
}

TEST_F(Decoding, TakesMemoryForWholeRowsButNoMoreForEverWiderOnes) {
  constexpr std::uint64_t kMega = 1 << 20;
  EXPECT_GE(cache_of(10000), std::uint64_t{5} * 192 * 10000 * 4);
  EXPECT_LE(cache_of(10000), 64 * kMega);
  EXPECT_LE(cache_of(20000), 64 * kMega);
  EXPECT_LE(cache_of(300000), 64 * kMega);
}

}  // namespace
}  // namespace tinsmith
