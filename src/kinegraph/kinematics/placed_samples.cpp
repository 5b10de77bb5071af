#include "kinegraph/kinematics/placed_samples.h"

#include "kinegraph/kinematics/lane_storage.h"

namespace kinegraph {

static_assert(PlacedSamples::kMost == SampleKernel::kLanes);

PlacedSamples::PlacedSamples(const State& scene, const LinkBodies& bodies, const SampleKernel& kernel)
    : kernel_(&kernel),
      parameters_(scene.sharedParameters()),
      bodies_(&bodies),
      Q_(std::size_t(kMost * scene.dofs())),
      spheres_(bodies.groups.size()),
      placed_(bodies.bodies.size()) {
  const Program& program = scene.program();
  model_ = {int(program.links.size()), int(program.steps.size()), int(program.column_dof.size()), program.dofs,
            parameters_->link.data(),  parameters_->step.data()};
  const std::size_t all = kMost / std::size_t(kernel_->width),
                    pose_rows = std::size_t(model_.links) * LaneMemory::kPerPose;
  layOutLanes(storage_, kernel_->width,
              {{&memory_.x, std::size_t(model_.variables)},
               {&memory_.pose, all * pose_rows},
               {&memory_.motion, std::size_t(model_.columns) * LaneMemory::kPerColumn}});
  for (std::size_t g = 0; g < all; ++g)
    setWorld(memory_.pose + g * pose_rows * std::size_t(kernel_->width), kernel_->width);
  for (std::size_t i = 0; i < bodies.groups.size(); ++i) {
    const LinkBodies::Group& group = bodies.groups[i];
    spheres_[i] = {group.center, group.radius};  // as it is for those that are fixed
  }
  if (bodies.many) return;
  for (int i = 0; i < int(placed_.size()); ++i) placed_[std::size_t(i)] = unplaced(i);
}

void PlacedSamples::place(int count) {
  count_ = count;
  groups_ = (count + kernel_->width - 1) / kernel_->width;
  ++stamp_;
  kernel_->placeLinks(model_, Q_.data(), count, groups_, memory_);
  for (int g = 0; g < bodies_->moving; ++g) {
    const LinkBodies::Group& group = bodies_->groups[std::size_t(g)];
    double sphere[4];
    kernel_->boundPoint(memory_.pose, model_.links * LaneMemory::kPerPose, group.link * LaneMemory::kPerPose,
                        group.center.data(), groups_, sphere);
    spheres_[std::size_t(g)] = {{sphere[0], sphere[1], sphere[2]}, group.radius + sphere[3]};
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

std::unique_ptr<PlacedSamples::Placed> PlacedSamples::unplaced(int index) const {
  auto placed = std::make_unique<Placed>();
  const LinkBodies::Body& body = bodies_->bodies[std::size_t(index)];
  placed->offset.turn = classifyTurn(body.X_LB.R.data());
  std::copy_n(body.X_LB.R.data(), 9, placed->offset.R);
  std::copy_n(body.X_LB.p.data(), 3, placed->offset.p);
  const Vector3d center = body.shape->boundCenter();
  std::copy_n(center.data(), 3, placed->offset.center);
  return placed;
}

const PlacedSamples::Placed& PlacedSamples::placed(int index) {
  if (!placed_[std::size_t(index)]) placed_[std::size_t(index)] = unplaced(index);
  Placed& placed = *placed_[std::size_t(index)];
  if (placed.stamp == stamp_) return placed;
  const int link = bodies_->link(index);
  if (link != 0 || placed.stamp == 0) {  // what is fixed is where it ever was
    kernel_->placeBody(memory_.pose, model_.links * LaneMemory::kPerPose, link * LaneMemory::kPerPose, placed.offset,
                       link == 0 ? kMost / kernel_->width : groups_, placed.rows);
  }
  placed.stamp = stamp_;
  return placed;
}

SampleKernel::Box PlacedSamples::boxOf(int body) {
  const CollisionBody& shape = *bodies_->bodies[std::size_t(body)].shape;
  const Vector3d half = shape.boundHalf();
  return {placed(body).rows, {half[0], half[1], half[2]}, shape.core() == CollisionBody::Core::point};
}

PlacedSamples::Lane PlacedSamples::distanceBounds(int body_a, int body_b, double most) {
  alignas(64) double gaps[kMost] = {};
  const double radii =
      bodies_->bodies[std::size_t(body_a)].shape->radius() + bodies_->bodies[std::size_t(body_b)].shape->radius();
  kernel_->boxGaps(boxOf(body_a), boxOf(body_b), groups_, most + radii, gaps);
  return Eigen::Map<const Lane>(gaps) - radii;
}

}  // namespace kinegraph
