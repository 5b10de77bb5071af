#include "kinegraph/trajectory_optimization/spline_motions.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {

namespace {

constexpr double kLeastStray = 2e-5;       // m: chords from which the spline strays less are not halved
constexpr double kLeastPart = 1e-3;        // of the way: shorter ones neither, as where a quaternion is zero
constexpr double kToldStray = 1e-4;        // m, of what is told of contacts
constexpr double kApproachStray = 2e-3;    // m, of chords on which approaches are looked for
constexpr double kMostApproachParts = 16;  // of a polynomial
constexpr double kOverlap = .125;          // of such chords, so that they see what comes nearest where they meet

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
  const double stray = curve_.stray(line, begin, end);
  if (probe_.isFree(line, margin + stray)) return std::nullopt;
  MotionContact hit = probe_.lastHit();
  if (stray <= kLeastStray || end - begin <= kLeastPart || hit.distance + stray < margin) {
    hit.time = begin + hit.time * (end - begin);
    return hit;
  }
  const double middle = middleOf(begin, end);
  if (const auto contact = tooNear(slice, {begin, middle}, margin)) return contact;
  return tooNear(slice, {middle, end}, margin);
}

std::vector<MotionContact> SplineMotions::approaches(int slice, double most) {
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
    const double stray = curve_.stray(curve_.line(slice, knots[i], knots[i + 1]), knots[i], knots[i + 1]);
    const int parts = int(std::clamp(std::ceil(std::sqrt(stray / kApproachStray)), 1., kMostApproachParts));
    const double part = width / parts, overlap = kOverlap * part;
    for (int k = 0; k < parts; ++k) {
      const double begin = std::max(knots[i] + k * part - overlap, 0.),
                   end = std::min(knots[i] + (k + 1) * part + overlap, 1.);
      for (const MotionContact& contact : probe_.approaches(curve_.line(slice, begin, end), most))
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
  line.of_all = motion.of_all, line.pairs = motion.pairs;
  const double stray = curve_.stray(line, begin, end);
  const std::optional<MotionContact> contact = probe_.firstContact(line, margin + stray);
  if (!contact) return;
  if (stray <= kLeastStray || end - begin <= kLeastPart ||
      (stray <= kToldStray && contact->distance + stray < margin)) {
    std::ranges::copy(contactsOf({line}, margin + stray, kFreeTolerance), std::back_inserter(contacts));
    return;
  }
  const double middle = middleOf(begin, end);
  addContacts(motion, {begin, middle}, margin, contacts);
  addContacts(motion, {middle, end}, margin, contacts);
}

}  // namespace kinegraph
