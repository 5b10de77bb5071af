#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/komo/komo.h"

namespace kinegraph {

/// Sets the given configuration's dofs in a slice. Those that all slices share are set in all.
void Komo::writeJoints(int slice, const VectorXd& q) {
  VectorXd all = state(slice).q();
  const std::vector<int> dofs = dofsOf(joint_frames_, slice);
  all(dofs) = q;
  setSlice(slice, all.data());
}

void Komo::setPath(const MatrixXd& path) {
  requireBuilt("initWithPath");
  if (path.rows() != slices_ || path.cols() != dofs()) {
    throw ValueError(cat("KOMO: the path is ", path.rows(), " x ", path.cols(), "; expected ", slices_, " slices x ",
                         dofs(), " dofs"));
  }
  if (!path.allFinite()) throw ValueError("KOMO: the path has numbers that are not finite");
  for (int t = 0; t < slices_; ++t) writeJoints(t, path.row(t));
  if (!layout_.plain) setVariables(variables());
}

void Komo::setConstantPath(const VectorXd& q) {
  requireBuilt("initWithConstant");
  if (q.size() == dofs() * slices_ && slices_ > 1) {
    setPath(Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(q.data(), slices_, dofs()));
    return;
  }
  if (q.size() != dofs()) throw ValueError(cat("KOMO: got ", q.size(), " joint values; expected ", dofs()));
  setPath(q.transpose().replicate(slices_, 1));
}

void Komo::resetPath() {
  requireBuilt("initOrg");
  for (int t = 0; t < slices_; ++t) writeJoints(t, start_);
}

void Komo::setRandomPath(Rng& rng) {
  requireBuilt("initRandom");
  VectorXd x(layout_.dimension);
  int next = 0;
  std::map<const Mode*, Config> configs;  // copied once per structure; their programs take long to make
  for (int t = layout_.plain ? 0 : -order_; t < slices_; ++t) {
    const Mode* mode = modes_.empty() ? nullptr : modes_[mode_of_[t + order_]].get();
    if (!configs.contains(mode)) configs.emplace(mode, configuration(t));
    Config& config = configs.at(mode);
    std::vector<std::pair<Joint*, VectorXd>> homes;
    for (int frame :
         joint_frames_) {  // the given configuration's joints are drawn around where they were in the slice before
      if (t <= 0) break;
      Joint& joint = *config.scene()->frames()[frame]->joint;
      const auto [first, count] = state(t - 1).program().frame_dofs[frame];
      if (joint.dofs() != count) continue;
      homes.emplace_back(&joint, std::move(joint.home));
      joint.home = state(t - 1).q().segment(first, count);
    }
    config.setJointState(state(t).q());
    config.setRandom(rng);
    for (auto& [joint, home] : homes) joint->home = std::move(home);
    const VectorXd q = config.getJointState();
    VectorXd kept = state(t).q();
    const auto take = [&](int dof) { x[next++] = kept[dof] = q[dof]; };
    if (layout_.plain) {
      for (int i = 0; i < dofs(); ++i) take(i);
    } else {
      for (const auto& [first, count] : layout_.owned[t + order_]) {
        for (int i = first; i < first + count; ++i) take(i);
      }
    }
    setSlice(t, kept.data());
  }
  setVariables(x);
}

std::vector<int> Komo::setWaypoints(const std::vector<VectorXd>& waypoints, int per_phase, bool interpolate,
                                    double towards_home) {
  requireBuilt("initWithWaypoints");
  if (per_phase < 1)
    throw ValueError(cat("initWithWaypoints: waypointSlicesPerPhase is ", per_phase, "; expected at least 1"));
  const int n = dofs();
  std::vector<int> steps;
  std::vector<VectorXd> joints;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const int step = sliceAt(double(i + 1) / per_phase);
    if (step < 0 || step >= slices_) {
      throw ValueError(cat("initWithWaypoints: waypoint ", i, " is at phase time ", double(i + 1) / per_phase,
                           ", outside of the path"));
    }
    const Eigen::Index own = layout_.plain ? n : ownDofs(step).size();
    if (waypoints[i].size() != n && waypoints[i].size() != own) {
      throw ValueError(cat("initWithWaypoints: waypoint ", i, " has ", waypoints[i].size(), " numbers; expected ", n,
                           own == n ? std::string() : cat(", or ", own, " with the dofs of the mode switch")));
    }
    if (waypoints[i].size() == own && !layout_.plain) {
      VectorXd q = state(step).q();
      int next = 0;
      for (const auto& [first, count] : layout_.owned[step + order_]) {
        for (int d = first; d < first + count; ++d) q[d] = waypoints[i][next++];
      }
      setSlice(step, q.data());
    } else {
      writeJoints(step, waypoints[i]);
    }
    steps.push_back(step);
    joints.push_back(state(step).q()(dofsOf(joint_frames_, step)));
  }
  if (steps.empty()) return steps;
  std::vector<bool> endless(n, false);  // rotations without limits take the short way round
  for (std::size_t l = 1; l < program_->links.size(); ++l) {
    const Program::Link& link = program_->links[l];
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const MotionStep& motion = program_->steps[s];
      if (motion.turns() && std::isinf(program_->lower[dof])) endless[dof] = true;
      dof += motion.dofs();
    }
  }
  int from = 0;
  VectorXd at = state(0).q()(dofsOf(joint_frames_, 0));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    VectorXd way = joints[i] - at;
    for (int d = 0; d < n; ++d) {
      if (endless[d]) way[d] = std::remainder(way[d], 2. * std::numbers::pi);
    }
    if (interpolate && steps[i] > from) {
      for (int t = from; t <= steps[i]; ++t) {
        const double s = double(t - from) / (steps[i] - from), blend = .5 * (1. - std::cos(std::numbers::pi * s));
        VectorXd q = at + blend * way;
        q += towards_home * std::pow(std::sin(std::numbers::pi * s), 2) * (program_->home - q);
        writeJoints(t, q);
      }
    }
    const int end = i + 1 < steps.size() ? steps[i + 1] : slices_;
    at = interpolate && steps[i] > from ? VectorXd(at + way) : joints[i];
    for (int t = steps[i] + 1; t < end; ++t) writeJoints(t, at);
    from = steps[i];
  }
  setVariables(variables());
  return steps;
}

void Komo::setPhasePath(int phase, const std::vector<int>& frames, const MatrixXd& path, bool resample) {
  requireBuilt("initPhaseWithDofsPath");
  const int first = phase * slices_per_phase_, count = std::min(slices_per_phase_, slices_ - first);
  if (phase < 0 || count < 1) throw ValueError(cat("initPhaseWithDofsPath: phase ", phase, " is not part of the path"));
  const std::vector<int>& joints = frames.empty() ? joint_frames_ : frames;
  const int n = int(dofsOf(joints, first).size());
  if (path.cols() != n || path.rows() < 1 || (!resample && path.rows() != count)) {
    throw ValueError(cat("initPhaseWithDofsPath: the path is ", path.rows(), " x ", path.cols(), "; expected ", count,
                         " slices x ", n, " dofs"));
  }
  for (int i = 0; i < count; ++i) {
    const double place = count == 1 ? double(path.rows() - 1) : double(i) * double(path.rows() - 1) / (count - 1);
    const int row = std::min(int(place), int(path.rows()) - 1), next = std::min(row + 1, int(path.rows()) - 1);
    VectorXd q = state(first + i).q();
    q(dofsOf(joints, first + i)) = (path.row(row) + (place - row) * (path.row(next) - path.row(row))).transpose();
    setSlice(first + i, q.data());
  }
  setVariables(variables());
}

}  // namespace kinegraph
