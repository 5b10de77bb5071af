#include "kinegraph/collision/placed_samples.h"

#include "kinegraph/kinematics/lane_storage.h"

namespace kinegraph::inline collision_internal {

namespace {

/// The convex core of a body, for the kernel.
SampleKernel::Convex coreOf(const CollisionBody& body) {
  SampleKernel::Convex core{};
  switch (body.core()) {
    case CollisionBody::Core::segment:
      core.half[2] = body.halfLength();
      break;
    case CollisionBody::Core::cylinder:
      core.radii[0] = core.radii[1] = body.coreRadius();
      core.half[2] = body.halfLength();
      break;
    case CollisionBody::Core::box_ellipsoid:
      std::copy_n(body.radii().data(), 3, core.radii);
      [[fallthrough]];
    case CollisionBody::Core::box:
      std::copy_n(body.halfSides().data(), 3, core.half);
      break;
    case CollisionBody::Core::hull: {
      const Hull& hull = body.hull();
      core.points = hull.points.front().data();
      core.count = int(hull.points.size());
      if (hull.first_neighbor.empty()) break;
      core.neighbors = hull.neighbors.data();
      core.first_neighbor = hull.first_neighbor.data();
      break;
    }
    default:
      break;
  }
  core.is_round = std::any_of(core.radii, core.radii + 3, [](double radius) { return radius > 0.; });
  return core;
}

}  // namespace

static_assert(PlacedSamples::kMost == SampleKernel::kLanes);

PlacedSamples::PlacedSamples(const State& scene, const LinkBodies& bodies, const SampleKernel& kernel)
    : kernel_(&kernel),
      parameters_(scene.sharedParameters()),
      bodies_(&bodies),
      Q_(std::size_t(kMost * scene.dofs())),
      spheres_(bodies.groups.size()),
      placed_(bodies.bodies.size()) {
  const KinematicModel& model = scene.model();
  model_ = {int(model.links.size()),  int(model.steps.size()), int(model.column_dof.size()), model.dofs,
            parameters_->link.data(), parameters_->step.data()};
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
    spheres_[i] = {group.center, group.radius};  // final for static groups
  }
  if (bodies.many) return;
  layOutFixed();
  for (int i = 0; i < int(placed_.size()); ++i) placed_[std::size_t(i)] = unplaced(i);
}

void PlacedSamples::layOutFixed() {
  const int width = kernel_->width, count = int(bodies_->groups.size()) - bodies_->moving,
            packs = (count + width - 1) / width;
  double* rows = nullptr;
  layOutLanes(fixed_storage_, width, {{&rows, std::size_t(packs * SampleKernel::FixedBoxes::kRows)}});
  near_.resize(std::size_t(packs * width));
  fixed_ = {rows, count};
  for (int i = 0; i < count; ++i) {
    const LinkBodies::Group& group = bodies_->groups[std::size_t(bodies_->moving + i)];
    const LinkBodies::Body& body = bodies_->bodies[std::size_t(group.first)];
    double of[SampleKernel::FixedBoxes::kRows];
    std::copy_n(body.X_LB.R.data(), 9, of);
    std::copy_n(group.center.data(), 3, of + 9);
    std::copy_n(body.shape->boundHalf().data(), 3, of + 12);
    of[15] = body.shape->radius();
    of[16] = group.radius;
    for (int r = 0; r < SampleKernel::FixedBoxes::kRows; ++r)
      rows[(i / width * SampleKernel::FixedBoxes::kRows + r) * width + i % width] = of[r];
  }
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
  if (reach < 0.) return true;  // spheres do not bound penetration depths
  if ((a.center - b.center).squaredNorm() > reach * reach) return false;
  if (!bodies_->fixed(group_b)) return true;
  const LinkBodies::Body& body = bodies_->bodies[std::size_t(bodies_->groups[std::size_t(group_b)].first)];
  const Vector3d along = body.X_LB.R.transpose() * (a.center - b.center);
  const double square = (along.cwiseAbs() - body.shape->boundHalf()).cwiseMax(0.).squaredNorm(),
               needed = std::max(a.radius + body.shape->radius() + margin, 0.);
  return square <= needed * needed;
}

const std::vector<std::int64_t>& PlacedSamples::nearFixed(int group, double margin) {
  const Sphere& at = spheres_[std::size_t(group)];
  const double sphere[4] = {at.center[0], at.center[1], at.center[2], at.radius};
  kernel_->nearBoxes(fixed_, sphere, margin, near_.data());
  return near_;
}

std::unique_ptr<PlacedSamples::Placed> PlacedSamples::unplaced(int index) const {
  auto placed = std::make_unique<Placed>();
  const LinkBodies::Body& body = bodies_->bodies[std::size_t(index)];
  placed->offset.rotation = classifyRotation(body.X_LB.R.data());
  std::copy_n(body.X_LB.R.data(), 9, placed->offset.R);
  std::copy_n(body.X_LB.p.data(), 3, placed->offset.p);
  const Vector3d center = body.shape->boundCenter();
  std::copy_n(center.data(), 3, placed->offset.center);
  placed->core = coreOf(*body.shape);
  return placed;
}

const PlacedSamples::Placed& PlacedSamples::placed(int index) {
  if (!placed_[std::size_t(index)]) placed_[std::size_t(index)] = unplaced(index);
  Placed& placed = *placed_[std::size_t(index)];
  if (placed.stamp == stamp_) return placed;
  const int link = bodies_->link(index);
  if (link != 0 || placed.stamp == 0) {  // static bodies are placed once
    kernel_->placeBody(memory_.pose, model_.links * LaneMemory::kPerPose, link * LaneMemory::kPerPose, placed.offset,
                       link == 0 ? kMost / kernel_->width : groups_, placed.rows);
  }
  placed.stamp = stamp_;
  return placed;
}

SampleKernel::Box PlacedSamples::boxOf(int body) {
  const CollisionBody& shape = *bodies_->bodies[std::size_t(body)].shape;
  const Vector3d half = shape.boundHalf();
  const double inner = shape.convex() ? shape.innerRadius() : -std::numeric_limits<double>::infinity();
  return {placed(body).rows,
          {half[0], half[1], half[2]},
          inner,
          shape.core() <= CollisionBody::Core::box,
          shape.core() == CollisionBody::Core::point};
}

PlacedSamples::Bounds PlacedSamples::distanceBounds(int body_a, int body_b, double most) {
  alignas(64) double gaps[kMost] = {}, tops[kMost] = {};
  const double radii =
      bodies_->bodies[std::size_t(body_a)].shape->radius() + bodies_->bodies[std::size_t(body_b)].shape->radius();
  kernel_->boxGaps(boxOf(body_a), boxOf(body_b), groups_, most + radii, gaps, tops);
  return {Eigen::Map<const Lane>(gaps) - radii, Eigen::Map<const Lane>(tops) - radii};
}

PlacedSamples::Lane PlacedSamples::gaps(int body_a, int body_b, const Vector3d& n, int link, SupportCorners& corners) {
  alignas(64) double gaps[kMost] = {};
  const Placed &at_a = placed(body_a), &at_b = placed(body_b);
  SampleKernel::PlacedConvex a = {&at_a.core, at_a.rows, corners.a}, b = {&at_b.core, at_b.rows, corners.b};
  kernel_->gaps(a, b, n.data(), link == 0 ? nullptr : memory_.pose, model_.links * LaneMemory::kPerPose,
                link * LaneMemory::kPerPose, groups_, gaps);
  corners = {a.corner, b.corner};
  const auto radius = [&](int body) { return bodies_->bodies[std::size_t(body)].shape->radius(); };
  return Eigen::Map<const Lane>(gaps) - (radius(body_a) + radius(body_b));
}

}  // namespace kinegraph::inline collision_internal
