#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "kinegraph/common/errors.h"
#include "kinegraph/control/target_file.h"

/// Rows of targets: what is read gives finite poses at all times; all else that may come of it is an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinegraph;
  try {
    const TargetFile targets = TargetFile::fromText({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
    for (const double t : {-1e300, 0., .5 * targets.duration(), targets.duration(), 1e300})
      if (!targets(t).allFinite()) std::abort();
  } catch (const Error&) {
  }
  return 0;
}
