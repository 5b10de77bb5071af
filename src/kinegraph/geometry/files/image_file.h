#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/geometry/shapes/image.h"

namespace kinegraph {

/// Colors, rows from top to bottom.
struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< height x width x 3
};

/// Is this the beginning of a PNG or JPEG file?
bool isImage(const std::string& bytes);

/// "image/png" or "image/jpeg".
std::string mediaType(const Image& image);

/// Reads a file as it is. Throws FileError if it is missing, or is neither PNG nor JPEG.
std::shared_ptr<const Image> readImageFile(const std::string& path);

/// Colors of a picture; transparency is left out. Throws FileError for damaged ones, and for those that promise more
/// pixels than their bytes can hold.
Pixels decodeImage(const Image& image);

/// A PNG file of these pixels, not compressed.
Image encodePng(const Pixels& pixels);

}  // namespace kinegraph
