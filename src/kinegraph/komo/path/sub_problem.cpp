#include "kinegraph/komo/path/sub_problem.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline komo_internal {

SubProblem subProblem(const Path& path, int phase) {
  const TimeGrid& grid = path.grid();
  if (grid.slicesPerPhase() != 1)
    throw ValueError(cat("getSubProblem needs one slice per phase; this KOMO has ", grid.slicesPerPhase()));
  if (phase < 0 || phase >= grid.slices() || phase - 1 < -grid.order()) {
    throw ValueError(
        cat("getSubProblem: phase ", phase, " is not in ", grid.order() > 0 ? 0 : 1, " .. ", grid.slices() - 1));
  }
  path.requireBuilt("getSubProblem");
  SubProblem out{path.configuration(phase - 1), {}, {}};
  SceneTree& scene = *out.config.scene();
  if (!path.modes().empty()) {
    for (const auto& [frame, added] : path.mode(phase - 1).added) {
      if (FrameData& data = *scene.frames()[frame]; data.moves()) data.joint->active = false;
    }
  }
  std::vector<int> frames;  // frames whose joints make up the result
  for (int frame : path.initial().joint_frames) {
    if (path.initial().isShared(frame)) {
      scene.frames()[frame]->joint->active = false;
    } else {
      frames.push_back(frame);
    }
  }
  scene.structureChanged();
  const auto read = [&](int slice) { return VectorXd(path.state(slice).q()(path.dofsOf(frames, slice))); };
  out.start = read(phase - 1);
  out.end = read(phase);
  return out;
}

}  // namespace kinegraph::inline komo_internal
