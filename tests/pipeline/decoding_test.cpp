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
    creation.AddString("TILED=YES");
    if (is_sparse) creation.AddString("SPARSE_OK=TRUE");
    std::string file = path("flat" + std::to_string(width) + ".tif");
    const std::unique_ptr<GDALDataset> raster(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        file.c_str(), width, height, 1, GDT_Float32, creation.List()));
    if (!is_sparse) EXPECT_EQ(raster->GetRasterBand(1)->Fill(100), CE_None);
    return file;
  }

  // Times the size of the file.
  double read_by_compress(const std::string& file, int threads) const {
    CompressOptions options;
    options.max_error = 1;
    options.threads = threads;
    n_bytes_read = 0;
    compress({kCounted + file}, path("flat.ply"), {}, options);
    return static_cast<double>(n_bytes_read) / static_cast<double>(std::filesystem::file_size(file));
  }

  std::uint64_t cache_of(int width) const {
    const RasterField field({write_flat(width, 3000, true)}, {});
    return plan_memory(field, {192, 2, std::uint64_t{6} << 30, 0}).raster_cache;
  }
};

TEST_F(Decoding, TakesEveryBlockOnceWhereAllOfThemFit) {
  // The least of caches does not hold them all.
  const std::string file = write_flat(2049, 2049, false);
  for (const int threads : {1, 2}) {
    const double times = read_by_compress(file, threads);
    EXPECT_LE(times, 1.1) << threads;  // 0.1: the start of the file, each time that it is opened
    EXPECT_GE(times, 0.5) << threads;
  }
}

TEST_F(Decoding, TakesEveryBlockButTwiceWhereAFewRowsOfThemFit) {
  // The least of caches does not hold three rows of its windows.
  const std::string file = write_flat(10241, 1537, false);
  for (const int threads : {1, 2}) {
    const double times = read_by_compress(file, threads);
    EXPECT_LE(times, 2) << threads;  // once for the typical area of triangles, which knows no rows
    EXPECT_GE(times, 0.5) << threads;
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
