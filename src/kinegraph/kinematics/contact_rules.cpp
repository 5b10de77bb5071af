#include "kinegraph/kinematics/contact_rules.h"

#include <algorithm>

namespace kinegraph::inline kinematics_internal {

namespace {

/// Whether both parts are fixed to the same root.
bool standTogether(const std::vector<ContactRules::Part>& parts, int a, int b) {
  const auto groundOf = [&](int part) {
    while (parts[std::size_t(part)].parent >= 0) part = parts[std::size_t(part)].parent;
    return part;
  };
  return !parts[std::size_t(a)].jointed && !parts[std::size_t(b)].jointed && groundOf(a) == groundOf(b);
}

}  // namespace

bool ContactRules::allow(std::size_t i, std::size_t j) const {
  const Body &a = bodies[i], &b = bodies[j];
  if (a.part == b.part || standTogether(parts, a.part, b.part)) return false;
  if (a.flag < 0 && excludedByFlag(a, b)) return false;
  if (b.flag < 0 && excludedByFlag(b, a)) return false;
  if (excluded.empty()) return true;
  for (const int x : {a.frame, a.owner}) {
    for (const int y : {b.frame, b.owner}) {
      if (std::binary_search(excluded.begin(), excluded.end(), std::pair<int, int>(std::minmax(x, y)))) return false;
    }
  }
  return true;
}

/// Returns true if the contact flag of A excludes contacts with B's part, an ancestor within a few joints.
bool ContactRules::excludedByFlag(const Body& a, const Body& b) const {
  int left = -a.flag;
  for (int part = a.part; parts[std::size_t(part)].parent >= 0;) {
    if (parts[std::size_t(part)].jointed && --left < 0) return false;
    part = parts[std::size_t(part)].parent;
    if (part == b.part) return true;
  }
  return false;
}

}  // namespace kinegraph::inline kinematics_internal
