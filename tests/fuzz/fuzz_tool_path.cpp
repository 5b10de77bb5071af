// A libFuzzer target for one kind of tool path, that of the extension FUZZ_TOOL_PATH: tables of rows, or programs of
// machines. For any text, reading it gives a path whose curve is finite everywhere, or an error of the library.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/tool_paths/tool_curve.h"

using namespace kinegraph;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string path =
      (std::filesystem::temp_directory_path() / ("kinegraph_fuzz_" + std::to_string(getpid()) + FUZZ_TOOL_PATH))
          .string();
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), std::streamsize(size));
  try {
    const ToolCurve curve(ToolPath::read(path, "tool"), Pose(), {1e-4, 1e-3}, .05, .05);
    for (const double share : {0., .3, .7, 1.})
      if (!curve.pieces().eval(share * curve.length()).allFinite()) std::abort();
    if (curve.reversed().pieces().pieces() != curve.pieces().pieces()) std::abort();
  } catch (const Error&) {
  }
  return 0;
}
