#include "kinegraph/collision/motion_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinegraph {

MotionBounds::MotionBounds(const State& scene) : model_(scene.sharedModel()), steps_(scene.model().steps.size()) {
  for (const LaneModel::Link& link : scene.parameters().link) {
    offset_.push_back(Eigen::Map<const Vector3d>(link.p).norm());
  }
}

void MotionBounds::setMotion(const double* from, const double* to) {
  for (const KinematicModel::Link& link : model_->links) {
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      steps_[std::size_t(s)] = boundOf(model_->steps[std::size_t(s)], std::abs(link.scale), dof, from, to);
      dof += model_->steps[std::size_t(s)].dofs();
    }
  }
}

MotionBounds::StepBound MotionBounds::boundOf(const MotionStep& step, double scale, int dof, const double* from,
                                              const double* to) const {
  StepBound bound;
  const double change = std::abs(to[dof] - from[dof]);
  if (step.translates()) {
    bound.move = scale * change;
    bound.reach = scale * std::max(std::abs(from[dof]), std::abs(to[dof]));
  } else if (step.rotates()) {
    bound.turn = scale * change;
  } else if (step.orients()) {
    // q goes along a line, so that its direction turns in one plane: the angle's rate is D / |q|^2 with the constant
    // D = |q x dq|, and the joint turns by twice the angle.
    const Eigen::Map<const VectorXd> q(from + dof, step.dofs()), end(to + dof, step.dofs());
    double square = 0., along = 0.;
    for (int i = 0; i < step.dofs(); ++i) {
      const double dq = end[i] - q[i];
      square += dq * dq;
      along += dq * q[i];
    }
    if (square == 0.) return bound;
    const double nearest = std::clamp(-along / square, 0., 1.),
                 least = q.squaredNorm() + nearest * (2. * along + nearest * square);
    if (least < 1e-18) {
      bound.turn = bound.twist = std::numeric_limits<double>::infinity();
      return bound;
    }
    const double area = std::sqrt(std::max(q.squaredNorm() * square - along * along, 0.));
    bound.turn = 2. * area / least;
    bound.twist = 2. * bound.turn * std::max(std::abs(along), std::abs(along + square)) / least;
  }
  return bound;
}

/// From a link to its parent.
void MotionBounds::climb(int index, Rates& rates) const {
  const KinematicModel::Link& link = model_->links[std::size_t(index)];
  for (int s = link.first_step + link.steps - 1; s >= link.first_step; --s) {
    const StepBound& step = steps_[std::size_t(s)];
    const bool turns = step.turn > 0. && rates.reach > 0.;
    const double speed = turns ? step.turn * rates.reach : 0.;
    if (step.turn > 0. && speed + rates.speed > 0.) rates.bend += step.turn * (speed + 2. * rates.speed);
    if (turns && step.twist > 0.) rates.bend += step.twist * rates.reach;
    rates.speed += speed + step.move;
    rates.reach += step.reach;
  }
  rates.reach += offset_[std::size_t(index)];
}

MotionBounds::Rates MotionBounds::ratesOf(int link, double reach, int ancestor) const {
  Rates rates{0., 0., reach};
  for (; link != ancestor; link = model_->links[std::size_t(link)].parent) climb(link, rates);
  return rates;
}

MotionBounds::Rates MotionBounds::directionOf(int index, int ancestor) const {
  Rates rates{0., 0., 1.};
  double twist = 0.;
  while (index != ancestor) {
    const KinematicModel::Link& link = model_->links[std::size_t(index)];
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      rates.speed += steps_[std::size_t(s)].turn;
      twist += steps_[std::size_t(s)].twist;
    }
    index = link.parent;
  }
  rates.bend = rates.speed * rates.speed + twist;
  return rates;
}

int MotionBounds::commonLink(int link_a, int link_b) const {
  while (link_a != link_b) {  // links come after their parents
    int& later = link_a > link_b ? link_a : link_b;
    later = model_->links[std::size_t(later)].parent;
  }
  return link_a;
}

MotionBounds::Rates MotionBounds::relative(int link_a, double reach_a, int link_b, double reach_b) const {
  const int common = commonLink(link_a, link_b);
  const Rates a = ratesOf(link_a, reach_a, common), b = ratesOf(link_b, reach_b, common);
  return {a.speed + b.speed, a.bend + b.bend, a.reach + b.reach};
}

}  // namespace kinegraph
