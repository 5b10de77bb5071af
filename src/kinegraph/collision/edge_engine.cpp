#include "kinegraph/collision/edge_engine.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/geometry/distance/cell_distance.h"

namespace kinegraph::inline collision_internal {

namespace {

constexpr double kPiece = .35;  // m: largest displacement of a point in one piece of an edge
constexpr int kMostPieces = 4096;
constexpr int kDeepest = 26;      // halvings of an interval
constexpr double kExact = 1e-12;  // m, beyond the margin: gap along a direction of an earlier check

/// Whether distances to other such bodies have a closed form.
bool hasClosedForm(const CollisionBody& body) { return body.core() <= CollisionBody::Core::box; }

}  // namespace

EdgeEngine::EdgeEngine(const State& scene, double tolerance)
    : scene_(scene),
      bodies_(scene),
      samples_(scene, bodies_),
      bounds_(scene),
      group_rates_(std::size_t(bodies_.moving)),
      body_rates_(bodies_.bodies.size()),
      tolerance_(tolerance),
      normals_(bodies_.pairs.size()),
      middles_(kDeepest),
      from_(scene.dofs()),
      to_(scene.dofs()),
      q_(scene.dofs()),
      hit_q_(scene.dofs()) {
  candidates_.reserve(bodies_.pairs.size());
  piece_times_.reserve(kLanes);
}

// --- one pair at one time --------------------------------------------------------------------------------------------

EdgeEngine::Normal& EdgeEngine::normalOf(const Candidate& candidate) {
  if (candidate.index >= 0) return normals_[std::size_t(candidate.index)];
  scratch_normal_.stamp = -1;
  scratch_normal_.corners = {};
  return scratch_normal_;
}

RigidTransform EdgeEngine::linkAt(int link, const Moment& at) const {
  return at.state ? at.state->linkPose(link) : samples_.linkPose(link, at.sample);
}

RigidTransform EdgeEngine::poseAt(int body, const Moment& at) {
  if (!at.state) return samples_.pose(body, at.sample);
  return at.state->linkPose(bodies_.link(body)) * bodies_.bodies[std::size_t(body)].X_LB;
}

/// The gap of the bodies along the direction, a lower bound of their distance.
double EdgeEngine::gap(const Candidate& candidate, Normal& normal, const Moment& at) {
  const LinkBodies::Pair& pair = candidate.pair;
  const CollisionBody &a = *bodies_.bodies[std::size_t(pair.a)].shape, &b = *bodies_.bodies[std::size_t(pair.b)].shape;
  const Vector3d n = pair.ancestor == 0 ? normal.n : Vector3d(linkAt(pair.ancestor, at).R * normal.n);
  const RigidTransform X_A = poseAt(pair.a, at), X_B = poseAt(pair.b, at);
  const Vector3d in_a = -(X_A.R.transpose() * n), in_b = X_B.R.transpose() * n;
  const double nearest_a = n.dot(X_A.p) - in_a.dot(supportNear(a, in_a, normal.corners.a)),
               farthest_b = n.dot(X_B.p) + in_b.dot(supportNear(b, in_b, normal.corners.b));
  return nearest_a - farthest_b - a.radius() - b.radius();
}

/// The gaps in all samples; recomputed if the direction has changed.
const EdgeEngine::Lane& EdgeEngine::gapsIn(SampleGaps& known, const Candidate& candidate, Normal& normal) {
  if (known.known && known.n == normal.n) return known.gaps;
  const LinkBodies::Pair& pair = candidate.pair;
  known = {normal.n, samples_.gaps(pair.a, pair.b, normal.n, pair.ancestor, normal.corners), true};
  return known.gaps;
}

/// Computes the distance, and keeps its normal.
double EdgeEngine::measure(const Candidate& candidate, Normal& normal, const Moment& at) {
  const LinkBodies::Pair& pair = candidate.pair;
  const Proximity near = proximity(*bodies_.bodies[std::size_t(pair.a)].shape, poseAt(pair.a, at),
                                   *bodies_.bodies[std::size_t(pair.b)].shape, poseAt(pair.b, at));
  normal.n = pair.ancestor == 0 ? near.normal : Vector3d(linkAt(pair.ancestor, at).R.transpose() * near.normal);
  normal.stamp = stamp_;
  return near.distance;
}

/// The same for solid cells, but any number of at least `most` if the distance is that large. Keeps no normal then.
double EdgeEngine::measureUpTo(double most, const Candidate& candidate, Normal& normal, const Moment& at) {
  if (!candidate.cells) return measure(candidate, normal, at);
  const LinkBodies::Pair& pair = candidate.pair;
  const CollisionBody &a = *bodies_.bodies[std::size_t(pair.a)].shape, &b = *bodies_.bodies[std::size_t(pair.b)].shape;
  return a.convex() ? distanceToCells(a, poseAt(pair.a, at), b, poseAt(pair.b, at), most)
                    : distanceToCells(b, poseAt(pair.b, at), a, poseAt(pair.a, at), most);
}

/// Whether separateCells may be asked: not for overlaps.
bool EdgeEngine::usesSeparation(const Candidate& candidate, double margin) const {
  if (!candidate.cells) return false;
  const CollisionBody &a = *bodies_.bodies[std::size_t(candidate.pair.a)].shape,
                      &b = *bodies_.bodies[std::size_t(candidate.pair.b)].shape;
  return margin + (a.convex() ? a : b).radius() > 0.;
}

/// Whether a convex body keeps the margin from solid cells between two times, or at one time if they are equal.
CellVerdict EdgeEngine::separateCells(const Candidate& candidate, const Moment& a, const Moment& b, double margin,
                                      const DisplacementBound::Rates& rates) {
  const LinkBodies::Pair& pair = candidate.pair;
  const bool first = bodies_.bodies[std::size_t(pair.a)].shape->convex();
  const int convex = first ? pair.a : pair.b, cells = first ? pair.b : pair.a;
  const RigidTransform to_cells = poseAt(cells, a).inverse(), begin = to_cells * poseAt(convex, a);
  const CollisionBody &body = *bodies_.bodies[std::size_t(convex)].shape,
                      &grid = *bodies_.bodies[std::size_t(cells)].shape;
  if (a.time == b.time) return separateFromCells({body, grid, begin, begin}, margin);
  const double width = b.time - a.time, bow = .125 * rates.curvature * width * width;
  const bool fixed = bodies_.link(cells) == pair.ancestor;  // else directions in it are not fixed in the ancestor
  const RigidTransform end = (fixed ? to_cells : poseAt(cells, b).inverse()) * poseAt(convex, b);
  return separateFromCells({body, grid, begin, end, rates.speed * width, fixed && bow < 1e9 ? bow : kFar}, margin);
}

/// Tries to decide whether the pair is at least `margin` apart. Keeps the separating direction if it is.
EdgeEngine::Verdict EdgeEngine::separate(const Candidate& candidate, Normal& normal, const Moment& at, double margin) {
  if (usesSeparation(candidate, margin))
    return separateCells(candidate, at, at, margin, {}).kind == CellVerdict::apart ? Verdict::apart : Verdict::near;
  const LinkBodies::Pair& pair = candidate.pair;
  const CollisionBody &a = *bodies_.bodies[std::size_t(pair.a)].shape, &b = *bodies_.bodies[std::size_t(pair.b)].shape;
  if (!pair.convex || (hasClosedForm(a) && hasClosedForm(b))) return Verdict::unknown;
  const auto found = separation(a, poseAt(pair.a, at), b, poseAt(pair.b, at), margin, normal.corners);
  if (!found) return Verdict::unknown;
  if (!found->apart) return Verdict::near;
  normal.n = pair.ancestor == 0 ? found->normal : Vector3d(linkAt(pair.ancestor, at).R.transpose() * found->normal);
  normal.stamp = stamp_;
  return Verdict::apart;
}

/// Whether the pair is closer than the margin.
bool EdgeEngine::isNear(const Candidate& candidate, Normal& normal, const Moment& at, double margin) {
  const Verdict verdict = separate(candidate, normal, at, margin);
  return verdict == Verdict::unknown ? measure(candidate, normal, at) < margin : verdict == Verdict::near;
}

const std::optional<MotionContact>& EdgeEngine::measuredHit() {
  if (last_hit_ && std::isnan(last_hit_->distance)) {
    scene_.setJoints(hit_q_.data());
    const auto a = std::size_t(last_hit_->a), b = std::size_t(last_hit_->b);
    const auto& bodies = scene_.model().body;
    last_hit_->distance =
        proximity(*bodies[a], scene_.pose(last_hit_->a), *bodies[b], scene_.pose(last_hit_->b)).distance;
  }
  return last_hit_;
}

/// Records a collision at joints q. Returns false.
bool EdgeEngine::hit(const Candidate& candidate, double time, const double* q, double distance) {
  const int a = bodies_.bodies[std::size_t(candidate.pair.a)].frame,
            b = bodies_.bodies[std::size_t(candidate.pair.b)].frame;
  last_hit_ = MotionContact{time, std::min(a, b), std::max(a, b), distance, -1};
  hit_q_ = Eigen::Map<const VectorXd>(q, hit_q_.size());
  suspect_ = candidate.index;
  return false;
}

// --- configurations --------------------------------------------------------------------------------------------------

void EdgeEngine::areFree(const double* const* Q, int count, double margin, bool* free) {
  std::fill(free, free + count, true);
  forHits(Q, count, margin, true, [free](int sample) {
    free[sample] = false;
    return true;
  });
}

bool EdgeEngine::areAllFree(const double* const* Q, int count, double margin) {
  bool all_free = true;
  forHits(Q, count, margin, false, [&](int) { return all_free = false; });
  return all_free;
}

/// Calls hit(sample) once per sample in collision, until it returns false. Checks the pair of the last collision first,
/// before the broad phase. If not `all`, one collision is enough.
template <class Hit>
void EdgeEngine::forHits(const double* const* Q, int count, double margin, bool all, const Hit& hit_sample) {
  last_hit_.reset();
  for (int i = 0; i < count; ++i) samples_.setJoints(i, Q[i]);
  samples_.place(count);
  const double near = all ? -kFar : margin;
  const auto hitAtOnce = [&](const Candidate& candidate) {
    hit(candidate, 0., Q[candidate.touching]);
    hit_sample(candidate.touching);
  };
  bool was_hit[kLanes] = {};
  if (suspect_ >= 0) {
    candidates_.clear();
    if (addPair(bodies_.pairs[std::size_t(suspect_)], suspect_, margin, near)) return hitAtOnce(candidates_.front());
    if (!candidates_.empty() && !checkPair(candidates_.front(), Q, count, margin, was_hit, hit_sample)) return;
  }
  if (const Candidate* touching = findCandidates(margin, margin, near)) return hitAtOnce(*touching);
  for (const Candidate& candidate : candidates_) {
    if (!checkPair(candidate, Q, count, margin, was_hit, hit_sample)) return;
  }
}

/// Checks one pair in all samples without a collision so far.
template <class Hit>
bool EdgeEngine::checkPair(const Candidate& candidate, const double* const* Q, int count, double margin, bool* was_hit,
                           const Hit& hit_sample) {
  Normal& normal = normalOf(candidate);
  SampleGaps gaps;
  for (int i = 0; i < count; ++i) {
    if (was_hit[i] || candidate.bounds[i] >= margin) continue;
    if (candidate.pair.convex && normal.stamp > 0 && gapsIn(gaps, candidate, normal)[i] >= margin + kExact) continue;
    if (!isNear(candidate, normal, sampleAt(i), margin)) continue;
    hit(candidate, 0., Q[i]);
    was_hit[i] = true;
    if (!hit_sample(i)) return false;
  }
  return true;
}

double EdgeEngine::clearance(const double* q, double most) {
  samples_.setJoints(0, q);
  samples_.place(1);
  findCandidates(most);
  for (const Candidate& candidate : candidates_) {
    if (candidate.least < most) most = std::min(most, measureUpTo(most, candidate, normalOf(candidate), sampleAt(0)));
  }
  return most;
}

// --- edges -----------------------------------------------------------------------------------------------------------

EdgeEngine::Moment EdgeEngine::sampleAt(int sample) const {
  const double time = piece_times_.empty() ? 0. : piece_times_[std::size_t(sample)];
  return {time, nullptr, sample};
}

const double* EdgeEngine::jointsAt(double time) {
  if (time == 1.) return to_.data();
  q_.noalias() = from_ + time * (to_ - from_);
  return q_.data();
}

EdgeEngine::Moment EdgeEngine::between(const Moment& a, const Moment& b, int depth) {
  return momentAt(.5 * (a.time + b.time), depth);
}

EdgeEngine::Moment EdgeEngine::momentAt(double time, int depth) {
  std::unique_ptr<State>& state = middles_[std::size_t(depth)];
  if (!state) state = std::make_unique<State>(scene_);
  state->setJoints(jointsAt(time));
  return {time, state.get(), 0};
}

/// Places the samples over a piece of the edge. The spheres also contain the motion between samples.
void EdgeEngine::placePiece(double from, double to) {
  piece_times_.resize(kLanes);
  for (int i = 0; i < kLanes; ++i) {
    piece_times_[std::size_t(i)] = i == kLanes - 1 ? to : from + (to - from) * i / (kLanes - 1);
    samples_.setJoints(i, jointsAt(piece_times_[std::size_t(i)]));
  }
  samples_.place(kLanes);
  const double width = (to - from) / (kLanes - 1);
  for (int g = 0; g < bodies_.moving; ++g) {
    const DisplacementBound::Rates& rates = group_rates_[std::size_t(g)];
    samples_.setDeviation(g, std::min(.125 * rates.curvature * width * width, .5 * rates.speed * width));
  }
}

/// Returns the number of pieces in which the edge is checked.
int EdgeEngine::setEdge(const double* from, const double* to) {
  from_ = Eigen::Map<const VectorXd>(from, from_.size());
  to_ = Eigen::Map<const VectorXd>(to, to_.size());
  bounds_.setEdge(from, to);
  double speed = 0.;
  for (int g = 0; g < bodies_.moving; ++g) {
    const LinkBodies::Group& group = bodies_.groups[std::size_t(g)];
    group_rates_[std::size_t(g)] = bounds_.ratesOf(group.link, group.center.norm());
    speed = std::max(speed, bounds_.ratesOf(group.link, group.reach).speed);
  }
  return std::isfinite(speed) ? int(std::clamp(std::ceil(speed / kPiece), 1., double(kMostPieces))) : 1;
}

/// The rates of the points of both bodies relative to each other.
DisplacementBound::Rates EdgeEngine::ratesOf(const Candidate& candidate) {
  const auto [a, b] = std::pair(candidate.pair.a, candidate.pair.b);
  if (candidate.pair.ancestor == 0) {
    const DisplacementBound::Rates &of_a = ratesInWorld(a), &of_b = ratesInWorld(b);
    return {of_a.speed + of_b.speed, of_a.curvature + of_b.curvature, of_a.reach + of_b.reach};
  }
  return bounds_.relativeRates(bodies_.link(a), bodies_.bodies[std::size_t(a)].reach, bodies_.link(b),
                               bodies_.bodies[std::size_t(b)].reach);
}

const DisplacementBound::Rates& EdgeEngine::ratesInWorld(int body) {
  BodyRates& known = body_rates_[std::size_t(body)];
  if (known.stamp != stamp_)
    known = {stamp_, bounds_.ratesOf(bodies_.link(body), bodies_.bodies[std::size_t(body)].reach)};
  return known.rates;
}

bool EdgeEngine::isFree(const double* from, const double* to, double margin) {
  beginCheck();
  const int pieces = setEdge(from, to);
  const auto touches = [&] {
    const Candidate* touching = findCandidates(margin, kFar, margin);
    if (!touching) return false;
    const double time = sampleAt(touching->touching).time;
    hit(*touching, time, jointsAt(time));
    return true;
  };
  if (pieces > 1) {  // coarse check of the whole edge
    placePiece(0., 1.);
    if (touches() || !samplesKeep(margin)) return false;
  }
  for (int i = pieces - 1; i >= 0; --i) {
    placePiece(double(i) / pieces, i + 1 == pieces ? 1. : double(i + 1) / pieces);
    if (touches() || !pieceKeeps(margin)) return false;
  }
  return true;
}

/// Whether all pairs keep the margin in all samples.
bool EdgeEngine::samplesKeep(double margin) {
  for (const Candidate& candidate : candidates_) {
    if (candidate.least >= margin) continue;
    Normal& normal = normalOf(candidate);
    SampleGaps gaps;
    for (int i = kLanes - 1; i >= 0; --i) {
      if (candidate.bounds[i] >= margin) continue;
      const Moment at = sampleAt(i);
      if (candidate.pair.convex && normal.stamp == stamp_ && gapsIn(gaps, candidate, normal)[i] >= margin) continue;
      if (isNear(candidate, normal, at, margin)) return hit(candidate, at.time, jointsAt(at.time));
    }
  }
  return true;
}

bool EdgeEngine::pieceKeeps(double margin) {
  const double width = piece_times_[1] - piece_times_[0];
  for (const Candidate& candidate : candidates_) {
    if (!pairKeeps(candidate, margin, width)) return false;
  }
  return true;
}

/// Whether a pair keeps the margin between all samples.
bool EdgeEngine::pairKeeps(const Candidate& candidate, double margin, double width) {
  const DisplacementBound::Rates rates = ratesOf(candidate);
  const double bow = .125 * rates.curvature * width * width;
  const auto farBetween = [&](int i) {
    return candidate.bounds[i] + candidate.bounds[i + 1] - rates.speed * width >= 2. * margin;
  };
  int worst = 0;
  candidate.bounds.minCoeff(&worst);
  Normal& normal = normalOf(candidate);
  if (candidate.least < margin) {  // the sample that is most likely in collision
    const Moment at = sampleAt(worst);
    const bool is_apart = bow < 1e9 && separate(candidate, normal, at, margin + bow) == Verdict::apart;
    if (!is_apart && isNear(candidate, normal, at, margin)) return hit(candidate, at.time, jointsAt(at.time));
  }
  SampleGaps gaps;
  const auto apartBetween = [&](int i) {
    if (!candidate.pair.convex || bow >= 1e9 || normal.stamp != stamp_) return false;
    const Lane& of = gapsIn(gaps, candidate, normal);
    return of[i] >= margin + bow && of[i + 1] >= margin + bow;
  };
  for (int i = 0; i + 1 < kLanes; ++i) {
    if (farBetween(i) || apartBetween(i)) continue;
    if (!keeps(candidate, normal, rates, margin, sampleAt(i), sampleAt(i + 1), 0)) return false;
  }
  return true;
}

bool EdgeEngine::keeps(const Candidate& candidate, Normal& normal, const DisplacementBound::Rates& rates, double margin,
                       const Moment& a, const Moment& b, int depth) {
  const double width = b.time - a.time, bow = .125 * rates.curvature * width * width;
  const auto apart = [&] {
    return gap(candidate, normal, a) >= margin + bow && gap(candidate, normal, b) >= margin + bow;
  };
  if (usesSeparation(candidate, margin)) {
    const CellVerdict verdict = separateCells(candidate, a, b, margin, rates);
    if (verdict.kind == CellVerdict::apart) return true;
    const Moment& near = verdict.kind == CellVerdict::near_end ? b : a;
    if (verdict.kind != CellVerdict::unknown || verdict.distance < margin + tolerance_ || depth == kDeepest)
      return hit(candidate, near.time, jointsAt(near.time));
    const Moment middle = between(a, b, depth);
    return keeps(candidate, normal, rates, margin, a, middle, depth + 1) &&
           keeps(candidate, normal, rates, margin, middle, b, depth + 1);
  }
  const bool convex = candidate.pair.convex && bow < 1e9;
  if (convex && normal.stamp == stamp_ && apart()) return true;
  for (const Moment* end : {&a, &b}) {
    if (convex && separate(candidate, normal, *end, margin + bow) == Verdict::apart && apart()) return true;
  }
  double distances[2];
  for (const bool second : {false, true}) {
    const Moment& end = second ? b : a;
    const double distance = distances[second] = measure(candidate, normal, end);
    if (distance < margin) return hit(candidate, end.time, jointsAt(end.time), distance);
    if (convex && apart()) return true;
    if (distance < margin + tolerance_ && rates.speed > 0.)
      return hit(candidate, end.time, jointsAt(end.time), distance);
  }
  if (distances[0] + distances[1] - rates.speed * width >= 2. * margin) return true;
  if (depth == kDeepest) return hit(candidate, a.time, jointsAt(a.time), distances[0]);
  const Moment middle = between(a, b, depth);
  return keeps(candidate, normal, rates, margin, a, middle, depth + 1) &&
         keeps(candidate, normal, rates, margin, middle, b, depth + 1);
}

double EdgeEngine::clearance(const double* from, const double* to, double most) {
  beginCheck();
  const int pieces = setEdge(from, to);
  double least = most;
  for (int piece = 0; piece < pieces; ++piece) {
    placePiece(double(piece) / pieces, double(piece + 1) / pieces);
    findCandidates(least);
    for (const Candidate& candidate : candidates_) {
      Normal& normal = normalOf(candidate);
      const DisplacementBound::Rates rates = ratesOf(candidate);
      const double width = piece_times_[1] - piece_times_[0];
      for (int i = 0; i + 1 < kLanes; ++i) {
        if (.5 * (candidate.bounds[i] + candidate.bounds[i + 1] - rates.speed * width) < least - tolerance_)
          lower(candidate, normal, rates, sampleAt(i), sampleAt(i + 1), 0, least);
      }
    }
  }
  return least - tolerance_;
}

/// Lowers `least` to the least distance of a pair between two times, to the tolerance.
void EdgeEngine::lower(const Candidate& candidate, Normal& normal, const DisplacementBound::Rates& rates,
                       const Moment& a, const Moment& b, int depth, double& least) {
  const double width = b.time - a.time, bow = .125 * rates.curvature * width * width;
  double sum = 0., along = -std::numeric_limits<double>::infinity();
  for (const Moment* end : {&a, &b}) {
    const double distance = measureUpTo(least + .5 * rates.speed * width, candidate, normal, *end);
    least = std::min(least, distance);
    sum += distance;
    if (candidate.pair.convex)
      along = std::max(along, std::min(gap(candidate, normal, a), gap(candidate, normal, b)) - bow);
  }
  if (std::max(.5 * (sum - rates.speed * width), along) >= least - tolerance_ || depth == kDeepest) return;
  const Moment middle = between(a, b, depth);
  lower(candidate, normal, rates, a, middle, depth + 1, least);
  lower(candidate, normal, rates, middle, b, depth + 1, least);
}

}  // namespace kinegraph::inline collision_internal
