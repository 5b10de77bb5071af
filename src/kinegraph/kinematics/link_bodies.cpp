#include "kinegraph/kinematics/link_bodies.h"

#include <algorithm>

namespace kinegraph::inline kinematics_internal {

namespace {

/// Computes a sphere around those of all bodies of a group.
void bound(LinkBodies::Group& group, const std::vector<LinkBodies::Body>& bodies) {
  Vector3d low = Vector3d::Constant(1e300), high = -low;
  const auto centerOf = [](const LinkBodies::Body& body) { return body.X_LB * body.shape->boundCenter(); };
  for (int i = group.first; i < group.last; ++i) {
    const LinkBodies::Body& body = bodies[std::size_t(i)];
    const double radius = body.shape->boundRadius();
    low = low.cwiseMin((centerOf(body).array() - radius).matrix());
    high = high.cwiseMax((centerOf(body).array() + radius).matrix());
  }
  group.center =
      group.last == group.first + 1 ? centerOf(bodies[std::size_t(group.first)]) : Vector3d(.5 * (low + high));
  group.radius = group.reach = 0.;
  for (int i = group.first; i < group.last; ++i) {
    const LinkBodies::Body& body = bodies[std::size_t(i)];
    group.radius = std::max(group.radius, (centerOf(body) - group.center).norm() + body.shape->boundRadius());
    group.reach = std::max(group.reach, body.reach);
  }
}

int commonLink(const KinematicModel& model, int a, int b) {
  while (a != b) {  // links come after their parents
    int& later = a > b ? a : b;
    later = model.links[std::size_t(later)].parent;
  }
  return a;
}

}  // namespace

LinkBodies::LinkBodies(const State& scene) : model(scene.sharedModel()) {
  const ContactRules& contacts = model->contacts;
  for (std::size_t i = 0; i < contacts.bodies.size(); ++i) {
    const auto frame = std::size_t(contacts.bodies[i].frame);
    const auto& shape = model->body[frame];
    const RigidTransform& X_LB = scene.parameters().frame_offset[frame];
    bodies.push_back(
        {shape, int(frame), int(i), -1, X_LB, (X_LB * shape->boundCenter()).norm() + shape->boundRadius()});
  }
  const auto linkOf = [&](const Body& body) { return model->frame_link[std::size_t(body.frame)]; };
  std::stable_sort(bodies.begin(), bodies.end(), [&](const Body& x, const Body& y) {
    const int a = linkOf(x), b = linkOf(y);
    return a != 0 && b != 0 ? a < b : a > b;  // the world comes last
  });
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const int link = linkOf(bodies[i]);
    if (link == 0 || groups.empty() || groups.back().link != link) groups.push_back({link, int(i), int(i), {}, 0., 0.});
    bodies[i].group = int(groups.size()) - 1;
    groups.back().last = int(i) + 1;
    if (link != 0) moving = int(groups.size());
  }
  for (Group& group : groups) bound(group, bodies);
  many = groups.size() - std::size_t(moving) > kMostListed;
  for (int a = 0; a < moving; ++a) {
    for (int b = a + 1; b < (many ? moving : int(groups.size())); ++b) {
      const int first = int(pairs.size());
      appendPairs(a, b, pairs);
      if (int(pairs.size()) > first) blocks.push_back({a, b, first, int(pairs.size())});
    }
  }
  if (!many) return;
  std::vector<WorldBox> boxes;
  for (std::size_t i = std::size_t(moving); i < groups.size(); ++i) {
    const Body& body = bodies[std::size_t(groups[i].first)];
    const Vector3d half = (body.X_LB.R.cwiseAbs() * body.shape->boundHalf()).array() + body.shape->radius();
    boxes.push_back({groups[i].center - half, groups[i].center + half});
  }
  fixed_tree.build(boxes);
}

void LinkBodies::appendPairs(int group_a, int group_b, std::vector<Pair>& to) const {
  const Group &a = groups[std::size_t(group_a)], &b = groups[std::size_t(group_b)];
  const int ancestor = commonLink(*model, a.link, b.link);
  for (int i = a.first; i < a.last; ++i) {
    for (int j = b.first; j < b.last; ++j) {
      const Body &x = bodies[std::size_t(i)], &y = bodies[std::size_t(j)];
      if (!model->contacts.allow(std::size_t(x.contact), std::size_t(y.contact))) continue;
      to.push_back({i, j, ancestor, x.shape->convex() && y.shape->convex()});
    }
  }
}

}  // namespace kinegraph::inline kinematics_internal
