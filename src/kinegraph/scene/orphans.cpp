#include "kinegraph/scene/orphans.h"

#include "kinegraph/scene/loading/reader.h"

namespace kinegraph {

std::optional<Frame> addFileWithOrphans(Config& config, const std::string& path, const std::string& prefix,
                                        std::vector<std::string>& warnings) {
  if (path.ends_with(".srdf")) return config.addFile(path, prefix);
  SceneTree scratch;
  readSceneFile(path, scratch, warnings, true);
  FrameData* first = config.scene()->append(scratch, prefix);
  if (!first) return std::nullopt;
  return Frame(config.scene(), *first);
}

}  // namespace kinegraph
