#include "kinegraph/kinematics/motion_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace kinegraph {

namespace {

bool manyBodies(const State& scene) { return scene.program().contacts.bodies.size() > NearPairs::kFew; }

}  // namespace

MotionChecker::MotionChecker(const State& scene)
    : state_(scene), pairs_(scene.program(), manyBodies(scene) ? scene.program().movingPairs() : scene.program().collidable()),
      bodies_(pairs_), from_(scene.dofs()),
      change_(scene.dofs()), q_(scene.dofs()), steps_(scene.program().steps.size()), speed_(pairs_.pairs.size()) {
  due_.reserve(pairs_.pairs.size());
  if (manyBodies(scene)) resting_.emplace(scene.sharedProgram());
}

void MotionChecker::moveTo(double time) {
  if (time == time_) return;
  time_ = time;
  q_ = from_ + time * change_;
  state_.setJoints(q_.data());
  bodies_.place(state_);
}

void MotionChecker::boundSteps(const double* to) {
  using Kind = MotionStep::Kind;
  const Program& program = state_.program();
  for (const Program::Link& link : program.links) {
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const MotionStep& step = program.steps[s];
      const double scale = std::abs(link.scale), change = std::abs(change_[dof]);
      StepBound& bound = steps_[s] = {};
      switch (step.kind) {
        case Kind::translate:
          bound.move = scale * change;
          bound.reach = scale * std::max(std::abs(from_[dof]), std::abs(to[dof]));
          break;
        case Kind::rotate:
        case Kind::rotateAbout: bound.turn = scale * change; break;
        case Kind::quaternion:
        case Kind::circle: {  // |w| <= 2 |dq| / |q|, with the least |q| on the way
          const auto q = from_.segment(dof, step.dofs()), dq = change_.segment(dof, step.dofs());
          const double square = dq.squaredNorm();
          if (square == 0.) break;
          const double nearest = std::clamp(-q.dot(dq) / square, 0., 1.);
          const double norm = (q + nearest * dq).norm();
          bound.turn = norm > 1e-9 ? 2. * std::sqrt(square) / norm : std::numeric_limits<double>::infinity();
          break;
        }
        case Kind::time: break;
      }
      dof += step.dofs();
    }
  }
}

/// How fast the joint of a link moves what lies within `reach` of the link's origin, which becomes the reach from that of
/// its parent.
double MotionChecker::climb(int index, double& reach) const {
  const Program::Link& link = state_.program().links[index];
  double speed = 0.;
  for (int s = link.first_step + link.steps - 1; s >= link.first_step; --s) {
    const StepBound& step = steps_[s];
    if (step.turn > 0. && reach > 0.) speed += step.turn * reach;
    speed += step.move;
    reach += step.reach;
  }
  reach += state_.parameters().joint_base[index].p.norm();
  return speed;
}

double MotionChecker::relativeSpeed(int pair) const {
  const auto reachOf = [&](int place) {
    const CollisionBody& body = *pairs_.bodies[place];
    return (state_.parameters().frame_offset[pairs_.frames[place]] * body.boundCenter()).norm() + body.boundRadius();
  };
  const auto [a, b] = pairs_.pairs[pair];
  double reach_a = reachOf(a), reach_b = reachOf(b), speed = 0.;
  const std::vector<Program::Link>& links = state_.program().links;
  int link_a = state_.link(pairs_.frames[a]), link_b = state_.link(pairs_.frames[b]);
  while (link_a != link_b) {  // links come after their parents
    if (link_a > link_b) {
      speed += climb(link_a, reach_a);
      link_a = links[link_a].parent;
    } else {
      speed += climb(link_b, reach_b);
      link_b = links[link_b].parent;
    }
  }
  return speed;
}

std::optional<MotionContact> MotionChecker::firstContact(const double* from, const double* to, double margin, double tolerance) {
  const int n = state_.dofs();
  from_ = Eigen::Map<const VectorXd>(from, n);
  change_ = Eigen::Map<const VectorXd>(to, n) - from_;
  boundSteps(to);
  const auto contact = [&](int pair) {
    const auto [a, b] = pairs_.pairs[pair];
    return MotionContact{time_, pairs_.frames[a], pairs_.frames[b], bodies_.proximity(pair).distance};
  };
  const auto spare = [&](int pair) { return bodies_.proximity(pair).distance - margin; };
  due_.clear();
  time_ = -1.;
  moveTo(0.);
  for (int pair = 0; pair < bodies_.pairs(); ++pair) {
    const double speed = speed_[pair] = relativeSpeed(pair);  // 0 for a pair that moves as one
    if (!bodies_.mayBeNear(pair, margin + speed)) continue;
    const double now = spare(pair);
    if (now < 0. || (speed > 0. && (now < tolerance || now / speed == 0.))) return contact(pair);
    if (now < speed) due_.push_back({now / speed, pair});
  }
  if (resting_) {  // pairs that move as one
    resting_->place(state_);
    for (const NearPairSearch::Near& near : resting_->near(margin)) {
      const int a = resting_->frame(near.a), b = resting_->frame(near.b);
      if (near.distance < margin && state_.link(a) == state_.link(b)) return MotionContact{0., a, b, near.distance};
    }
  }
  if (due_.empty()) return std::nullopt;
  // By how much the pairs keep the margin at the end; the rest is free where that and what they keep now cover it.
  std::array<std::byte, 8192> buffer;
  std::pmr::monotonic_buffer_resource memory(buffer.data(), buffer.size());
  std::pmr::vector<double> at_end(speed_.size(), 0., &memory);
  moveTo(1.);
  for (const Due& due : due_) at_end[due.pair] = std::max(spare(due.pair), 0.);
  std::erase_if(due_, [&](const Due& due) { return due.time * speed_[due.pair] + at_end[due.pair] >= speed_[due.pair]; });
  std::make_heap(due_.begin(), due_.end());
  while (!due_.empty()) {
    std::pop_heap(due_.begin(), due_.end());
    const auto [time, pair] = due_.back();
    due_.pop_back();
    moveTo(time);
    const double rest = speed_[pair] * (1. - time);
    if (!bodies_.mayBeNear(pair, margin + rest)) continue;
    const double now = spare(pair), next = time + now / speed_[pair];
    if (now < tolerance || next == time) return contact(pair);
    if (now + at_end[pair] >= rest) continue;
    due_.push_back({next, pair});
    std::push_heap(due_.begin(), due_.end());
  }
  return std::nullopt;
}

}  // namespace kinegraph
