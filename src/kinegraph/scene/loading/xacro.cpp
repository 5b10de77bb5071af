#include "kinegraph/scene/loading/xacro.h"

#include <mutex>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

std::mutex expander_mutex;
XacroExpander xacro_expander;

}  // namespace

void setXacroExpander(XacroExpander expander) {
  const std::lock_guard lock(expander_mutex);
  xacro_expander = std::move(expander);
}

std::string scene_internal::expandXacro(const std::string& path, const XacroArguments& arguments) {
  XacroExpander expand;
  {
    const std::lock_guard lock(expander_mutex);
    expand = xacro_expander;
  }
  if (expand) return expand(path, arguments);
  std::string command = cat("xacrodoc ", path, " -o robot.urdf");
  for (const auto& [name, value] : arguments) command += cat(" ", name, ":=", value);
  throw FileError(cat("'", path, "' has xacro macros, and no XacroExpander is set; '", command,
                      "' converts it (pip install xacrodoc)"));
}

}  // namespace kinegraph
