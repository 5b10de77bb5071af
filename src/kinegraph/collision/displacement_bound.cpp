#include "kinegraph/collision/displacement_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace kinegraph::inline collision_internal {

namespace {

constexpr double kWithoutProof = 1.05;  // factor if quaternions or circles move a body

/// The least norm of a point on the line from a to b.
double leastNorm(const Eigen::Ref<const VectorXd>& a, const Eigen::Ref<const VectorXd>& b) {
  const VectorXd change = b - a;
  const double square = change.squaredNorm(), share = square > 0. ? std::clamp(-change.dot(a) / square, 0., 1.) : 0.;
  return (a + share * change).norm();
}

}  // namespace

// --- along an edge -----------------------------------------------------------------------------------------------

DisplacementBound::DisplacementBound(const State& scene)
    : model_(scene.sharedModel()), steps_(scene.model().steps.size()) {
  for (const LaneModel::Link& link : scene.parameters().link)
    offset_.push_back(Eigen::Map<const Vector3d>(link.p).norm());
}

void DisplacementBound::setEdge(const double* from, const double* to) {
  for (const KinematicModel::Link& link : model_->links) {
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      steps_[std::size_t(s)] = boundOf(model_->steps[std::size_t(s)], std::abs(link.scale), dof, from, to);
      dof += model_->steps[std::size_t(s)].dofs();
    }
  }
}

DisplacementBound::StepBound DisplacementBound::boundOf(const MotionStep& step, double scale, int dof,
                                                        const double* from, const double* to) const {
  StepBound bound;
  const double change = std::abs(to[dof] - from[dof]);
  if (step.translates()) {
    bound.translation = scale * change;
    bound.reach = scale * std::max(std::abs(from[dof]), std::abs(to[dof]));
  } else if (step.rotates()) {
    bound.rotation = scale * change;
  } else if (step.orients()) {
    // q moves along a line, so that its direction rotates in one plane: the rate of the angle is D / |q|^2 with the
    // constant D = |q x dq|, and the joint rotates by twice the angle.
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
      bound.rotation = bound.rotation_change = std::numeric_limits<double>::infinity();
      return bound;
    }
    const double area = std::sqrt(std::max(q.squaredNorm() * square - along * along, 0.));
    bound.rotation = 2. * area / least;
    bound.rotation_change = 2. * bound.rotation * std::max(std::abs(along), std::abs(along + square)) / least;
  }
  return bound;
}

/// Adds the joint of a link: the rates become those relative to its parent.
void DisplacementBound::climb(int index, Rates& rates) const {
  const KinematicModel::Link& link = model_->links[std::size_t(index)];
  for (int s = link.first_step + link.steps - 1; s >= link.first_step; --s) {
    const StepBound& step = steps_[std::size_t(s)];
    const bool rotates = step.rotation > 0. && rates.reach > 0.;
    const double speed = rotates ? step.rotation * rates.reach : 0.;
    if (step.rotation > 0. && speed + rates.speed > 0.) rates.curvature += step.rotation * (speed + 2. * rates.speed);
    if (rotates && step.rotation_change > 0.) rates.curvature += step.rotation_change * rates.reach;
    rates.speed += speed + step.translation;
    rates.reach += step.reach;
  }
  rates.reach += offset_[std::size_t(index)];
}

DisplacementBound::Rates DisplacementBound::ratesOf(int link, double reach, int ancestor) const {
  Rates rates{0., 0., reach};
  for (; link != ancestor; link = model_->links[std::size_t(link)].parent) climb(link, rates);
  return rates;
}

DisplacementBound::Rates DisplacementBound::directionRates(int index, int ancestor) const {
  Rates rates{0., 0., 1.};
  double rotation_change = 0.;
  while (index != ancestor) {
    const KinematicModel::Link& link = model_->links[std::size_t(index)];
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      rates.speed += steps_[std::size_t(s)].rotation;
      rotation_change += steps_[std::size_t(s)].rotation_change;
    }
    index = link.parent;
  }
  rates.curvature = rates.speed * rates.speed + rotation_change;
  return rates;
}

int DisplacementBound::commonLink(int link_a, int link_b) const {
  while (link_a != link_b) {  // links come after their parents
    int& later = link_a > link_b ? link_a : link_b;
    later = model_->links[std::size_t(later)].parent;
  }
  return link_a;
}

DisplacementBound::Rates DisplacementBound::relativeRates(int link_a, double reach_a, int link_b,
                                                          double reach_b) const {
  const int common = commonLink(link_a, link_b);
  const Rates a = ratesOf(link_a, reach_a, common), b = ratesOf(link_b, reach_b, common);
  return {a.speed + b.speed, a.curvature + b.curvature, a.reach + b.reach};
}

double bodyReach(const State& scene, int frame, const CollisionBody& body) {
  return (scene.parameters().frame_offset[std::size_t(frame)] * body.boundCenter()).norm() + body.boundRadius();
}

// --- near an edge ------------------------------------------------------------------------------------------------

DeviationBound::DeviationBound(const State& scene)
    : model_(scene.sharedModel()),
      links_(scene),
      body_reach_(model_->links.size(), -1.),
      reach_(model_->steps.size()),
      displacement_(model_->links.size()),
      largest_(VectorXd::Zero(model_->dofs)) {
  const auto addBody = [&](int frame) {
    const int link = scene.link(frame);
    double& reach = body_reach_[std::size_t(link)];
    reach = std::max(reach, bodyReach(scene, frame, *model_->body[std::size_t(frame)]));
    return link;
  };
  for (const auto& [a, b] : model_->movingPairs()) {
    const int link_a = addBody(a), link_b = addBody(b), first = std::min(link_a, link_b),
              second = std::max(link_a, link_b);
    const auto is_same = [&](const LinkPair& pair) { return pair.a == first && pair.b == second; };
    if (std::ranges::none_of(pairs_, is_same)) pairs_.push_back({first, second, links_.commonLink(first, second)});
  }
  has_translations_ = std::ranges::any_of(model_->steps, [](const MotionStep& step) { return step.translates(); });
  findReaches();
}

void DeviationBound::setLargest(const VectorXd& largest) {
  if (!has_translations_) return;
  largest_ = largest;
  findReaches();
}

/// Visits links from the last one to the world: links come after their parents, so that the reach behind each is known.
void DeviationBound::findReaches() {
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
    of_parent = std::max(of_parent, reach + links_.offset(index));
  }
}

/// Bounds the displacement, by a link's own joint, of bodies on or behind the link.
double DeviationBound::displacementBy(int index, const VectorXd& from, const VectorXd& to,
                                      const VectorXd& deviation) const {
  const KinematicModel::Link& link = model_->links[std::size_t(index)];
  const double scale = std::abs(link.scale);
  double displacement = 0.;
  int dof = link.dof;
  for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
    const MotionStep& step = model_->steps[std::size_t(s)];
    const int dofs = step.dofs();
    if (step.translates()) {
      displacement += scale * std::abs(deviation[dof]);
    } else if (step.rotates()) {
      displacement += scale * std::abs(deviation[dof]) * reach_[std::size_t(s)];
    } else if (step.orients()) {
      const double off = deviation.segment(dof, dofs).norm(),
                   least = leastNorm(from.segment(dof, dofs), to.segment(dof, dofs));
      const double angle = off < least ? 2. * std::asin(off / least) : std::numbers::pi;
      if (off > 0.) displacement += std::min(angle, std::numbers::pi) * reach_[std::size_t(s)];
    }
    dof += dofs;
  }
  return displacement;
}

double DeviationBound::of(const VectorXd& from, const VectorXd& to, const VectorXd& deviation) {
  for (int index = 1; index < int(model_->links.size()); ++index) {
    const int parent = model_->links[std::size_t(index)].parent;
    displacement_[std::size_t(index)] = displacement_[std::size_t(parent)] + displacementBy(index, from, to, deviation);
  }
  double most = 0.;
  for (const auto& [a, b, common] : pairs_) {
    const double apart =
        displacement_[std::size_t(a)] + displacement_[std::size_t(b)] - 2. * displacement_[std::size_t(common)];
    most = std::max(most, apart);
  }
  return most;
}

// --- near a configuration ----------------------------------------------------------------------------------------

double displacementBound(const State& state, const VectorXd& change, const VectorXd& spread) {
  const KinematicModel& model = state.model();
  double most = 0.;
  for (std::size_t frame = 0; frame < model.body.size(); ++frame) {
    const auto& body = model.body[frame];
    if (!body || !state.moves(int(frame))) continue;
    const Vector3d center = state.pose(int(frame)) * body->boundCenter();
    double displacement = 0., moved = 0.;  // `moved`: relative to the present joint, by the joints visited before
    state.forTwists(int(frame), [&](int dof, const State::Twist& twist) {
      const double rotation = twist.angular.norm();
      const double speed =
          (twist.linear + twist.angular.cross(center)).norm() + rotation * (body->boundRadius() + moved);
      displacement += std::abs(change[dof]) * speed;
      moved += spread[dof] * speed;
    });
    most = std::max(most, state.hasCurvature(int(frame)) ? displacement : kWithoutProof * displacement);
  }
  return most;
}

}  // namespace kinegraph::inline collision_internal
