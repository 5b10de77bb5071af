#pragma once

#include <string_view>

#include "kinegraph/geometry/files/image_file.h"

namespace kinegraph::inline geometry_internal {

/// PNG of all color types and depths, interlaced or not. Throws FileError.
/// Source: Portable Network Graphics Specification, 2nd ed., W3C 2003.
Pixels decodePng(std::string_view bytes);

/// JPEG with 8 bits and Huffman codes, sequential or progressive, gray or with three colors. Throws FileError.
/// Implemented here because, unlike for the other libraries, no wheel provides libjpeg with headers to build against.
/// Source: CCITT Recommendation T.81, 1992; JPEG File Interchange Format 1.02.
Pixels decodeJpeg(std::string_view bytes);

/// Decompresses a zlib stream, at most `limit` bytes. Throws FileError.
std::string unpack(std::string_view bytes, std::size_t limit);

}  // namespace kinegraph::inline geometry_internal
