#include "kinegraph/komo/path/path_initialization.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

/// Takes dofs that all slices share to all of them, from the slice that owns them.
void spreadSharedDofs(Path& path) { path.setVariables(path.variables()); }

const std::vector<KinematicModel::DofRange>& ownedDofs(const Path& path, int slice) {
  return path.layout().owned[std::size_t(slice + path.grid().order())];
}

/// The given configuration's dofs in a slice.
VectorXd givenDofs(const Path& path, int slice) {
  return path.state(slice).q()(path.dofsOf(path.given().joint_frames, slice));
}

/// A random q of a slice, with the joints of the given configuration drawn around where they were in the slice before.
VectorXd randomState(const Path& path, int slice, Config& config, Rng& rng) {
  std::vector<std::pair<Joint*, VectorXd>> homes;
  for (int frame : path.given().joint_frames) {
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

/// Which dofs are rotations without limits: these take the short way round.
std::vector<bool> endlessDofs(const KinematicModel& model) {
  std::vector<bool> endless(std::size_t(model.dofs), false);
  for (std::size_t l = 1; l < model.links.size(); ++l) {
    const KinematicModel::Link& link = model.links[l];
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const MotionStep& motion = model.steps[s];
      if (motion.turns() && std::isinf(model.lower[dof])) endless[std::size_t(dof)] = true;
      dof += motion.dofs();
    }
  }
  return endless;
}

/// The slice of waypoint i.
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

/// Fills the slices between waypoints, which are `joints` at `slices`.
void joinWaypoints(Path& path, const std::vector<int>& slices, const std::vector<VectorXd>& joints,
                   const WaypointOptions& options) {
  const KinematicModel& model = *path.given().model;
  const std::vector<bool> endless = endlessDofs(model);
  int from = 0;
  VectorXd at = givenDofs(path, 0);
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const int to = slices[i];
    VectorXd way = joints[i] - at;
    for (int d = 0; d < path.dofs(); ++d) {
      if (endless[std::size_t(d)]) way[d] = std::remainder(way[d], 2. * std::numbers::pi);
    }
    const bool blends = options.interpolate && to > from;
    for (int t = from; blends && t <= to; ++t) {
      const double s = double(t - from) / (to - from), blend = .5 * (1. - std::cos(std::numbers::pi * s));
      VectorXd q = at + blend * way;
      q += options.towards_home * std::pow(std::sin(std::numbers::pi * s), 2) * (model.home - q);
      path.setJoints(t, q);
    }
    const int end = i + 1 < slices.size() ? slices[i + 1] : path.grid().slices();
    at = blends ? VectorXd(at + way) : joints[i];
    for (int t = to + 1; t < end; ++t) path.setJoints(t, at);
    from = to;
  }
}

}  // namespace

void startAtPath(Path& path, const MatrixXd& rows) {
  path.requireBuilt("initWithPath");
  const int T = path.grid().slices(), n = path.dofs();
  if (rows.rows() != T || rows.cols() != n) {
    throw ValueError(
        cat("KOMO: the path is ", rows.rows(), " x ", rows.cols(), "; expected ", T, " slices x ", n, " dofs"));
  }
  if (!rows.allFinite()) throw ValueError("KOMO: the path has numbers that are not finite");
  for (int t = 0; t < T; ++t) path.setJoints(t, rows.row(t));
  if (!path.layout().plain) spreadSharedDofs(path);
}

void startAtConstant(Path& path, const VectorXd& q) {
  path.requireBuilt("initWithConstant");
  const int T = path.grid().slices(), n = path.dofs();
  if (q.size() == n * T && T > 1)
    return startAtPath(path, Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(q.data(), T, n));
  if (q.size() != n) throw ValueError(cat("KOMO: got ", q.size(), " joint values; expected ", n));
  startAtPath(path, q.transpose().replicate(T, 1));
}

void startAsGiven(Path& path) {
  path.requireBuilt("initOrg");
  for (int t = 0; t < path.grid().slices(); ++t) path.setJoints(t, path.given().q);
}

void startAtRandom(Path& path, Rng& rng) {
  path.requireBuilt("initRandom");
  const bool plain = path.layout().plain;
  VectorXd x(path.layout().dimension);
  int next = 0;
  std::map<const Mode*, Config> configs;  // copied once per structure; their programs take long to make
  for (int t = plain ? 0 : -path.grid().order(); t < path.grid().slices(); ++t) {
    const Mode* mode = path.modes().empty() ? nullptr : &path.mode(t);
    if (!configs.contains(mode)) configs.emplace(mode, path.configuration(t));
    const VectorXd q = randomState(path, t, configs.at(mode), rng);
    VectorXd kept = path.state(t).q();
    const auto take = [&](int first, int count) {
      for (int dof = first; dof < first + count; ++dof) x[next++] = kept[dof] = q[dof];
    };
    if (plain) {
      take(0, path.dofs());
    } else {
      for (const auto& [first, count] : ownedDofs(path, t)) take(first, count);
    }
    path.setSlice(t, kept.data());
  }
  path.setVariables(x);
}

std::vector<int> startAtWaypoints(Path& path, const std::vector<VectorXd>& waypoints, const WaypointOptions& options) {
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
    joints.push_back(givenDofs(path, slice));
  }
  if (slices.empty()) return slices;
  joinWaypoints(path, slices, joints, options);
  spreadSharedDofs(path);
  return slices;
}

void startPhaseAt(Path& path, int phase, const std::vector<int>& frames, const MatrixXd& rows, bool resample) {
  path.requireBuilt("initPhaseWithDofsPath");
  const int per_phase = path.grid().slicesPerPhase(), first = phase * per_phase,
            count = std::min(per_phase, path.grid().slices() - first);
  if (phase < 0 || count < 1) throw ValueError(cat("initPhaseWithDofsPath: phase ", phase, " is not part of the path"));
  const std::vector<int>& joints = frames.empty() ? path.given().joint_frames : frames;
  const int n = int(path.dofsOf(joints, first).size());
  if (rows.cols() != n || rows.rows() < 1 || (!resample && rows.rows() != count)) {
    throw ValueError(cat("initPhaseWithDofsPath: the path is ", rows.rows(), " x ", rows.cols(), "; expected ", count,
                         " slices x ", n, " dofs"));
  }
  for (int i = 0; i < count; ++i) {
    const double place = count == 1 ? double(rows.rows() - 1) : double(i) * double(rows.rows() - 1) / (count - 1);
    const int row = std::min(int(place), int(rows.rows()) - 1), next = std::min(row + 1, int(rows.rows()) - 1);
    VectorXd q = path.state(first + i).q();
    q(path.dofsOf(joints, first + i)) = (rows.row(row) + (place - row) * (rows.row(next) - rows.row(row))).transpose();
    path.setSlice(first + i, q.data());
  }
  spreadSharedDofs(path);
}

}  // namespace kinegraph
