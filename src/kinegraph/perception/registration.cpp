#include "kinegraph/perception/registration.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Cholesky>

namespace kinegraph::inline perception_internal {

namespace {

constexpr double kExplained = .005;    // m, distance of a point from the surface that explains it
constexpr double kSure = 3.;           // standard deviations for agreement
constexpr double kSameResult = .0007;  // m, mean distance of two poses of one shape that look the same
constexpr double kNearlySame = .004;   // m, the same for a shape that is nearly symmetric
constexpr double kWrongScore = .35;    // below, other resting poses and rotations are tried
constexpr double kOverlap = .05;       // share of a surface inside of another thing
constexpr double kSamePlace = .3;      // the same: two things cannot be there

constexpr double kLastHeight = .1;  // value of resting at the height of the last pose

/// Whether a thing rests at the height at which it rested in its last pose.
bool isAtLastHeight(const Thing& thing, const RigidTransform& X) {
  constexpr double kSameHeight = .001;  // m
  const double bottom = X.p.z() - thing.shape.extent(X.R.transpose() * -Vector3d::UnitZ());
  return thing.height_of_place && std::abs(bottom - *thing.height_of_place) < kSameHeight;
}

}  // namespace

double meanDistance(const VisibleShape& shape, const RigidTransform& a, const RigidTransform& b) {
  const std::size_t count = std::min<std::size_t>(100, shape.samples().size());
  double sum = 0.;
  for (std::size_t i = 0; i < count; ++i)
    sum += std::abs(shape.nearest(a.R.transpose() * (b * shape.samples()[i] - a.p)).distance);
  return sum / double(count);
}

bool isSymmetry(const VisibleShape& shape, const RigidTransform& given) {
  constexpr double kNear = .005, kExact = .0001;  // m
  constexpr std::size_t kFew = 12, kRounds = 5;
  const std::vector<Vector3d>& samples = shape.samples();
  RigidTransform X = given;
  double mean = 0.;
  for (std::size_t round = 0; round < kRounds; ++round) {  // Gauss-Newton on the distances of moved samples
    const std::size_t count = std::min<std::size_t>(round == 0 ? kFew : 100, samples.size());
    Matrix6d A = 1e-6 * Matrix6d::Identity();
    Vector6d g = Vector6d::Zero();
    mean = 0.;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3d point = X * samples[i];
      SurfaceDistance near = shape.nearest(point);
      near.distance -= shape.nearest(samples[i]).distance;  // samples of round shapes are on facets
      Vector6d J;
      J << near.gradient, (point - X.p).cross(near.gradient);
      A += J * J.transpose();
      g += near.distance * J;
      mean += std::abs(near.distance) / double(count);
    }
    if (mean < kExact && round > 0) return true;
    if (mean > kNear) return false;
    if (round > 0) X = PoseFreedom().moved(X, -A.ldlt().solve(g));
  }
  return mean < kExact;
}

bool looksTheSame(const VisibleShape& shape, const RigidTransform& a, const RigidTransform& b) {
  constexpr double kSmallAngle = .3;  // rad
  if (meanDistance(shape, a, b) > kSameResult) return false;
  return Quaterniond(a.R).angularDistance(Quaterniond(b.R)) < kSmallAngle || isSymmetry(shape, a.inverse() * b);
}

void keepRotation(Thing& thing) {
  constexpr double kOther = .6, kNearer = 1e-6;  // rad
  const auto angle = [&](const Matrix3d& R) { return Quaterniond(R).angularDistance(Quaterniond(thing.last.R)); };
  if (thing.is_lost || angle(thing.best.X.R) < kOther) return;
  const Vector3d middle = thing.middle();
  RigidTransform nearest = thing.best.X;
  for (int i = 0; i < 24; ++i) {  // the rotations that exchange axes
    const int axis = i / 8, next = (axis + 1 + i % 2) % 3;
    Matrix3d Q;
    Q.col(0) = (i & 2 ? -1. : 1.) * Vector3d::Unit(axis);
    Q.col(1) = (i & 4 ? -1. : 1.) * Vector3d::Unit(next);
    Q.col(2) = Q.col(0).cross(Q.col(1));
    const RigidTransform turn{Q, middle - Q * middle}, X = thing.best.X * turn;
    if (angle(X.R) < angle(nearest.R) - kNearer && isSymmetry(thing.shape, turn)) nearest = X;
  }
  thing.best.X = nearest;
}

void Registration::run() {
  std::vector<int> free_for_all(points_.size(), -1);
  for (Thing& thing : things_) {
    if (!thing.is_lost) find(thing, -1, free_for_all);
  }
  const std::vector<int> owners = ownersOfPoints();
  for (std::size_t i = 0; i < things_.size(); ++i) {
    if (!things_[i].is_lost) find(things_[i], int(i), owners);
  }
  separate();
  if (tryDoubtful()) separate();
}

bool Registration::tryDoubtful() {
  bool has_changed = false;
  std::vector<int> owners = ownersOfPoints();
  for (std::size_t i = 0; i < things_.size(); ++i) {
    Thing& thing = things_[i];
    if (thing.is_lost || thing.anywhere || thing.is_displaced || thing.freedom.hasJoint()) continue;
    if (thing.score < kWrongScore || !isDoubtful(thing, owners)) continue;
    std::vector<PoseCandidate> candidates{thing.best};
    tryStarts(thing, int(i), owners, thing.best.X, true, candidates);
    std::sort(candidates.begin(), candidates.end(), [](auto& a, auto& b) { return a.value > b.value; });
    refine(thing, int(i), owners, candidates);
    owners = ownersOfPoints();
    has_changed = true;
  }
  return has_changed;
}

/// The share of a thing's surface in pose X that is inside of another one, or coincides with its surface.
double Registration::shareInside(const Thing& thing, const RigidTransform& X, const Thing& other,
                                 const RigidTransform& of_other) const {
  constexpr double kDeep = -.006, kOnSurface = .003;  // m
  constexpr double kSameSide = .5;                    // cosine between the normals
  if ((X.p - of_other.p).norm() > thing.shape.radius() + other.shape.radius()) return 0.;
  double inside = 0.;
  const RigidTransform change = of_other.inverse() * X;
  for (std::size_t i = 0; i < thing.shape.samples().size(); ++i) {
    const SurfaceDistance near = other.shape.nearest(change * thing.shape.samples()[i]);
    inside += near.distance < kDeep ||
              (near.distance < kOnSurface && near.gradient.dot(change.R * thing.shape.normals()[i]) > kSameSide);
  }
  return inside / double(thing.shape.samples().size());
}

bool Registration::overlap(const Thing& a, const RigidTransform& of_a, const Thing& b,
                           const RigidTransform& of_b) const {
  return std::max(shareInside(a, of_a, b, of_b), shareInside(b, of_b, a, of_a)) > kOverlap;
}

/// Points near a pose that no other thing owns, at most `most`.
FitPoints Registration::pointsNear(const Thing& thing, int index, const std::vector<int>& owners,
                                   const Vector3d& center, double reach, int most, int* thinning) const {
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const bool allowed = index < 0 || owners[i] < 0 || owners[i] == index;
    if (allowed && (points_[i].p - center).squaredNorm() < reach * reach) inside.push_back(i);
  }
  const std::size_t step = (inside.size() + std::size_t(most) - 1) / std::size_t(most);
  FitPoints out;
  for (std::size_t i = 0; i < inside.size(); i += std::max<std::size_t>(step, 1))
    out.measured.push_back(points_[inside[i]]);
  if (thinning) *thinning = std::max(1, int(step));
  if (index >= 0) addNeighbors(thing, index, center, out);
  return out;
}

std::vector<int> Registration::ownersOfPoints() const {
  std::vector<int> owners(points_.size(), -1);
  std::vector<double> least;
  for (const ObservedPoint& point : points_) least.push_back(std::max(.006, kSure * point.sigma));
  for (std::size_t k = 0; k < things_.size(); ++k) {
    const Thing& thing = things_[k];
    if (thing.score < .2) continue;
    const double reach = thing.shape.radius() + .02;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if ((points_[i].p - thing.best.X.p).squaredNorm() > reach * reach) continue;
      const double d =
          std::abs(thing.shape.nearest(thing.best.X.R.transpose() * (points_[i].p - thing.best.X.p)).distance);
      if (d >= least[i]) continue;
      least[i] = d;
      owners[i] = int(k);
    }
  }
  return owners;
}

void Registration::addNeighbors(const Thing& thing, int index, const Vector3d& center, FitPoints& out) const {
  for (std::size_t k = 0; k < things_.size(); ++k) {
    const Thing& other = things_[k];
    const double gap = (other.best.X.p - center).norm() - other.shape.radius() - thing.shape.radius();
    if (int(k) == index || other.score < kSureScore || gap > 0.) continue;
    for (std::size_t i = 0; i < other.shape.samples().size(); i += 4)
      out.keep_out.push_back(other.best.X * other.shape.samples()[i]);
  }
}

double Registration::explained(const Thing& thing, const FitPoints& points, const RigidTransform& X) const {
  if (points.measured.empty()) return 0.;
  double count = 0.;
  for (const ObservedPoint& point : points.measured)
    count += std::abs(thing.shape.nearest(X.R.transpose() * (point.p - X.p)).distance) <
             std::max(kExplained, kSure * point.sigma);
  return count / double(points.measured.size());
}

double Registration::explainedBeside(const Thing& thing, const std::vector<int>& owners) const {
  constexpr double kBeside = .015;  // m
  const RigidTransform& X = thing.best.X;
  const int index = int(&thing - things_.data());
  int count = 0, all = 0;
  for (std::size_t i = 0; i < points_.size(); i += 2) {
    const Vector3d arm = points_[i].p - X.p;
    const double reach = thing.shape.radius() + kBeside;
    if ((owners[i] >= 0 && owners[i] != index) || arm.squaredNorm() > reach * reach) continue;
    const double d = thing.shape.nearest(X.R.transpose() * arm).distance;
    if (d > kBeside) continue;
    ++all;
    count += std::abs(d) < std::max(kExplained, kSure * points_[i].sigma);
  }
  return all > 0 ? double(count) / all : 0.;
}

/// The mean squared distance of points from the surface, over their noise and at most 9.
double Registration::misfit(const Thing& thing, const FitPoints& points, const RigidTransform& X) const {
  double sum = 0.;
  std::vector<EyeInParts> eyes;
  for (const ObservedView& view : views_) eyes.push_back(thing.shape.eyeInParts(X.R.transpose() * (view.X_WC.p - X.p)));
  for (const ObservedPoint& point : points.measured) {
    const Vector3d local = X.R.transpose() * (point.p - X.p);
    const double d = thing.shape.facing(local, eyes[std::size_t(point.view)]).distance / point.sigma;
    sum += std::min(d * d, 9.);
  }
  return sum / double(std::max<std::size_t>(points.measured.size(), 1));
}

/// Adds the best pose with other rotations: those in which the shape is nearly the same, and if the last pose tells
/// nothing, all rotations about the vertical.
void Registration::addTurned(const Thing& thing, int index, const std::vector<int>& owners,
                             std::vector<PoseCandidate>& candidates) const {
  constexpr double kRight = 1.5707963267948966;
  if (thing.freedom.hasJoint() || thing.heights.empty()) return;
  const RigidTransform& best = thing.best.X;
  const Vector3d middle = thing.middle(), at = best * middle;
  const double height = best.p.z() - thing.shape.extent(best.R.transpose() * -Vector3d::UnitZ());
  std::vector<Matrix3d> rotations = thing.rotations;
  for (int i = 1; i < 4; ++i)
    rotations.push_back(Eigen::AngleAxisd(kRight * i, Vector3d::UnitZ()).toRotationMatrix() * best.R);
  std::optional<FitPoints> points;
  for (const Matrix3d& rotation : rotations) {
    RigidTransform X = restingPose(thing.shape, {rotation, at - rotation * middle}, height);
    const bool is_upright = (rotation * best.R.transpose())(2, 2) > .99;
    const bool is_wanted = is_upright && thing.anywhere;
    if (!is_wanted && meanDistance(thing.shape, best, X) > 2. * kNearlySame) continue;
    if (looksTheSame(thing.shape, best, X)) continue;
    if (!points) points = pointsNear(thing, index, owners, best.p, thing.shape.radius() + .02, kCoarsePoints);
    fitPose(thing.shape, thing.freedom, *points, views_, kCoarseWidths, kCoarseSamples, X);
    if (!is_wanted && meanDistance(thing.shape, best, X) > kNearlySame) continue;
    candidates.push_back({X, valueOf(thing, index, *points, X), 0.});
  }
}

/// `index` < 0: other things do not count.
double Registration::valueOf(const Thing& thing, int index, const FitPoints& points, const RigidTransform& X) const {
  double value = countSurface(thing.shape, X, views_, kFineSamples).score() + 2. * explained(thing, points, X);
  if (isAtLastHeight(thing, X)) value += kLastHeight;
  for (const Thing& other : things_) {
    if (index >= 0 && &other != &thing && other.score >= kSureScore)
      value -= 2. * shareInside(thing, X, other, other.best.X);
  }
  return value;
}

/// Looks again for a thing that overlaps another one, without the points of the other; then for the other one, with
/// all of its points. Whether the thing is elsewhere.
bool Registration::moveAway(Thing& thing, Thing& stayed, double least_score) {
  const PoseCandidate best = thing.best;
  const std::vector<PoseCandidate> others = thing.others;
  const double score = thing.score;
  thing.score = -2.;
  find(thing, int(&thing - things_.data()), ownersOfPoints());
  if (thing.score > least_score && !overlap(thing, thing.best.X, stayed, stayed.best.X)) {
    stayed.score = -2.;  // it may have been fitted without the points that the two shared
    find(stayed, int(&stayed - things_.data()), ownersOfPoints());
    return true;
  }
  thing.best = best;
  thing.others = others;
  thing.score = score;
  return false;
}

/// Separates things that overlap: the worse one is elsewhere, or else the better one, or the worse one is not seen.
void Registration::separate() {
  for (std::size_t a = 0; a < things_.size(); ++a) {
    for (std::size_t b = a + 1; b < things_.size(); ++b) {
      if (std::min(things_[a].score, things_[b].score) < .2 ||
          !overlap(things_[a], things_[a].best.X, things_[b], things_[b].best.X))
        continue;
      const bool a_is_worse = things_[a].best.value < things_[b].best.value;
      Thing &worse = things_[a_is_worse ? a : b], &better = things_[a_is_worse ? b : a];
      if (moveAway(worse, better, .2) || moveAway(better, worse, kSureScore)) continue;
      const double inside = std::max(shareInside(worse, worse.best.X, better, better.best.X),
                                     shareInside(better, better.best.X, worse, worse.best.X));
      if (inside < kSamePlace) continue;
      worse.best = {worse.start, -2., 0.};
      worse.others.clear();
      worse.score = -2.;
      worse.is_displaced = true;
    }
  }
}

void Registration::find(Thing& thing, int index, const std::vector<int>& owners) {
  std::vector<PoseCandidate> candidates;
  const bool again = index >= 0;
  if (again) {
    const FitPoints near =
        pointsNear(thing, index, owners, thing.start.p, thing.shape.radius() + thing.search, kFinePoints);
    candidates.push_back({thing.best.X, valueOf(thing, index, near, thing.best.X), 0.});
  }
  if (again) addTurned(thing, index, owners, candidates);
  if (!again || thing.score < kSureScore || thing.anywhere)
    tryStarts(thing, index, owners, thing.start, false, candidates);
  std::sort(candidates.begin(), candidates.end(), [](auto& a, auto& b) { return a.value > b.value; });
  refine(thing, index, owners, candidates);
  if (!again || thing.score >= kWrongScore || thing.freedom.hasJoint() || thing.anywhere) return;
  candidates.assign(1, thing.best);
  tryStarts(thing, index, owners, thing.start, true, candidates);
  std::sort(candidates.begin(), candidates.end(), [](auto& a, auto& b) { return a.value > b.value; });
  refine(thing, index, owners, candidates);
}

/// Refines the best candidates that differ; `thing.others` are those about as good that look different.
void Registration::refine(Thing& thing, int index, const std::vector<int>& owners,
                          const std::vector<PoseCandidate>& candidates) {
  const std::size_t most = thing.anywhere ? 5 : 3;
  constexpr double kApart = .12, kGiveUp = .6, kTurned = .3;  // rad; value below that of the best; rad
  std::vector<PoseCandidate> refined;
  for (const PoseCandidate& candidate : candidates) {
    if (candidate.value < candidates[0].value - kGiveUp || refined.size() == most) break;
    const bool is_new = std::none_of(refined.begin(), refined.end(), [&](const PoseCandidate& other) {
      return Quaterniond(other.X.R).angularDistance(Quaterniond(candidate.X.R)) < kApart &&
             (other.X.p - candidate.X.p).norm() < .01;
    });
    if (!is_new) continue;
    PoseCandidate fine = candidate;
    const FitPoints points = pointsNear(thing, index, owners, candidate.X.p, thing.shape.radius() + .02, kFinePoints);
    fitPose(thing.shape, thing.freedom, points, views_, kFineWidths, kFineSamples, fine.X);
    fine.value = valueOf(thing, index, points, fine.X);
    refined.push_back(fine);
  }
  std::stable_sort(refined.begin(), refined.end(), [](auto& a, auto& b) { return a.value > b.value; });
  const auto rotation = [&](const PoseCandidate& c) {
    return Quaterniond(c.X.R).angularDistance(Quaterniond(thing.last.R));
  };
  const FitPoints points = pointsNear(thing, index, owners, refined[0].X.p, thing.shape.radius() + .02, kFinePoints);
  for (PoseCandidate& other : refined) {  // of the poses of a symmetric shape, the one nearest to the last
    if (other.value <= refined[0].value - kSimilarScore) continue;
    const bool is_same = looksTheSame(thing.shape, refined[0].X, other.X);
    const double angle = Quaterniond(refined[0].X.R).angularDistance(Quaterniond(other.X.R));
    const bool turned = angle > (thing.anywhere ? kTurned : 1.);
    if (!is_same && !(turned && meanDistance(thing.shape, refined[0].X, other.X) < kNearlySame)) continue;
    const bool is_better = thing.anywhere && !is_same
                               ? misfit(thing, points, other.X) < misfit(thing, points, refined[0].X)
                               : rotation(other) < rotation(refined[0]);
    if (is_better) std::swap(other, refined[0]);
  }
  thing.best = refined[0];
  thing.score = countSurface(thing.shape, thing.best.X, views_, kFineSamples).score();
  thing.others.clear();
  for (std::size_t i = 1; i < refined.size(); ++i) {
    if (refined[i].value > refined[0].value - kSimilarScore && !looksTheSame(thing.shape, refined[0].X, refined[i].X))
      thing.others.push_back(refined[i]);
  }
}

PoseCandidate Registration::atPlaceOf(const Thing& thing, const Thing& other) const {
  const int index = int(&other - things_.data());
  const FitPoints points = pointsNear(thing, index, ownersOfPoints(), other.best.X.p,
                                      std::max(thing.shape.radius(), other.shape.radius()) + .02, kFinePoints);
  const auto value = [&](const RigidTransform& X) {
    return countSurface(thing.shape, X, views_, kFineSamples).score() + 2. * explained(thing, points, X);
  };
  if (&thing == &other) return {thing.best.X, value(thing.best.X), misfit(thing, points, thing.best.X)};
  const Vector3d middle = thing.middle(), at = other.best.X * other.middle();
  std::vector<Matrix3d> rotations{other.best.X.R, thing.last.R};
  if (thing.freedom.kind == PoseFreedom::Kind::resting) {
    const auto resting = thing.rotations.empty() ? restingRotations(thing) : thing.rotations;
    rotations.insert(rotations.end(), resting.begin(), resting.end());
  }
  FitPoints coarse{{}, points.keep_out};
  const std::size_t step = std::max<std::size_t>(1, points.measured.size() / kCoarsePoints);
  for (std::size_t i = 0; i < points.measured.size(); i += step) coarse.measured.push_back(points.measured[i]);
  PoseCandidate best;
  for (const Matrix3d& R : rotations) {
    for (const double height : thing.heights.empty() ? std::vector{0.} : thing.heights) {
      RigidTransform X{R, at - R * middle};
      if (thing.freedom.kind == PoseFreedom::Kind::resting) X = restingPose(thing.shape, X, height);
      fitPose(thing.shape, thing.freedom, coarse, views_, kCoarseWidths, kCoarseSamples, X);
      if (const double reached = value(X); reached > best.value) best = {X, reached, 0.};
    }
  }
  fitPose(thing.shape, thing.freedom, points, views_, kFineWidths, kFineSamples, best.X);
  best.value = value(best.X);
  best.misfit = misfit(thing, points, best.X);
  return best;
}

}  // namespace kinegraph::inline perception_internal
