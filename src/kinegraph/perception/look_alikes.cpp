#include "kinegraph/perception/look_alikes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace kinegraph::inline perception_internal {

namespace {

constexpr double kSameSize = .004;     // m, of the farthest points from the middle
constexpr double kSureMisfit = .5;     // a thing that fits the points so much worse is another one
constexpr double kMisfitWeight = 20.;  // number of independent points
constexpr double kClearRatio = .25;    // of squared movements

constexpr double kMostCost = 1e6;     // of a thing at a place where it may be
constexpr double kImpossible = 1e15;  // more than the costs of all things together

/// Returns a column for each row, each at most once, with the least sum of entries. There are at least as many columns.
/// Source: Jonker & Volgenant, A shortest augmenting path algorithm for linear assignment problems, 1987.
std::vector<int> leastAssignment(const MatrixXd& costs) {
  const int rows = int(costs.rows()), columns = int(costs.cols());
  VectorXd of_row = VectorXd::Zero(rows), of_column = VectorXd::Zero(columns);  // dual prices
  std::vector<int> row_of(std::size_t(columns), -1), column_of(std::size_t(rows), -1);
  for (int first = 0; first < rows; ++first) {
    VectorXd distance = VectorXd::Constant(columns, std::numeric_limits<double>::infinity());
    std::vector<int> before(std::size_t(columns), -1);  // the column before, on the shortest path to a column
    std::vector<char> done(std::size_t(columns), 0);
    int row = first, last = -1;
    for (double length = 0.; row >= 0;) {
      int nearest = -1;
      for (int k = 0; k < columns; ++k) {
        if (done[std::size_t(k)]) continue;
        const double through = length + costs(row, k) - of_row[row] - of_column[k];
        if (through < distance[k]) distance[k] = through, before[std::size_t(k)] = last;
        if (nearest < 0 || distance[k] < distance[nearest]) nearest = k;
      }
      last = nearest;
      length = distance[last];
      done[std::size_t(last)] = 1;
      row = row_of[std::size_t(last)];
    }
    of_row[first] += distance[last];
    for (int k = 0; k < columns; ++k) {
      if (!done[std::size_t(k)] || k == last) continue;
      of_row[row_of[std::size_t(k)]] += distance[last] - distance[k];
      of_column[k] -= distance[last] - distance[k];
    }
    for (int k = last; k >= 0; k = before[std::size_t(k)]) {
      const int previous = before[std::size_t(k)];
      row_of[std::size_t(k)] = previous < 0 ? first : row_of[std::size_t(previous)];
      column_of[std::size_t(row_of[std::size_t(k)])] = k;
    }
  }
  return column_of;
}

/// The poses in which things may be seen at the places of others.
class LookAlikes {
 public:
  LookAlikes(const std::vector<Thing>& things, const Registration& registration, bool anywhere,
             const std::vector<bool>& is_seen)
      : things_(things), is_seen_(is_seen), anywhere_(anywhere), poses_(things.size() * things.size()) {
    for (std::size_t place = 0; place < things.size(); ++place) {
      if (!is_seen[place]) continue;
      std::optional<PoseCandidate>& own = pose(int(place), int(place));
      own = things[place].best;
      bool is_compared = false;
      for (std::size_t k = 0; k < things.size(); ++k) {
        if (k == place || !mayLookAlike(things[k], things[place])) continue;
        const Vector3d middle = things[place].best.X * things[place].middle();
        const double moved = (middle - things[k].last * things[k].middle()).norm();
        if (!anywhere && moved > things[k].search + kSlack) continue;
        const PoseCandidate there = registration.atPlaceOf(things[k], things[place]);
        if (!is_compared) own = registration.atPlaceOf(things[place], things[place]);
        is_compared = true;
        if (there.value > own->value - kSimilarScore && there.misfit < own->misfit + kSureMisfit)
          pose(int(place), int(k)) = there;
      }
    }
  }

  int count() const { return int(things_.size()); }
  const std::optional<PoseCandidate>& pose(int place, int thing) const { return poses_[index(place, thing)]; }

  /// The squared movement of a thing to the place of another one, m^2; infinite if it cannot be there.
  double movement(int place, int thing) const {
    const auto& there = pose(place, thing);
    const Thing& moved = things_[std::size_t(thing)];
    if (!there) return std::numeric_limits<double>::infinity();
    return (there->X * moved.middle() - moved.last * moved.middle()).squaredNorm();
  }

  /// How unlikely a thing is at the place of another one: by its movement and the distances of the points.
  double cost(int place, int thing) const {
    const auto& there = pose(place, thing);
    if (!there) return std::numeric_limits<double>::infinity();
    const double scale = anywhere_ ? 10. : things_[std::size_t(thing)].search;  // m
    return movement(place, thing) / (scale * scale) + kMisfitWeight * there->misfit;
  }

  /// The cost as a finite number: an assignment with an impossible pair is worse than any other.
  double boundedCost(int place, int thing) const {
    return pose(place, thing) ? std::min(kMostCost, cost(place, thing)) : kImpossible;
  }

  /// The things at each place, -1 for places of things that are not seen.
  std::vector<int> assign() const {
    std::vector<int> places, at(things_.size(), -1);
    for (int place = 0; place < count(); ++place) {
      if (is_seen_[std::size_t(place)]) places.push_back(place);
    }
    MatrixXd costs(Eigen::Index(places.size()), count());
    for (Eigen::Index i = 0; i < costs.rows(); ++i) {
      for (int k = 0; k < count(); ++k) costs(i, k) = boundedCost(places[std::size_t(i)], k);
    }
    const std::vector<int> least = leastAssignment(costs);
    for (std::size_t i = 0; i < places.size(); ++i) at[std::size_t(places[i])] = least[i];
    return at;
  }

 private:
  static constexpr double kSlack = .005;  // m

  std::optional<PoseCandidate>& pose(int place, int thing) { return poses_[index(place, thing)]; }
  std::size_t index(int place, int thing) const { return std::size_t(place) * things_.size() + std::size_t(thing); }

  static double sizeOf(const Thing& thing) {
    double most = 0.;
    const Vector3d middle = thing.middle();
    for (const Vector3d& point : thing.shape.samples()) most = std::max(most, (point - middle).norm());
    return most;
  }

  static bool mayLookAlike(const Thing& a, const Thing& b) {
    return a.freedom.kind == b.freedom.kind && !a.freedom.hasJoint() && std::abs(sizeOf(a) - sizeOf(b)) < kSameSize;
  }

  const std::vector<Thing>& things_;
  const std::vector<bool>& is_seen_;
  bool anywhere_;
  std::vector<std::optional<PoseCandidate>> poses_;
};

/// For each thing, the others that may be at its place.
std::vector<std::vector<int>> possibleOthers(const LookAlikes& alike, const std::vector<int>& place_of) {
  std::vector<std::vector<int>> others(place_of.size());
  for (int k = 0; k < alike.count(); ++k) {
    const int place = place_of[std::size_t(k)];
    for (int j = 0; j < alike.count() && place >= 0; ++j) {
      if (j != k && alike.pose(place, j)) others[std::size_t(k)].push_back(j);
    }
  }
  return others;
}

/// Whether the place of thing `from` is left for that of `to`, perhaps over other things. A thing that is not seen may
/// be anywhere.
bool reaches(const std::vector<std::vector<int>>& others, const std::vector<int>& place_of, int from, int to) {
  std::vector<bool> visited(others.size(), false);
  std::vector<int> open{from};
  while (!open.empty()) {
    const int k = open.back();
    open.pop_back();
    if (k == to || place_of[std::size_t(k)] < 0) return true;
    if (visited[std::size_t(k)]) continue;
    visited[std::size_t(k)] = true;
    open.insert(open.end(), others[std::size_t(k)].begin(), others[std::size_t(k)].end());
  }
  return false;
}

/// Moves things to their places.
void moveThings(const LookAlikes& alike, const std::vector<int>& place_of, std::vector<Thing>& things,
                std::vector<bool>& is_seen) {
  struct Result {
    RigidTransform X;
    double score;
    std::vector<PoseCandidate> others;
  };
  std::vector<Result> results;
  for (const Thing& thing : things) results.push_back({thing.best.X, thing.score, thing.others});
  for (std::size_t k = 0; k < things.size(); ++k) {
    const int place = place_of[k];
    if (place == int(k) || (place < 0 && !is_seen[k])) continue;
    Thing& thing = things[k];
    thing.others.clear();
    is_seen[k] = place >= 0;
    if (place < 0) {
      thing.best = {thing.start, -2., 0.};
      thing.score = -2.;
      continue;
    }
    const Result& there = results[std::size_t(place)];
    thing.best = *alike.pose(place, int(k));
    thing.score = there.score;
    const RigidTransform change = there.X.inverse() * thing.best.X;
    for (const PoseCandidate& other : there.others)
      thing.others.push_back({other.X * change, other.value, other.misfit});
  }
}

}  // namespace

std::vector<std::vector<int>> tellApart(std::vector<Thing>& things, const Registration& registration, bool anywhere,
                                        std::vector<bool>& is_seen, std::vector<std::pair<int, int>>& unclear) {
  const LookAlikes alike(things, registration, anywhere, is_seen);
  const std::vector<int> at = alike.assign();
  std::vector<int> place_of(things.size(), -1);
  for (std::size_t place = 0; place < at.size(); ++place) {
    if (at[place] >= 0) place_of[std::size_t(at[place])] = int(place);
  }
  moveThings(alike, place_of, things, is_seen);
  const std::vector<std::vector<int>> others = possibleOthers(alike, place_of);
  std::vector<std::vector<int>> may_be(things.size());
  for (int k = 0; k < alike.count(); ++k) {
    const int place = place_of[std::size_t(k)];
    for (const int j : others[std::size_t(k)]) {
      if (!reaches(others, place_of, j, k)) continue;
      const int place_of_j = place_of[std::size_t(j)];
      may_be[std::size_t(k)].push_back(j);
      if (place_of_j < 0) may_be[std::size_t(j)].push_back(k);
      double moved = alike.movement(place, k), exchanged = alike.movement(place, j);
      if (place_of_j >= 0) {
        moved += alike.movement(place_of_j, j);
        exchanged += alike.movement(place_of_j, k);
      }
      const bool is_clear = !anywhere && std::isfinite(exchanged) && moved < kClearRatio * exchanged;
      if (!is_clear && (k < j || place_of_j < 0)) unclear.emplace_back(k, j);
    }
  }
  return may_be;
}

}  // namespace kinegraph::inline perception_internal
