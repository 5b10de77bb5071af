#include "kinegraph/kinematics/placed_samples.h"

#include <limits>

namespace kinegraph {

namespace {

using Lane = PlacedSamples::Lane;

/// How far a box A is from a box B along the direction from B to the middle of A.
Lane boxGap(const Lane (&R_A)[3][3], const Lane (&center_a)[3], const Vector3d& half_a, const Lane (&R_B)[3][3],
            const Lane (&center_b)[3], const Vector3d& half_b) {
  Lane apart[3], away[3], square = Lane::Zero();
  for (int k = 0; k < 3; ++k) apart[k] = center_a[k] - center_b[k];
  for (int k = 0; k < 3; ++k) {  // from the nearest point of B, in its axes
    const Lane along = R_B[0][k] * apart[0] + R_B[1][k] * apart[1] + R_B[2][k] * apart[2];
    away[k] = along - along.max(-half_b[k]).min(half_b[k]);
    square += away[k] * away[k];
  }
  Lane extent = Lane::Zero();
  Lane world[3];
  for (int r = 0; r < 3; ++r) world[r] = R_B[r][0] * away[0] + R_B[r][1] * away[1] + R_B[r][2] * away[2];
  for (int k = 0; k < 3; ++k) {
    if (half_a[k] > 0.)
      extent += half_a[k] * (R_A[0][k] * world[0] + R_A[1][k] * world[1] + R_A[2][k] * world[2]).abs();
  }
  const Lane norm = square.sqrt();
  return (norm > 1e-9).select(norm - extent / norm.max(1e-9), -std::numeric_limits<double>::infinity());
}

}  // namespace

PlacedSamples::PlacedSamples(const State& scene, const LinkBodies& bodies)
    : bodies_(&bodies), states_(kMost, scene), spheres_(bodies.groups.size()), placed_(bodies.bodies.size()) {
  for (std::size_t i = 0; i < bodies.groups.size(); ++i) {
    const LinkBodies::Group& group = bodies.groups[i];
    spheres_[i] = {group.center, group.radius};  // as it is for those that are fixed
  }
  if (bodies.many) return;
  for (auto& placed : placed_) placed = std::make_unique<Placed>();
}

void PlacedSamples::place(int count) {
  count_ = count;
  ++stamp_;
  for (int g = 0; g < bodies_->moving; ++g) {
    const LinkBodies::Group& group = bodies_->groups[std::size_t(g)];
    Vector3d centers[kMost], low = Vector3d::Constant(1e300), high = -low;
    for (int i = 0; i < count; ++i) {
      const RigidTransform& X = states_[std::size_t(i)].linkPose(group.link);
      centers[i].noalias() = X.R * group.center + X.p;
      low = low.cwiseMin(centers[i]);
      high = high.cwiseMax(centers[i]);
    }
    const Vector3d middle = .5 * (low + high);
    double square = 0.;
    for (int i = 0; i < count; ++i) square = std::max(square, (centers[i] - middle).squaredNorm());
    spheres_[std::size_t(g)] = {middle, group.radius + std::sqrt(square)};
  }
}

bool PlacedSamples::mayBeNear(int group_a, int group_b, double margin) const {
  const Sphere &a = spheres_[std::size_t(group_a)], &b = spheres_[std::size_t(group_b)];
  const double reach = a.radius + b.radius + margin;
  if (reach < 0.) return true;  // a depth that spheres say nothing about
  if ((a.center - b.center).squaredNorm() > reach * reach) return false;
  if (!bodies_->fixed(group_b)) return true;
  const LinkBodies::Body& body = bodies_->bodies[std::size_t(bodies_->groups[std::size_t(group_b)].first)];
  const Vector3d along = body.X_LB.R.transpose() * (a.center - b.center);
  const double square = (along.cwiseAbs() - body.shape->boundHalf()).cwiseMax(0.).squaredNorm(),
               needed = std::max(a.radius + body.shape->radius() + margin, 0.);
  return square <= needed * needed;
}

const RigidTransform& PlacedSamples::pose(int body, int sample) { return placed(body).pose[sample]; }

const PlacedSamples::Placed& PlacedSamples::placed(int index) {
  if (!placed_[std::size_t(index)]) placed_[std::size_t(index)] = std::make_unique<Placed>();
  Placed& placed = *placed_[std::size_t(index)];
  if (placed.stamp == stamp_) return placed;
  const LinkBodies::Body& body = bodies_->bodies[std::size_t(index)];
  const int link = bodies_->groups[std::size_t(body.group)].link;
  if (link == 0 && placed.stamp > 0) {  // as ever
    placed.stamp = stamp_;
    return placed;
  }
  placed.stamp = stamp_;
  for (int i = 0; i < kMost; ++i) {
    const int sample = std::min(i, count_ - 1);
    RigidTransform& X = placed.pose[i];
    if (i < count_ || link == 0) X = states_[std::size_t(sample)].linkPose(link) * body.X_LB;
    const RigidTransform& from = placed.pose[link == 0 ? i : sample];
    const Vector3d center = from * body.shape->boundCenter();
    for (int r = 0; r < 3; ++r) {
      placed.center[r][i] = center[r];
      for (int k = 0; k < 3; ++k) placed.R[r][k][i] = from.R(r, k);
    }
  }
  return placed;
}

Lane PlacedSamples::distanceBounds(int body_a, int body_b) {
  const Placed &a = placed(body_a), &b = placed(body_b);
  const CollisionBody &shape_a = *bodies_->bodies[std::size_t(body_a)].shape,
                      &shape_b = *bodies_->bodies[std::size_t(body_b)].shape;
  const bool point_a = shape_a.core() == CollisionBody::Core::point,
             point_b = shape_b.core() == CollisionBody::Core::point;
  Lane gap = Lane::Constant(-std::numeric_limits<double>::infinity());
  if (point_a || !point_b) gap = boxGap(a.R, a.center, shape_a.boundHalf(), b.R, b.center, shape_b.boundHalf());
  if (!point_a) gap = gap.max(boxGap(b.R, b.center, shape_b.boundHalf(), a.R, a.center, shape_a.boundHalf()));
  return gap - (shape_a.radius() + shape_b.radius());
}

}  // namespace kinegraph
