#include <algorithm>
#include <cmath>

#include "kinegraph/collision/edge_engine.h"

namespace kinegraph::inline collision_internal {

void EdgeEngine::findApproaches(const double* from, const double* to, double most, std::vector<MotionContact>& found) {
  beginCheck();
  found.clear();
  const int pieces = setEdge(from, to);
  for (int piece = 0; piece < pieces; ++piece) {
    placePiece(double(piece) / pieces, piece + 1 == pieces ? 1. : double(piece + 1) / pieces);
    findCandidates(most, most);
    for (const Candidate& candidate : candidates_) addApproaches(candidate, most, found);
  }
}

/// The distance if it is below `most`, else kFar.
double EdgeEngine::distanceBelow(double most, const Candidate& candidate, Normal& normal, const Moment& at) {
  if (candidate.pair.convex && normal.stamp == stamp_ && gap(candidate, normal, at) >= most) return kFar;
  if (separate(candidate, normal, at, most) == Verdict::apart) return kFar;
  const double distance = measure(candidate, normal, at);
  return distance < most ? distance : kFar;
}

/// Adds the local minima of a pair among the samples, refined by a parabola through three of them.
void EdgeEngine::addApproaches(const Candidate& candidate, double most, std::vector<MotionContact>& found) {
  Normal& normal = normalOf(candidate);
  const double width = piece_times_[1] - piece_times_[0];
  const int frame_a = bodies_.bodies[std::size_t(candidate.pair.a)].frame,
            frame_b = bodies_.bodies[std::size_t(candidate.pair.b)].frame;
  double distance[kLanes];
  for (int i = 0; i < kLanes; ++i)
    distance[i] = candidate.bounds[i] < most ? distanceBelow(most, candidate, normal, sampleAt(i)) : kFar;
  for (int i = 0; i < kLanes; ++i) {
    double time = piece_times_[std::size_t(i)], least = distance[i];
    const double before = i > 0 ? distance[i - 1] : kFar, after = i + 1 < kLanes ? distance[i + 1] : kFar;
    if (i == 0 || time == 1. || !(least < before) || least > after)
      continue;  // the last piece ended at the first sample
    if (std::isfinite(before) && std::isfinite(after)) {
      const double lowest = time + .5 * width * (before - after) / (before - 2. * least + after);
      const double there = measure(candidate, normal, momentAt(lowest, 0));
      if (there < least) least = there, time = lowest;
    }
    found.push_back({time, std::min(frame_a, frame_b), std::max(frame_a, frame_b), least, -1});
  }
}

}  // namespace kinegraph::inline collision_internal
