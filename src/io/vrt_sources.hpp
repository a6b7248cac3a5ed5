#pragma once
// The files that a VRT takes its values from.

#include <gdal_priv.h>

#include <string>

namespace tinsmith {

/// " (file: what is wrong with it)", of the first file of a band of a VRT that can't be opened, or nothing when
/// there is none. VRTs in VRTs are not looked into.
std::string reason_of_vrt(GDALRasterBand& band, const std::string& path);

}  // namespace tinsmith
