#include "kinegraph/trajectory_optimization/spline_motions.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline trajectory_optimization_internal {

namespace {

constexpr double kSmallestDeviation = 2e-5;  // m: chords with a smaller deviation are not bisected
constexpr double kShortestPart = 1e-3;  // fraction of a motion: shorter chords are not bisected, for example at a zero
                                        // quaternion
constexpr double kReportedDeviation = 1e-4;  // m, largest deviation for reported contacts
constexpr double kApproachDeviation = 2e-3;  // m, for chords on which approaches are searched
constexpr double kMaxApproachParts = 16;     // per polynomial
constexpr double kOverlap = .125;            // of such chords, so that minima at their junctions are found

double middleOf(double begin, double end) { return .5 * (begin + end); }

}  // namespace

std::optional<MotionContact> SplineMotions::tooNear(int slice, double margin) {
  const std::vector<double>& knots = curve_.knotsOn(slice);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i)
    if (const auto contact = tooNear(slice, {knots[i], knots[i + 1]}, margin)) return contact;
  return std::nullopt;
}

std::optional<MotionContact> SplineMotions::tooNear(int slice, Part part, double margin) {
  const auto [begin, end] = part;
  const SliceMotion line = curve_.line(slice, begin, end);
  const double deviation = curve_.deviation(line, begin, end);
  if (probe_.isFree(line, margin + deviation)) return std::nullopt;
  MotionContact hit = probe_.lastHit();
  if (deviation <= kSmallestDeviation || end - begin <= kShortestPart || hit.distance + deviation < margin) {
    hit.time = begin + hit.time * (end - begin);
    return hit;
  }
  const double middle = middleOf(begin, end);
  if (const auto contact = tooNear(slice, {begin, middle}, margin)) return contact;
  return tooNear(slice, {middle, end}, margin);
}

std::vector<MotionContact> SplineMotions::approaches(int slice, double max_distance) {
  std::vector<MotionContact> all;
  const auto add = [&](MotionContact contact, double begin, double end, double same) {
    contact.time = begin + contact.time * (end - begin);
    const auto is_it = [&](const MotionContact& other) {
      return other.a == contact.a && other.b == contact.b && std::abs(other.time - contact.time) <= same;
    };
    const auto known = std::ranges::find_if(all, is_it);
    if (known == all.end()) {
      all.push_back(contact);
    } else if (contact.distance < known->distance) {
      *known = contact;
    }
  };
  const std::vector<double>& knots = curve_.knotsOn(slice);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double width = knots[i + 1] - knots[i];
    const double deviation = curve_.deviation(curve_.line(slice, knots[i], knots[i + 1]), knots[i], knots[i + 1]);
    const int parts = int(std::clamp(std::ceil(std::sqrt(deviation / kApproachDeviation)), 1., kMaxApproachParts));
    const double part = width / parts, overlap = kOverlap * part;
    for (int k = 0; k < parts; ++k) {
      const double begin = std::max(knots[i] + k * part - overlap, 0.),
                   end = std::min(knots[i] + (k + 1) * part + overlap, 1.);
      for (const MotionContact& contact : probe_.approaches(curve_.line(slice, begin, end), max_distance))
        add(contact, begin, end, 2. * overlap);
    }
  }
  return all;
}

std::vector<PathContact> SplineMotions::contacts(const SliceMotion& motion, double margin) {
  std::vector<PathContact> contacts;
  const std::vector<double>& knots = curve_.knotsOn(motion.slice);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) addContacts(motion, {knots[i], knots[i + 1]}, margin, contacts);
  return contacts;
}

void SplineMotions::addContacts(const SliceMotion& motion, Part part, double margin,
                                std::vector<PathContact>& contacts) {
  const auto [begin, end] = part;
  SliceMotion line = curve_.line(motion.slice, begin, end);
  line.all_pairs = motion.all_pairs, line.pairs = motion.pairs;
  const double deviation = curve_.deviation(line, begin, end);
  const std::optional<MotionContact> contact = probe_.firstContact(line, margin + deviation);
  if (!contact) return;
  if (deviation <= kSmallestDeviation || end - begin <= kShortestPart ||
      (deviation <= kReportedDeviation && contact->distance + deviation < margin)) {
    std::ranges::copy(contactsOf({line}, margin + deviation, kFreeTolerance), std::back_inserter(contacts));
    return;
  }
  const double middle = middleOf(begin, end);
  addContacts(motion, {begin, middle}, margin, contacts);
  addContacts(motion, {middle, end}, margin, contacts);
}

}  // namespace kinegraph::inline trajectory_optimization_internal
