#include "kinegraph/collision/stray_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinegraph/collision/motion_bounds.h"
#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph {

namespace {

/// The least norm on the line from a to b.
double leastNorm(const Eigen::Ref<const VectorXd>& a, const Eigen::Ref<const VectorXd>& b) {
  const VectorXd way = b - a;
  const double square = way.squaredNorm(), share = square > 0. ? std::clamp(-way.dot(a) / square, 0., 1.) : 0.;
  return (a + share * way).norm();
}

}  // namespace

StrayBound::StrayBound(const State& scene)
    : model_(scene.sharedModel()),
      body_reach_(model_->links.size(), -1.),
      reach_(model_->steps.size()),
      move_(model_->links.size()),
      largest_(VectorXd::Zero(model_->dofs)) {
  for (const LaneModel::Link& link : scene.parameters().link)
    offset_.push_back(Eigen::Map<const Vector3d>(link.p).norm());
  const MotionBounds tree(scene);
  const auto onLink = [&](int frame) {
    const CollisionBody& body = *model_->body[std::size_t(frame)];
    const RigidTransform& X_LF = scene.parameters().frame_offset[std::size_t(frame)];
    const int link = scene.link(frame);
    double& reach = body_reach_[std::size_t(link)];
    reach = std::max(reach, (X_LF * body.boundCenter()).norm() + body.boundRadius());
    return link;
  };
  for (const auto& [a, b] : model_->movingPairs()) {
    const int on_a = onLink(a), on_b = onLink(b), first = std::min(on_a, on_b), second = std::max(on_a, on_b);
    const auto is_it = [&](const LinkPair& pair) { return pair.a == first && pair.b == second; };
    if (std::ranges::none_of(pairs_, is_it)) pairs_.push_back({first, second, tree.commonLink(first, second)});
  }
  has_slides_ = std::ranges::any_of(model_->steps, [](const MotionStep& step) { return step.translates(); });
  findReaches();
}

void StrayBound::setLargest(const VectorXd& largest) {
  if (!has_slides_) return;
  largest_ = largest;
  findReaches();
}

/// Links come after their parents, so that what is behind one is known where it is visited.
void StrayBound::findReaches() {
  std::vector<double> behind = body_reach_;
  for (int index = int(model_->links.size()) - 1; index > 0; --index) {
    const KinematicModel::Link& link = model_->links[std::size_t(index)];
    double reach = behind[std::size_t(index)];
    if (reach < 0.) continue;
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) dof += model_->steps[std::size_t(s)].dofs();
    for (int s = link.first_step + link.steps - 1; s >= link.first_step; --s) {
      const MotionStep& step = model_->steps[std::size_t(s)];
      dof -= step.dofs();
      reach_[std::size_t(s)] = reach;
      if (step.translates()) reach += std::abs(link.scale) * largest_[dof];
    }
    double& of_parent = behind[std::size_t(link.parent)];
    of_parent = std::max(of_parent, reach + offset_[std::size_t(index)]);
  }
}

/// Of what is on or behind a link, by its own joint.
double StrayBound::moveOf(int index, const VectorXd& from, const VectorXd& to, const VectorXd& stray) const {
  const KinematicModel::Link& link = model_->links[std::size_t(index)];
  const double scale = std::abs(link.scale);
  double move = 0.;
  int dof = link.dof;
  for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
    const MotionStep& step = model_->steps[std::size_t(s)];
    const int dofs = step.dofs();
    if (step.translates()) {
      move += scale * std::abs(stray[dof]);
    } else if (step.rotates()) {
      move += scale * std::abs(stray[dof]) * reach_[std::size_t(s)];
    } else if (step.orients()) {
      const double off = stray.segment(dof, dofs).norm(),
                   least = leastNorm(from.segment(dof, dofs), to.segment(dof, dofs));
      const double angle = off < least ? 2. * std::asin(off / least) : std::numbers::pi;
      if (off > 0.) move += std::min(angle, std::numbers::pi) * reach_[std::size_t(s)];
    }
    dof += dofs;
  }
  return move;
}

double StrayBound::of(const VectorXd& from, const VectorXd& to, const VectorXd& stray) {
  for (int index = 1; index < int(model_->links.size()); ++index) {
    const int parent = model_->links[std::size_t(index)].parent;
    move_[std::size_t(index)] = move_[std::size_t(parent)] + moveOf(index, from, to, stray);
  }
  double most = 0.;
  for (const auto& [a, b, common] : pairs_) {
    const double apart = move_[std::size_t(a)] + move_[std::size_t(b)] - 2. * move_[std::size_t(common)];
    most = std::max(most, apart);
  }
  return most;
}

}  // namespace kinegraph
