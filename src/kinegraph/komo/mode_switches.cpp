#include "kinegraph/komo/mode_switches.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline komo_internal {

namespace {

using M = SwitchMode;

bool isQuasiStatic(M mode) { return mode == M::quasiStatic || mode == M::quasiStaticOn; }

/// Returns true if the object obeys physics.
bool isDynamic(M mode) {
  return mode == M::dynamic || mode == M::dynamicOn || mode == M::dynamicTrans || isQuasiStatic(mode);
}

/// Returns true if the motion is unconstrained.
bool isMagic(M mode) { return mode == M::magic || mode == M::magicTrans; }

bool movesAlone(M mode) {
  return mode == M::dynamic || mode == M::dynamicTrans || mode == M::quasiStatic || mode == M::magic;
}

const KinematicModel& firstModel(const Path& path) { return path.state(-path.grid().order()).model(); }

void requireFrame(const Path& path, const std::string& name, const char* call) {
  frameId(firstModel(path), name, call);
}

/// Returns the mode just before a slice.
const Mode& modeBefore(const Path& path, int slice) { return path.mode(std::max(slice - 1, -path.grid().order())); }

/// Requires that the pose or velocity of frames is continuous in a slice.
void addContinuity(MotionProblem& motion, FeatureSymbol feature, const std::vector<std::string>& frames, double scale,
                   int order, int slice) {
  if (slice < 0 || slice >= motion.path.grid().slices()) return;
  motion.require({.feature = feature,
                  .frames = frames,
                  .type = ObjectiveType::eq,
                  .scale = MatrixXd::Constant(1, 1, scale),
                  .order = order,
                  .times = {motion.path.grid().timeOf(slice)}});
}

/// Adds the physics of a mode without a stable joint, in the slices [from, to].
void addPhysics(MotionProblem& motion, M mode, const std::string& object, int from, int to) {
  const TimeGrid& grid = motion.path.grid();
  const bool damped = isQuasiStatic(mode);
  const int order = damped ? 1 : 2;
  if (grid.order() < order || from > to) return;
  const auto require = [&](ObjectiveType type, double scale, const std::vector<int>& chosen) {
    MatrixXd S = MatrixXd::Zero(Eigen::Index(chosen.size()), 6);
    for (std::size_t i = 0; i < chosen.size(); ++i) S(Eigen::Index(i), chosen[i]) = scale;
    motion.require({.feature = FeatureSymbol::physics,
                    .frames = {object},
                    .type = type,
                    .scale = chosen.size() == 6 ? MatrixXd::Constant(1, 1, scale) : S,
                    .order = order,
                    .times = {grid.timeOf(from), grid.timeOf(to)},
                    .without_gravity = mode == M::dynamicOn || mode == M::quasiStaticOn,
                    .damped = damped});
  };
  const std::vector<int> all = {0, 1, 2, 3, 4, 5};
  switch (mode) {
    case M::dynamicTrans:
      return require(ObjectiveType::eq, 1e2, {0, 1, 2});
    case M::quasiStatic:
      return require(ObjectiveType::eq, 1e1, all);
    case M::quasiStaticOn:
      require(ObjectiveType::eq, 1e1, {0, 1, 5});
      return require(ObjectiveType::sos, 1., {2, 3, 4});
    default:
      return require(ObjectiveType::eq, 1e2, all);
  }
}

/// Returns [parent, object], both in the scene.
std::pair<std::string, std::string> framesOf(const Path& path, const SwitchSpec& spec) {
  std::vector<std::string> frames = spec.frames;
  const bool alone = movesAlone(spec.mode);
  const std::vector<std::string>& known = path.initial().model->frame_name;
  if (frames.size() == 1 && alone && !known.empty()) frames.insert(frames.begin(), known.front());
  const std::vector<double>& times = spec.times;
  if (times.empty() || times.size() > 2 || !(times[0] >= 0.)) {
    throw ValueError("addModeSwitch: times must be [from, to], both phase times; to is -1 for a mode until the end");
  }
  if (frames.size() != 2) {
    throw ValueError(
        cat("addModeSwitch: frames must be [parent, object]", alone ? " or [object]" : "", "; got ", frames.size()));
  }
  for (const std::string& name : frames) requireFrame(path, name, "addModeSwitch");
  return {frames[0], frames[1]};
}

/// Returns true if the mode begins before the path ends. Otherwise adds a warning.
bool begins(MotionProblem& motion, const char* call, double time) {
  const TimeGrid& grid = motion.path.grid();
  if (grid.sliceAt(time) < grid.slices()) return true;
  motion.objectives.warn(
      cat(call, " at time ", time, " has no effect; the path ends at ", grid.timeOf(grid.slices() - 1)));
  return false;
}

/// Checks that the path has velocities, which the continuity of an object at the beginning and end of a mode
/// constrains.
void requireVelocities(const Path& path, const SwitchSpec& spec, int from, int to) {
  const bool ends = spec.times.size() == 2 && spec.times[1] >= 0. && to < path.grid().slices();
  const bool at_start = spec.first && from >= 0, at_end = ends && !isDynamic(spec.mode);
  if (path.grid().order() >= 1 || isMagic(spec.mode) || (!at_start && !at_end)) return;
  std::vector<std::string> otherwise;
  if (at_start) otherwise.push_back("first=false");
  if (at_end) otherwise.push_back(cat("times [", spec.times[0], ", -1]"));
  throw ValueError(
      cat("addModeSwitch: a continuous motion of the object constrains velocities; expected a KOMO with kOrder 1 or "
          "more, or ",
          join(otherwise, " and ")));
}

}  // namespace

void addModeSwitch(MotionProblem& motion, const SwitchSpec& spec) {
  Path& path = motion.path;
  path.requireBuilt("addModeSwitch");
  const auto [parent, object] = framesOf(path, spec);
  const M mode = spec.mode;
  const std::vector<double>& times = spec.times;
  const bool ends = times.size() == 2 && times[1] >= 0.;
  path.beginModes();
  if (!begins(motion, "addModeSwitch", times[0])) return;
  const int order = path.grid().order(), from = path.grid().sliceAt(times[0]),
            to = ends ? path.grid().sliceAt(times[1]) : path.grid().slices() - 1;
  if (ends && to < from)
    throw ValueError(cat("addModeSwitch: times [", times[0], ", ", times[1], "] end before they begin"));
  requireVelocities(path, spec, from, to);
  const Mode& before = modeBefore(path, from);
  const FrameData& root = before.movableRoot(object, parent);
  const std::string root_name = root.name;
  std::string parent_before;  // parent of the object if it was in a stable mode before
  if (const auto added = before.added.find(root.id); added != before.added.end() && added->second.stable)
    parent_before = added->second.parent;
  path.attach(from, parent, object, attachmentOf(mode, before.config.getFrame(parent), before.config.getFrame(object)));
  if (isMagic(mode)) return;
  const bool dynamic = isDynamic(mode);
  if (spec.first) {
    const double scale = dynamic ? 1e2 : 1e1;
    if (parent_before.empty()) {
      addContinuity(motion, FeatureSymbol::pose, {root_name}, scale, 1, from);
    } else {
      addContinuity(motion, FeatureSymbol::poseRel, {object, parent_before}, scale, 1, from);
    }
    if (order >= 2 && !dynamic) addContinuity(motion, FeatureSymbol::linangVel, {object}, 1., 2, from + 1);
  }
  if (dynamic) return addPhysics(motion, mode, object, from + 1, to);
  if (!ends) return;
  addContinuity(motion, FeatureSymbol::poseRel, {object, parent}, 1e1, 1, to);
  if (order >= 2) addContinuity(motion, FeatureSymbol::linangVel, {object}, 1., 2, to + 1);
}

void addRigidSwitch(MotionProblem& motion, double time, const std::string& parent, const std::string& object,
                    bool no_jump) {
  Path& path = motion.path;
  path.requireBuilt("addRigidSwitch");
  requireFrame(path, parent, "addRigidSwitch");
  requireFrame(path, object, "addRigidSwitch");
  if (!(time >= 0.)) throw ValueError(cat("addRigidSwitch: time is ", time, "; expected a phase time"));
  if (!begins(motion, "addRigidSwitch", time)) return;
  const int from = path.grid().sliceAt(time);
  path.beginModes();
  const std::string root = modeBefore(path, from).movableRoot(object, parent).name;
  path.attach(from, parent, object, {});
  if (!no_jump) return;
  addContinuity(motion, FeatureSymbol::pose, {root}, 1e1, 1, from);
  if (path.grid().order() >= 2) addContinuity(motion, FeatureSymbol::linangVel, {object}, 1., 2, from + 1);
}

void addFrameDof(Path& path, const FrameSpec& spec) {
  path.requireBuilt("addFrameDof");
  const KinematicModel& model = firstModel(path);
  if (spec.name.empty() || model.frame_index.contains(spec.name)) {
    throw ValueError(cat("addFrameDof: frame '", spec.name, "' exists already; expected a new name"));
  }
  std::string below = spec.parent;
  if (below.empty() && spec.type != JointType::none) {
    if (model.frame_name.empty())
      throw ValueError(cat("addFrameDof: the scene has no frame to which '", spec.name, "' could be joined; add one"));
    below = model.frame_index.contains("world") ? "world" : model.frame_name.front();
  }
  if (!below.empty()) requireFrame(path, below, "addFrameDof");
  if (!spec.origin.empty()) requireFrame(path, spec.origin, "addFrameDof");
  const JointType type = spec.type;
  if (type == JointType::hinge || type == JointType::generic || type == JointType::tau) {
    throw ValueError(cat("addFrameDof: a ", jointTypeName(type), " joint cannot be added to a motion problem"));
  }
  path.beginModes();
  std::optional<Pose> origin = spec.origin_pose;
  if (!origin && !spec.origin.empty()) origin = path.mode(-path.grid().order()).config.getFrame(spec.origin).getPose();
  path.addFrame(spec.name, below, type, spec.stable, origin);
}

}  // namespace kinegraph::inline komo_internal
