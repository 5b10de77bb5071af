#include "kinegraph/planning/steering/pair_gradient.h"

#include "kinegraph/geometry/distance/proximity.h"

namespace kinegraph::inline planning_internal {

PairGradient pairGradient(const State& state, int a, int b) {
  const auto& bodies = state.model().body;
  const Proximity near = proximity(*bodies[std::size_t(a)], state.pose(a), *bodies[std::size_t(b)], state.pose(b));
  PairGradient pair{near.distance, VectorXd::Zero(state.dofs())};
  const auto add = [&](int frame, const Vector3d& point, double factor) {
    state.forTwists(frame, [&](int dof, const State::Twist& twist) {
      pair.gradient[dof] += factor * near.normal.dot(twist.linear + twist.angular.cross(point));
    });
  };
  add(a, near.point_a, near.rate);
  add(b, near.point_b, -near.rate);
  return pair;
}

}  // namespace kinegraph::inline planning_internal
