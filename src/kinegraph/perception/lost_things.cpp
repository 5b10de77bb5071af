#include <algorithm>
#include <cmath>

#include "kinegraph/perception/registration.h"

namespace kinegraph::inline perception_internal {

namespace {

constexpr int kQuickPoints = 60, kQuickSamples = 60;
const std::vector<double> kQuickWidths{.02, .012, .006};  // m
constexpr double kExplainedBy = .003;                     // m, width of the weight of a point near a surface
constexpr double kHigher = .015;                          // m, above the highest points: such a thing would be seen
constexpr double kLower = .02;                            // m, below the points in the middle of a place
constexpr double kBeside = .015;      // m, unexplained points so close to a surface speak against it
constexpr double kPlaceRadius = .05;  // m, of a group of points
constexpr int kFewPointsOfPlace = 15, kFewExplained = 20;
constexpr std::size_t kPerPlace = 3, kPerThing = 8;  // candidates
constexpr std::size_t kBeam = 300;                   // partial assignments
constexpr double kFound = 1.9;                       // least value, of at most 3
constexpr double kLeastSurface = .3;                 // share of the surface that has to agree

bool isNewPose(const std::vector<PoseCandidate>& known, const Thing& thing, const RigidTransform& X) {
  return std::none_of(known.begin(), known.end(), [&](const PoseCandidate& other) {
    return (other.X.p - X.p).norm() < .02 && looksTheSame(thing.shape, other.X, X);
  });
}

void keepBest(std::vector<PoseCandidate>& candidates, std::size_t most) {
  std::stable_sort(candidates.begin(), candidates.end(), [](auto& a, auto& b) { return a.value > b.value; });
  if (candidates.size() > most) candidates.resize(most);
}

}  // namespace

std::vector<Matrix3d> restingRotations(const Thing& thing) {
  constexpr double kEighth = 0.78539816339744831;
  std::vector<Matrix3d> rotations;
  std::vector<Vector3d> tried;
  const auto looks = [&](const Matrix3d& R) {  // turned about the middle of the surface
    return RigidTransform{R, -(R * thing.middle())};
  };
  for (const Vector3d& down : thing.shape.restingDirections()) {
    if (std::any_of(tried.begin(), tried.end(), [&](const Vector3d& other) { return other.dot(down) > .8; })) continue;
    tried.push_back(down);
    const Matrix3d R = Quaterniond::FromTwoVectors(down, -Vector3d::UnitZ()).toRotationMatrix();
    for (int i = 0; i < 8; ++i) {
      const Matrix3d turned = Eigen::AngleAxisd(kEighth * i, Vector3d::UnitZ()).toRotationMatrix() * R;
      const bool is_new = std::none_of(rotations.begin(), rotations.end(), [&](const Matrix3d& other) {
        return isSymmetry(thing.shape, looks(other).inverse() * looks(turned));
      });
      if (is_new) rotations.push_back(turned);
    }
  }
  if (rotations.empty()) rotations.push_back(thing.start.R);  // a ball
  return rotations;
}

/// The middles of groups of points that nothing owns, such that each point is in a group.
std::vector<Vector3d> Registration::placesOfPoints(const std::vector<int>& owners, double radius) const {
  std::vector<const Vector3d*> open;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (owners[i] < 0) open.push_back(&points_[i].p);
  }
  std::vector<Vector3d> places;
  while (!open.empty()) {
    Vector3d at = *open.front();
    std::size_t count = 0;
    for (int round = 0; round < 3; ++round) {
      Vector3d sum = Vector3d::Zero();
      count = 0;
      for (const Vector3d* point : open) {
        if ((*point - at).head<2>().squaredNorm() > radius * radius) continue;
        sum += *point;
        ++count;
      }
      if (count == 0) break;
      at = sum / double(count);
    }
    if (count >= std::size_t(kFewPointsOfPlace)) places.push_back(at);
    const std::size_t before = open.size();
    std::erase_if(open, [&](const Vector3d* point) { return (*point - at).head<2>().squaredNorm() < radius * radius; });
    if (open.size() == before) open.erase(open.begin());
  }
  return places;
}

/// The value of a pose by its surface and the points close to it.
double Registration::localValue(const Thing& thing, const std::vector<int>& owners, const RigidTransform& X) const {
  const double reach = thing.shape.radius() + kBeside;
  double explained = 0., near = 0.;
  for (std::size_t i = 0; i < points_.size(); i += 2) {
    if (owners[i] >= 0 || (points_[i].p - X.p).squaredNorm() > reach * reach) continue;
    const double d = thing.shape.nearest(X.R.transpose() * (points_[i].p - X.p)).distance;
    if (std::abs(d) > kBeside) continue;
    ++near;
    explained += std::pow(1. + std::pow(d / std::max(kExplainedBy, 1.5 * points_[i].sigma), 2), -2);
  }
  const double surface = countSurface(thing.shape, X, views_, kFineSamples).score();
  if (2. * explained < kFewExplained || surface < kLeastSurface) return -2.;
  return surface + 2. * explained / near;
}

std::vector<PoseCandidate> Registration::candidatesAnywhere(const Thing& thing, const std::vector<int>& owners) const {
  const int index = int(&thing - things_.data());
  std::vector<PoseCandidate> all;
  Vector3d eye = Vector3d::Zero();
  for (const ObservedView& view : views_) eye += view.X_WC.p / double(views_.size());
  const Vector3d middle = thing.middle();
  const double radius = thing.shape.radius();
  for (const Vector3d& place : placesOfPoints(owners, std::min(radius, kPlaceRadius))) {
    const FitPoints quick = pointsNear(thing, index, owners, place, 1.2 * radius + .01, kQuickPoints);
    const FitPoints coarse = pointsNear(thing, index, owners, place, 1.2 * radius + .02, kCoarsePoints);
    Vector3d behind = place - eye;
    behind = .4 * radius * Vector3d(behind.x(), behind.y(), 0.).normalized();
    double highest = -kHigher, in_middle = -kLower;
    for (const ObservedPoint& point : coarse.measured) {
      highest = std::max(highest, point.p.z());
      if ((point.p - place).head<2>().norm() < .3 * radius) in_middle = std::max(in_middle, point.p.z());
    }
    std::vector<PoseCandidate> here;
    for (const Matrix3d& R : thing.rotations) {
      for (const double height : thing.heights) {
        RigidTransform X = restingPose(thing.shape, {R, place + behind - R * middle}, height);
        const double top = X.p.z() + thing.shape.extent(X.R.transpose() * Vector3d::UnitZ());
        if (top > highest + kHigher || top < in_middle - kLower) continue;
        fitPose(thing.shape, thing.freedom, quick, views_, kQuickWidths, kQuickSamples, X);
        here.push_back(
            {X, countSurface(thing.shape, X, views_, kQuickSamples).score() + 2. * explained(thing, quick, X), 0.});
      }
    }
    keepBest(here, kPerPlace);
    for (PoseCandidate& candidate : here) {
      fitPose(thing.shape, thing.freedom, coarse, views_, kCoarseWidths, kCoarseSamples, candidate.X);
      fitPose(thing.shape, thing.freedom, coarse, views_, kFineWidths, kCoarseSamples, candidate.X);
      candidate.value = localValue(thing, owners, candidate.X);
      if (candidate.value > kFound && isNewPose(all, thing, candidate.X)) all.push_back(candidate);
    }
  }
  keepBest(all, kPerThing);
  return all;
}

/// Chooses for each lost thing one of its candidates, or none, with the largest sum of values and without overlaps.
void Registration::findLost() {
  for (Thing& thing : things_) {
    if (thing.is_lost) thing.rotations = restingRotations(thing);
  }
  constexpr int kRounds = 3;  // a thing beside another one is found once the other's points are taken
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<int> owners = ownersOfPoints();
    struct Assignment {
      double value = 0.;
      std::vector<std::pair<Thing*, const PoseCandidate*>> found = {};
    };
    std::vector<std::vector<PoseCandidate>> candidates(things_.size());
    std::vector<Assignment> beam(1);
    for (std::size_t i = 0; i < things_.size(); ++i) {
      if (!things_[i].is_lost) continue;
      candidates[i] = candidatesAnywhere(things_[i], owners);
      std::vector<Assignment> next = beam;  // without this thing
      for (const Assignment& partial : beam) {
        for (const PoseCandidate& candidate : candidates[i]) {
          const bool is_free = std::none_of(partial.found.begin(), partial.found.end(), [&](const auto& other) {
            return overlap(*other.first, other.second->X, things_[i], candidate.X);
          });
          if (!is_free) continue;
          next.push_back(partial);
          next.back().value += candidate.value - kFound;
          next.back().found.emplace_back(&things_[i], &candidate);
        }
      }
      std::stable_sort(next.begin(), next.end(), [](auto& a, auto& b) { return a.value > b.value; });
      if (next.size() > kBeam) next.resize(kBeam);
      beam = std::move(next);
    }
    if (beam[0].found.empty()) break;
    for (const auto& [thing, candidate] : beam[0].found) {
      thing->best = *candidate;
      thing->start = candidate->X;
      thing->score = countSurface(thing->shape, candidate->X, views_, kFineSamples).score();
      thing->is_lost = false;
    }
    const std::vector<int> of_found = ownersOfPoints();
    for (const auto& [thing, candidate] : beam[0].found) find(*thing, int(thing - things_.data()), of_found);
  }
  const std::vector<int> owners = ownersOfPoints();
  for (std::size_t i = 0; i < things_.size(); ++i) {
    if (!things_[i].is_lost) find(things_[i], int(i), owners);
  }
  separate();
}

}  // namespace kinegraph::inline perception_internal
