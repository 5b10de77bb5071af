#include "kinegraph/planning/dynamic_obstacles/dynamic_check.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/collision/displacement_bound.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr double kLongest = .1;     // s, of a piece that is checked as a whole
constexpr double kBriefest = 1e-6;  // s

}  // namespace

DynamicCheck::DynamicCheck(const DynamicScene& scene, double margin)
    : scene_(&scene), margin_(margin), state_(scene.state()), edges_(scene.state(), margin, kTolerance) {}

bool DynamicCheck::isFree(const VectorXd& q, double t) {
  ++evaluations;
  edges_.setMargin(margin_);
  return edges_.isFree(scene_->at(q, t).data());
}

bool DynamicCheck::staysFree(const VectorXd& q, double begin, double end) {
  ++evaluations;
  edges_.setMargin(margin_);
  return edges_.isFree(scene_->at(q, begin).data(), scene_->at(q, end).data());
}

double DynamicCheck::clearance(const VectorXd& q, double t, double most) {
  ++evaluations;
  return edges_.clearance(scene_->at(q, t).data(), most);
}

std::pair<int, int> DynamicCheck::lastPair() const {
  const auto& hit = edges_.lastHit();
  return hit ? std::pair(hit->a, hit->b) : std::pair(0, 0);
}

DynamicCheck::Moment DynamicCheck::momentOf(const Piece& piece, double time) const {
  const ScalingState state = piece.phase.at(time - piece.phase.time);
  const double place = std::clamp(state.s, piece.phase.begin.s, piece.phase.end);
  Moment moment{time, VectorXd(piece.curve.dofs()), place, state.acceleration};
  piece.curve.eval(piece.phase.piece, place, 0, moment.q.data());
  return moment;
}

/// Bounds the distance of points of the robot from their places on the chord between two moments.
double DynamicCheck::slackOf(const Piece& piece, const Moment& from, const Moment& to) {
  const double share = (to.time - from.time) * (to.time - from.time) / 8.;
  const double most = std::max(std::abs(from.acceleration), std::abs(to.acceleration));  // between them s'' is monotone
  const VectorXd deviation = share * (piece.tangent.size() > 0 ? VectorXd(most * piece.tangent) : piece.acceleration);
  if (deviation.isZero(0.)) return 0.;
  const VectorXd spread = .5 * (to.q - from.q).cwiseAbs() + deviation;  // from the closer moment
  double displacement = 0.;
  for (const Moment* moment : {&from, &to}) {
    const VectorXd all = scene_->at(moment->q, 0.);
    state_.setJoints(all.data());
    displacement =
        std::max(displacement, displacementBound(state_, scene_->changeOf(deviation), scene_->changeOf(spread)));
  }
  return displacement;
}

std::optional<DynamicContact> DynamicCheck::contactIn(const Piece& piece, const Moment& from, const Moment& to) {
  const double slack = slackOf(piece, from, to);
  ++evaluations;
  edges_.setMargin(margin_ + slack);
  const VectorXd begin = scene_->at(from.q, piece.start + from.time), end = scene_->at(to.q, piece.start + to.time);
  if (edges_.isFree(begin.data(), end.data())) return std::nullopt;
  if (slack < kLeastSlack || to.time - from.time < kBriefest) {
    const MotionContact& hit = *edges_.lastHit();
    return DynamicContact{piece.start + from.time, hit.a, hit.b, from.place};
  }
  const Moment middle = momentOf(piece, .5 * (from.time + to.time));
  if (const auto contact = contactIn(piece, from, middle)) return contact;
  return contactIn(piece, middle, to);
}

std::optional<DynamicContact> DynamicCheck::contact(const PathCurve& curve, const TimeScaling& scaling,
                                                    const VectorXd& acceleration, double start) {
  const std::vector<ScalingPhase>& phases = scaling.phases();
  for (std::size_t i = 0; i < phases.size(); ++i) {
    Piece piece{curve, phases[i], acceleration, start};
    if (curve.pieces() > 0 && curve.isLine(phases[i].piece)) {
      piece.tangent.resize(curve.dofs());
      curve.eval(phases[i].piece, phases[i].begin.s, 1, piece.tangent.data());
      piece.tangent = piece.tangent.cwiseAbs();
    }
    const double begin = phases[i].time, end = i + 1 < phases.size() ? phases[i + 1].time : scaling.duration();
    const ScalingState& scaling_begin = phases[i].begin;
    const bool waits = scaling_begin.speed == 0. && scaling_begin.acceleration == 0. && scaling_begin.jerk == 0.;
    std::vector<double> times = {begin};
    const auto add = [&](double until) {
      const double from = times.back();
      const int parts = waits ? 1 : std::max(1, int(std::ceil((until - from) / kLongest)));
      for (int k = 1; k <= parts; ++k) times.push_back(k == parts ? until : from + k * (until - from) / parts);
    };
    const std::vector<double>& breaks = scene_->breaks();
    for (auto next = std::upper_bound(breaks.begin(), breaks.end(), start + begin);
         next != breaks.end() && *next < start + end; ++next)
      add(*next - start);
    add(end);
    Moment from = momentOf(piece, begin);
    for (std::size_t k = 1; k < times.size(); ++k) {
      if (times[k] <= times[k - 1]) continue;
      const Moment to = momentOf(piece, times[k]);
      if (const auto contact = contactIn(piece, from, to)) return contact;
      from = to;
    }
  }
  return std::nullopt;
}

}  // namespace kinegraph::inline planning_internal
