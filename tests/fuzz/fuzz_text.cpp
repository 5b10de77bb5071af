// A libFuzzer target for one kind of scene file; FUZZ_FILE names one of that kind. For any text, reading it
// gives a scene or an error of the library, and a written scene reads back as a scene of the same size.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "kinegraph/common/errors.h"
#include "kinegraph/exporters/writers.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/scene/loading/robot_semantics.h"

using namespace kinegraph;

namespace {

/// A robot for texts that only say something about one.
constexpr std::string_view kRobot =
    "base: { shape: sphere, size: [1] } j1 (base): { joint: hingeX } l1 (j1): { shape: sphere, size: [1], contact: 1 } "
    "j2 (l1): { joint: free } l2 (j2): { shape: sphere, size: [1], contact: 1 }";

void readScene(std::string_view text, const std::string& folder) {
  Config config;
  config.addText(text, FUZZ_FILE, folder);
  if (config.getFrameState().rows() != config.getFrameDimension()) std::abort();
  std::string written;
  try {
    written = writeScene(config);
  } catch (const ValueError&) {  // text that no quotes can hold
    return;
  }
  Config again;
  again.addText(written, "written.g", folder);
  if (again.getFrameDimension() != config.getFrameDimension()) std::abort();
}

void readAboutRobot(std::string_view text) {
  std::vector<Diagnostic> found;
  const RobotSemantics semantics = readSemantics(text, FUZZ_FILE, found);
  Config config;
  config.addText(kRobot);
  SceneDiagnostics diagnostics;
  applySemantics(semantics, *config.scene(), diagnostics);
  for (const std::string& name : config.getStateNames()) {
    try {
      config.getNamedState(name);
    } catch (const Error&) {  // of two groups, with two values
    }
  }
  config.getCollidablePairs();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string folder = (std::filesystem::temp_directory_path() / "kinegraph_fuzz_without_files").string();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    isSemanticsFile(FUZZ_FILE) ? readAboutRobot(text) : readScene(text, folder);
  } catch (const ParseError&) {
  } catch (const FileError&) {
  }
  return 0;
}
