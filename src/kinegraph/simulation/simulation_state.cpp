#include "kinegraph/simulation/simulation_data.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/simulation/simulation_impl.h"
#include "kinegraph/simulation/state_bytes.h"

namespace kinegraph {

namespace {

constexpr double kMoved = 1e-9;  ///< m or quaternion: larger differences of poses are no rounding

void expectSize(const char* call, const char* what, std::ptrdiff_t rows, std::ptrdiff_t columns,
                const MatrixXd& values) {
  if (values.rows() != rows || values.cols() != columns)
    throw ValueError(cat(call, ": ", what, " has shape (", values.rows(), ", ", values.cols(), "); expected (", rows,
                         ", ", columns, ")"));
  if (!values.allFinite()) throw ValueError(cat(call, ": ", what, " must be finite"));
}

}  // namespace

void Simulation::Impl::setJoints(const VectorXd& q, const VectorXd* velocity) {
  for (const ModelJoint& joint : world->scene().joints) {
    if (joint.first_q < 0) continue;
    writeJoint(joint, q.data() + joint.first_q, world->positions());
    if (velocity)
      writeJointVelocity(joint, q.data() + joint.first_q, velocity->data() + joint.first_q, world->velocities());
  }
}

SimulationState Simulation::getState() const {
  const Impl& s = *impl_;
  return {s.world->time(), s.q(), s.qDot(), s.freePoses(), s.freeVelocities(), stateToBytes(s.world->state())};
}

void Simulation::setState(const SimulationState& state) {
  update();
  restore(state);
  publish();
}

void Simulation::restore(const SimulationState& state) {
  Impl& s = *impl_;
  const char* call = "Simulation.setState";
  const auto n = s.world->scene().dofs;
  const auto f = std::ptrdiff_t(s.world->scene().free_frames.size());
  expectSize(call, "q", n, 1, state.q);
  expectSize(call, "qDot", n, 1, state.qDot);
  expectSize(call, "freePos", f, 7, state.freePos);
  expectSize(call, "freeVel", f, 6, state.freeVel);
  if (!std::isfinite(state.time)) throw ValueError(cat(call, ": time is ", state.time, "; expected a finite number"));
  for (std::ptrdiff_t i = 0; i < f; ++i) Pose::fromNumbers(state.freePos.row(i).transpose());
  if (!state.remainder.empty()) s.world->setState(stateFromBytes(state.remainder, *s.world));
  // changed fields take precedence over the stored bytes
  const VectorXd q_before = s.q();
  if (state.q != q_before || state.qDot != s.qDot()) {
    s.world->wake();
    s.setJoints(state.q, &state.qDot);
  }
  if (state.freePos != s.freePoses()) {
    s.world->wake();
    for (std::ptrdiff_t i = 0; i < f; ++i)
      writeFreePose(Pose::fromNumbers(state.freePos.row(i).transpose()),
                    s.world->positions() + s.world->scene().free_qpos[std::size_t(i)]);
  }
  if (state.freeVel != s.freeVelocities()) {
    s.world->wake();
    s.setFreeVelocities(state.freeVel);
  }
  s.world->setTime(state.time);
  if (state.q != q_before || state.remainder.empty()) s.world->settle();
  s.recordState(state);
}

void Simulation::pushConfigToSim(const MatrixXd& frame_velocities, const VectorXd& joint_velocities) {
  update();
  Impl& s = *impl_;
  const char* call = "Simulation.pushConfigToSim";
  if (frame_velocities.size() > 0)
    expectSize(call, "frameVelocities", std::ptrdiff_t(s.world->scene().free_frames.size()), 6, frame_velocities);
  if (joint_velocities.size() > 0) expectSize(call, "jointVelocities", s.world->scene().dofs, 1, joint_velocities);
  if (s.hasMovedShapes()) renew();
  s.readConfig(*s.world);
  std::fill_n(s.world->velocities(), s.world->model().nv, 0.);
  if (frame_velocities.size() > 0) s.setFreeVelocities(frame_velocities);
  if (joint_velocities.size() > 0) s.setJoints(s.q(), &joint_velocities);
  s.world->settle();
  s.world->forgetForces();
  s.recordState(getState());
}

bool Simulation::Impl::hasMovedShapes() const {
  SceneTree& scene = *config.scene();
  const SceneBodies& placed = world->scene().scene;
  for (std::size_t i = 0; i < placed.frames.size(); ++i) {
    const PlacedFrame& in_model = placed.frames[i];
    if (!in_model.collides) continue;
    const FrameData* body = placed.bodies[std::size_t(in_model.body)].frame;
    const Pose now = (body ? scene.worldPose(*body).inverse() : Pose()) * scene.worldPose(*frames[i]);
    const auto &a = now.q.coeffs(), &b = in_model.X_BF.q.coeffs();
    if ((now.p - in_model.X_BF.p).norm() > kMoved || std::min((a - b).norm(), (a + b).norm()) > kMoved) return true;
  }
  return false;
}

void Simulation::Impl::rebuild() {
  const std::vector<std::shared_ptr<FrameData>> before = frames;
  std::unique_ptr<World> next = makeWorld();
  readConfig(*next);
  next->settle();
  next->transferState(*world, [&](int frame) {
    const auto found = std::find(before.begin(), before.end(), frames[std::size_t(frame)]);
    return found == before.end() ? -1 : int(found - before.begin());
  });
  world = std::move(next);
}

}  // namespace kinegraph
