#include "kinegraph/komo/path/path_initialization.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline komo_internal {

namespace {

/// Copies shared dofs from the slice that owns them to all others.
void copySharedDofs(Path& path) { path.setVariables(path.variables()); }

const std::vector<KinematicModel::DofRange>& ownedDofs(const Path& path, int slice) {
  return path.layout().owned[std::size_t(slice + path.grid().order())];
}

/// Returns the initial configuration's dofs in a slice.
VectorXd initialDofs(const Path& path, int slice) {
  return path.state(slice).q()(path.dofsOf(path.initial().joint_frames, slice));
}

/// Samples the q of a slice; joints of the initial configuration are sampled around their values in the previous slice.
VectorXd randomState(const Path& path, int slice, Config& config, Rng& rng) {
  std::vector<std::pair<Joint*, VectorXd>> homes;
  for (int frame : path.initial().joint_frames) {
    if (slice <= 0) break;
    Joint& joint = *config.scene()->frames()[frame]->joint;
    const State& before = path.state(slice - 1);
    const auto [first, count] = before.model().frame_dofs[frame];
    if (joint.dofs() != count) continue;
    homes.emplace_back(&joint, std::move(joint.home));
    joint.home = before.q().segment(first, count);
  }
  config.setJointState(path.state(slice).q());
  config.setRandom(rng);
  for (auto& [joint, home] : homes) joint->home = std::move(home);
  return config.getJointState();
}

/// Marks rotations without limits, which are interpolated along the shorter arc.
std::vector<bool> endlessDofs(const KinematicModel& model) {
  std::vector<bool> endless(std::size_t(model.dofs), false);
  for (std::size_t l = 1; l < model.links.size(); ++l) {
    const KinematicModel::Link& link = model.links[l];
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const MotionStep& motion = model.steps[s];
      if (motion.rotates() && std::isinf(model.lower[dof])) endless[std::size_t(dof)] = true;
      dof += motion.dofs();
    }
  }
  return endless;
}

/// Returns the slice of waypoint i.
int sliceOfWaypoint(const Path& path, std::size_t i, int per_phase) {
  const double time = double(i + 1) / per_phase;
  const int slice = path.grid().sliceAt(time);
  if (slice < 0 || slice >= path.grid().slices())
    throw ValueError(cat("initWithWaypoints: waypoint ", i, " is at phase time ", time, ", outside of the path"));
  return slice;
}

/// Writes waypoint i into its slice.
void writeWaypoint(Path& path, int slice, std::size_t i, const VectorXd& waypoint) {
  const Eigen::Index n = path.dofs(), own = path.layout().plain ? n : path.ownDofs(slice).size();
  if (waypoint.size() != n && waypoint.size() != own) {
    throw ValueError(cat("initWithWaypoints: waypoint ", i, " has ", waypoint.size(), " numbers; expected ", n,
                         own == n ? std::string() : cat(", or ", own, " with the dofs of the mode switch")));
  }
  if (waypoint.size() != own || path.layout().plain) return path.setJoints(slice, waypoint);
  VectorXd q = path.state(slice).q();
  int next = 0;
  for (const auto& [first, count] : ownedDofs(path, slice)) {
    for (int d = first; d < first + count; ++d) q[d] = waypoint[next++];
  }
  path.setSlice(slice, q.data());
}

/// Fills the slices between waypoints, given as `joints` at `slices`.
void joinWaypoints(Path& path, const std::vector<int>& slices, const std::vector<VectorXd>& joints,
                   const WaypointOptions& options) {
  const KinematicModel& model = *path.initial().model;
  const std::vector<bool> endless = endlessDofs(model);
  int from = 0;
  VectorXd at = initialDofs(path, 0);
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const int to = slices[i];
    VectorXd offset = joints[i] - at;
    for (int d = 0; d < path.dofs(); ++d) {
      if (endless[std::size_t(d)]) offset[d] = std::remainder(offset[d], 2. * std::numbers::pi);
    }
    const bool blends = options.interpolate && to > from;
    for (int t = from; blends && t <= to; ++t) {
      const double s = double(t - from) / (to - from), blend = .5 * (1. - std::cos(std::numbers::pi * s));
      VectorXd q = at + blend * offset;
      q += options.towards_home * std::pow(std::sin(std::numbers::pi * s), 2) * (model.home - q);
      path.setJoints(t, q);
    }
    const int end = i + 1 < slices.size() ? slices[i + 1] : path.grid().slices();
    at = blends ? VectorXd(at + offset) : joints[i];
    for (int t = to + 1; t < end; ++t) path.setJoints(t, at);
    from = to;
  }
}

}  // namespace

void initializePath(Path& path, const MatrixXd& configurations) {
  path.requireBuilt("initWithPath");
  const int T = path.grid().slices(), n = path.dofs();
  if (configurations.rows() != T || configurations.cols() != n) {
    throw ValueError(cat("KOMO: the path is ", configurations.rows(), " x ", configurations.cols(), "; expected ", T,
                         " slices x ", n, " dofs"));
  }
  if (!configurations.allFinite()) throw ValueError("KOMO: the path has numbers that are not finite");
  for (int t = 0; t < T; ++t) path.setJoints(t, configurations.row(t));
  if (!path.layout().plain) copySharedDofs(path);
}

void initializeConstant(Path& path, const VectorXd& q) {
  path.requireBuilt("initWithConstant");
  const int T = path.grid().slices(), n = path.dofs();
  if (q.size() == n * T && T > 1)
    return initializePath(path, Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(q.data(), T, n));
  if (q.size() != n) throw ValueError(cat("KOMO: got ", q.size(), " joint values; expected ", n));
  initializePath(path, q.transpose().replicate(T, 1));
}

void initializeFromStart(Path& path) {
  path.requireBuilt("initOrg");
  for (int t = 0; t < path.grid().slices(); ++t) path.setJoints(t, path.initial().q);
}

void initializeRandom(Path& path, Rng& rng) {
  path.requireBuilt("initRandom");
  const bool plain = path.layout().plain;
  VectorXd x(path.layout().dimension);
  int next = 0;
  std::map<const Mode*, Config> configs;  // copied once per structure, since their models are expensive
  for (int t = plain ? 0 : -path.grid().order(); t < path.grid().slices(); ++t) {
    const Mode* mode = path.modes().empty() ? nullptr : &path.mode(t);
    if (!configs.contains(mode)) configs.emplace(mode, path.configuration(t));
    const VectorXd q = randomState(path, t, configs.at(mode), rng);
    VectorXd q_now = path.state(t).q();
    const auto take = [&](int first, int count) {
      for (int dof = first; dof < first + count; ++dof) x[next++] = q_now[dof] = q[dof];
    };
    if (plain) {
      take(0, path.dofs());
    } else {
      for (const auto& [first, count] : ownedDofs(path, t)) take(first, count);
    }
    path.setSlice(t, q_now.data());
  }
  path.setVariables(x);
}

std::vector<int> initializeWaypoints(Path& path, const std::vector<VectorXd>& waypoints,
                                     const WaypointOptions& options) {
  path.requireBuilt("initWithWaypoints");
  if (options.per_phase < 1)
    throw ValueError(cat("initWithWaypoints: waypointSlicesPerPhase is ", options.per_phase, "; expected at least 1"));
  if (waypoints.empty()) throw ValueError("initWithWaypoints: there are no waypoints; expected at least one");
  std::vector<int> slices;
  std::vector<VectorXd> joints;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const int slice = sliceOfWaypoint(path, i, options.per_phase);
    writeWaypoint(path, slice, i, waypoints[i]);
    slices.push_back(slice);
    joints.push_back(initialDofs(path, slice));
  }
  if (slices.empty()) return slices;
  joinWaypoints(path, slices, joints, options);
  copySharedDofs(path);
  return slices;
}

void initializePhase(Path& path, int phase, const std::vector<int>& frames, const MatrixXd& configurations,
                     bool resample) {
  path.requireBuilt("initPhaseWithDofsPath");
  const int per_phase = path.grid().slicesPerPhase(), first = phase * per_phase,
            count = std::min(per_phase, path.grid().slices() - first);
  if (phase < 0 || count < 1) throw ValueError(cat("initPhaseWithDofsPath: phase ", phase, " is not part of the path"));
  const std::vector<int>& joints = frames.empty() ? path.initial().joint_frames : frames;
  const int n = int(path.dofsOf(joints, first).size());
  if (configurations.cols() != n || configurations.rows() < 1 || (!resample && configurations.rows() != count)) {
    throw ValueError(cat("initPhaseWithDofsPath: the path is ", configurations.rows(), " x ", configurations.cols(),
                         "; expected ", count, " slices x ", n, " dofs"));
  }
  for (int i = 0; i < count; ++i) {
    const double place =
        count == 1 ? double(configurations.rows() - 1) : double(i) * double(configurations.rows() - 1) / (count - 1);
    const int before = std::min(int(place), int(configurations.rows()) - 1),
              next = std::min(before + 1, int(configurations.rows()) - 1);
    VectorXd q = path.state(first + i).q();
    q(path.dofsOf(joints, first + i)) =
        (configurations.row(before) + (place - before) * (configurations.row(next) - configurations.row(before)))
            .transpose();
    path.setSlice(first + i, q.data());
  }
  copySharedDofs(path);
}

}  // namespace kinegraph::inline komo_internal
