#pragma once

#include <string>

namespace kinegraph {

/// A picture as the bytes of a PNG or JPEG file.
struct Image {
  std::string bytes;
  std::string path = {};  ///< of its file; empty if embedded in another file
};

}  // namespace kinegraph
