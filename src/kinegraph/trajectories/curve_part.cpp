#include "kinegraph/trajectories/curve_part.h"

#include <algorithm>
#include <cassert>

namespace kinegraph::inline trajectories_internal {

namespace {

constexpr double kEmptyPiece = 1e-12;  // of the curve's length

/// Appends the polynomial of a piece in the variable s - begin(piece) - shift, with the degree of `parts`.
void addPiece(PathCurve::Parts& parts, const PathCurve& curve, int piece, double shift) {
  const std::size_t n = std::size_t(parts.dofs), first = parts.coefficients.size();
  parts.coefficients.resize(first + n * std::size_t(parts.degree + 1));
  for (int from = 0; from <= curve.degree(); ++from) {
    const double* c = curve.coefficient(piece, from);
    double factor = 1.;  // coefficient of x^to in (x + shift)^from
    for (int to = from; to >= 0; --to) {
      double* out = &parts.coefficients[first + std::size_t(to) * n];
      for (std::size_t j = 0; j < n; ++j) out[j] += factor * c[j];
      factor *= shift * to / (from - to + 1);
    }
  }
  parts.is_line.push_back(curve.isLine(piece));
}

}  // namespace

TimeScaling CurvePart::onWhole(const TimeScaling& scaling) const {
  std::vector<ScalingPhase> phases = scaling.phases();
  for (ScalingPhase& phase : phases) {
    phase.begin.s += begin;
    phase.end += begin;
    phase.piece += first_piece;
  }
  return {std::move(phases), scaling.duration()};
}

TimeScaling CurvePart::restOf(const TimeScaling& whole, double time) const {
  TimeScaling rest;
  const std::vector<ScalingPhase>& phases = whole.phases();
  for (std::size_t i = std::size_t(&whole.phaseAt(time) - phases.data()); i < phases.size(); ++i) {
    ScalingPhase phase = phases[i];
    const double until = i + 1 < phases.size() ? phases[i + 1].time : whole.duration();
    const double from = std::max(time, phase.time);
    if (phase.begin.s - begin >= curve.length()) break;
    phase.begin = phase.at(from - phase.time);
    if (phase.growth != 0.) phase.begin.jerk = 0.;  // the growth determines the change of the acceleration
    phase.begin.s = std::max(0., phase.begin.s - begin);
    phase.end = std::clamp(phase.end - begin, phase.begin.s, curve.length());
    phase.piece = std::clamp(phase.piece - first_piece, 0, curve.pieces() - 1);
    if (until > from) rest.add(phase, until - from);
  }
  return rest;
}

CurvePart partOf(const PathCurve& curve, double from, double to) {
  const double empty = kEmptyPiece * curve.length();
  from = std::clamp(from, 0., curve.length());
  to = std::clamp(to, from, curve.length());
  CurvePart part{{}, from, -1};
  PathCurve::Parts parts{.dofs = curve.dofs(), .degree = curve.degree(), .length = to - from};
  for (int piece = curve.pieceAt(from); piece < curve.pieces() && curve.begin(piece) < to; ++piece) {
    const double begin = std::max(from, curve.begin(piece)), end = std::min(to, curve.end(piece));
    if (end - begin <= empty) continue;
    if (part.first_piece < 0) part.first_piece = piece;
    parts.stops.push_back(!parts.begin.empty() && curve.stopsAt(piece));
    parts.begin.push_back(parts.begin.empty() ? 0. : begin - from);
    addPiece(parts, curve, piece, begin - curve.begin(piece));
  }
  part.first_piece = std::max(part.first_piece, 0);
  parts.marks = {0., parts.length};
  part.curve = PathCurve::fromParts(parts);
  return part;
}

PathCurve joined(const PathCurve& first, const PathCurve& second, bool jumps) {
  assert(first.dofs() == second.dofs() && "the curves have different numbers of dofs");
  PathCurve::Parts parts{.dofs = first.dofs(), .degree = std::max(first.degree(), second.degree())};
  for (const PathCurve* curve : {&first, &second}) {
    for (int piece = 0; piece < curve->pieces(); ++piece) {
      if (curve->end(piece) == curve->begin(piece)) continue;
      parts.begin.push_back(parts.length + curve->begin(piece));
      parts.stops.push_back(curve->stopsAt(piece) || (jumps && curve == &second && piece == 0));
      addPiece(parts, *curve, piece, 0.);
    }
    for (std::size_t i = curve == &second ? 1 : 0; i < curve->marks().size(); ++i)
      parts.marks.push_back(parts.length + curve->marks()[i]);
    parts.length += curve->length();
  }
  return PathCurve::fromParts(parts);
}

namespace {

PathCurve reversed(const PathCurve& curve) {
  PathCurve::Parts parts{.dofs = curve.dofs(), .degree = curve.degree(), .length = curve.length()};
  for (int piece = curve.pieces() - 1; piece >= 0; --piece) {
    parts.begin.push_back(curve.length() - curve.end(piece));
    parts.stops.push_back(piece + 1 < curve.pieces() && curve.stopsAt(piece + 1));
    addPiece(parts, curve, piece, curve.end(piece) - curve.begin(piece));
    for (int power = 1; power <= curve.degree(); power += 2)  // the variable has the other sign
      for (int j = 0; j < parts.dofs; ++j)
        parts.coefficients[parts.coefficients.size() - std::size_t((curve.degree() + 1 - power) * parts.dofs - j)] *=
            -1.;
  }
  for (std::size_t i = curve.marks().size(); i-- > 0;) parts.marks.push_back(curve.length() - curve.marks()[i]);
  return PathCurve::fromParts(parts);
}

TimeScaling reversed(const TimeScaling& scaling, const PathCurve& curve) {
  TimeScaling back;
  const std::vector<ScalingPhase>& phases = scaling.phases();
  for (std::size_t i = phases.size(); i-- > 0;) {
    const ScalingPhase& phase = phases[i];
    const double time = (i + 1 < phases.size() ? phases[i + 1].time : scaling.duration()) - phase.time;
    ScalingState begin = phase.at(time);
    begin.s = curve.length() - phase.end, begin.acceleration *= -1.;
    if (phase.growth != 0.) begin.jerk = 0.;  // the growth determines the change of the acceleration
    back.add({0., begin, phase.growth, curve.length() - phase.begin.s, curve.pieces() - 1 - phase.piece}, time);
  }
  return back;
}

}  // namespace

TimedPath reversed(const TimedPath& motion) {
  const VectorXd times =
      motion.times.size() ? VectorXd(motion.duration() - motion.times.reverse().array()) : VectorXd();
  return TimedPath::fromParts(motion.status, motion.message, motion.path.colwise().reverse(), times,
                              reversed(motion.curve()), reversed(motion.scaling(), motion.curve()));
}

}  // namespace kinegraph::inline trajectories_internal
