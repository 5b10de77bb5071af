#include "kinegraph/trajectories/corner_stops.h"

#include <cmath>
#include <limits>

#include "kinegraph/trajectories/s_curve_profile.h"

namespace kinegraph::inline trajectories_internal {

namespace {

/// The part of a curve that belongs to a corner: its blend, or a point if the motion stops there.
struct CornerPlace {
  double begin, end;
};

std::vector<CornerPlace> cornerPlaces(const PathCurve& curve) {
  std::vector<CornerPlace> places;
  for (int piece = 0; piece < curve.pieces(); ++piece) {
    if (curve.stopsAt(piece)) places.push_back({curve.begin(piece), curve.begin(piece)});
    if (!curve.isLine(piece)) places.push_back({curve.begin(piece), curve.end(piece)});
  }
  return places;
}

double speedAt(const TimeScaling& scaling, double time) {
  const ScalingPhase& phase = scaling.phaseAt(time);
  return std::abs(phase.at(time - phase.time).speed);
}

/// Returns the time of a line from one speed to another; infinity if it is too short.
double lineTime(const VectorXd& direction, double length, double from, double to, const MotionLimits& limits) {
  TimeScaling line;
  if (!addSCurve(line, 0., length, from, to, limitsAlong(direction.data(), limits), 0))
    return std::numeric_limits<double>::infinity();
  return line.duration();
}

}  // namespace

std::vector<int> cornersWithFasterStops(const TimedPath& timed, const std::vector<double>& halves,
                                        const MotionLimits& limits) {
  const PathCurve& curve = timed.curve();
  const TimeScaling& scaling = timed.scaling();
  const std::vector<CornerPlace> places = cornerPlaces(curve);
  std::vector<int> found;
  if (places.size() != halves.size()) return found;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const CornerPlace& at = places[i];
    if (halves[i] == 0.) continue;
    const auto edge = [&](const CornerPlace& neighbor, double near, double far) {  // a stop, or the middle of the line
      return neighbor.begin == neighbor.end ? far : .5 * (near + far);
    };
    const double from = i == 0 ? 0. : edge(places[i - 1], at.begin, places[i - 1].end);
    const double to = i + 1 == places.size() ? curve.length() : edge(places[i + 1], at.end, places[i + 1].begin);
    const double begin = scaling.timeOf(from), end = scaling.timeOf(to);
    const double stop =
        lineTime(curve.eval(at.begin, 1), at.begin - from + halves[i], speedAt(scaling, begin), 0., limits) +
        lineTime(curve.eval(to, 1), to - at.end + halves[i], 0., speedAt(scaling, end), limits);
    if (stop < end - begin) found.push_back(int(i));
  }
  return found;
}

}  // namespace kinegraph::inline trajectories_internal
