#include "kinegraph/collision/travel_bound.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph {

namespace {

constexpr double kNoProof = 1.05;  // where quaternions or circles move a body

}  // namespace

double travelOf(const State& state, const VectorXd& change, const VectorXd& spread) {
  const KinematicModel& model = state.model();
  double most = 0.;
  for (std::size_t frame = 0; frame < model.body.size(); ++frame) {
    const auto& body = model.body[frame];
    if (!body || !state.moves(int(frame))) continue;
    const Vector3d center = state.pose(int(frame)) * body->boundCenter();
    double travel = 0., moved = 0.;  // relative to the joint that is visited, by those that were before
    state.forTwists(int(frame), [&](int dof, const State::Twist& twist) {
      const double turn = twist.angular.norm();
      const double speed = (twist.linear + twist.angular.cross(center)).norm() + turn * (body->boundRadius() + moved);
      travel += std::abs(change[dof]) * speed;
      moved += spread[dof] * speed;
    });
    most = std::max(most, state.hasCurvature(int(frame)) ? travel : kNoProof * travel);
  }
  return most;
}

}  // namespace kinegraph
