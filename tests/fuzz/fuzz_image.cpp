// A libFuzzer target for pictures. Reading any bytes gives as many pixels as they say, or an error
// of the library.
#include <cstdint>
#include <cstdlib>

#include "kinegraph/common/errors.h"
#include "kinegraph/geometry/files/image_file.h"

using namespace kinegraph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Image image{std::string(reinterpret_cast<const char*>(data), size)};
  if (!isImage(image.bytes)) return -1;
  try {
    const Pixels pixels = decodeImage(image);
    if (pixels.rgb.size() != 3 * std::size_t(pixels.width) * std::size_t(pixels.height)) std::abort();
  } catch (const FileError&) {
  }
  return 0;
}
