#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::inline geometry_internal {

/// Colors, rows from top to bottom.
struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< height x width x 3
};

/// Returns whether the bytes begin like a PNG or JPEG file.
bool isImage(const std::string& bytes);

/// "image/png" or "image/jpeg".
std::string mediaType(const Image& image);

/// Reads a file without decoding it. Throws FileError if it is missing, or is neither PNG nor JPEG.
std::shared_ptr<const Image> readImageFile(const std::string& path);

/// Decodes a picture; transparency is dropped. Throws FileError for damaged data, and for headers with more pixels than
/// the data can hold.
Pixels decodeImage(const Image& image);

/// Encodes pixels as an uncompressed PNG file.
Image encodePng(const Pixels& pixels);

}  // namespace kinegraph::inline geometry_internal
