#include "kinegraph/simulation/contact_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "kinegraph/math/pose.h"

namespace kinegraph::inline simulation_internal {

namespace {

constexpr double kInaccuracy = 1e-4;      ///< m: larger than the errors of measured distances
constexpr double kClose = .05;            ///< m: bounding spheres that are closer are not enough
constexpr int kPause = 10;                ///< steps
constexpr int kMany = 10;                 ///< measurements in one step that cost more than a search
constexpr std::size_t kMaxPairs = 20000;  ///< for more pairs MuJoCo's search is cheaper
constexpr double kUnknown = -std::numeric_limits<double>::infinity();

using Vector = Eigen::Map<const Vector3d>;

/// Returns a bound of the angle between two rotations, rad: quaternions have a chord of 2 sin(angle/4).
double angleBound(const mjtNum* a, const mjtNum* b) {
  const Eigen::Map<const Eigen::Vector4d> p(a), q(b);
  return M_PI * std::min((p - q).norm(), (p + q).norm());
}

}  // namespace

ContactSearch::ContactSearch(const mjModel& m)
    : radius_(std::size_t(m.nbody), 0.),
      motions_(std::size_t(m.nbody)),
      shift_(std::size_t(m.nbody), 0.),
      turn_(std::size_t(m.nbody), 0.),
      qpos_(m.qpos0, m.qpos0 + m.nq) {
  for (int g = 0; g < m.ngeom; ++g) {
    double& radius = radius_[std::size_t(m.geom_bodyid[g])];
    radius = std::max(radius, Vector(m.geom_pos + 3 * g).norm() + m.geom_rbound[g]);
  }
  const auto add = [&](int a, int b, double reach) {
    const int body_a = m.geom_bodyid[a], body_b = m.geom_bodyid[b];
    pairs_.push_back({a, b, body_a, body_b, reach + kInaccuracy, originOf(m, body_a, body_b), kUnknown});
  };
  for (int p = 0; p < m.npair; ++p) add(m.pair_geom1[p], m.pair_geom2[p], m.pair_margin[p] + m.pair_gap[p]);
  std::set<std::pair<int, int>> excluded;
  for (int e = 0; e < m.nexclude; ++e)
    excluded.insert(std::minmax(m.exclude_signature[e] >> 16, m.exclude_signature[e] & 0xffff));
  for (int a = 0; a < m.ngeom; ++a) {
    for (int b = a + 1; b < m.ngeom && pairs_.size() <= kMaxPairs; ++b) {
      const bool fits = (m.geom_contype[a] & m.geom_conaffinity[b]) || (m.geom_contype[b] & m.geom_conaffinity[a]);
      const int body_a = m.geom_bodyid[a], body_b = m.geom_bodyid[b];
      if (!fits || m.body_weldid[body_a] == m.body_weldid[body_b]) continue;
      if (excluded.contains(std::minmax(body_a, body_b))) continue;
      add(a, b, m.geom_margin[a] + m.geom_margin[b] + m.geom_gap[a] + m.geom_gap[b]);
    }
  }
}

/// Returns the index of the last body that carries both, and adds it if it is new.
std::size_t ContactSearch::originOf(const mjModel& m, int body_a, int body_b) {
  while (body_a != body_b) (body_a > body_b ? body_a : body_b) = m.body_parentid[std::max(body_a, body_b)];
  const auto found = std::ranges::find(origins_, body_a, &Origin::body);
  if (found != origins_.end()) return std::size_t(found - origins_.begin());
  int end = body_a + 1;  // bodies follow their parents, depth first
  while (end < m.nbody && m.body_parentid[end] >= body_a) ++end;
  origins_.push_back({body_a, end, std::vector<double>(std::size_t(end - body_a), 0.)});
  return origins_.size() - 1;
}

double ContactSearch::travelled(const Pair& pair) const {
  const Origin& origin = origins_[pair.origin];
  return origin.travel[std::size_t(pair.body_a - origin.body)] + origin.travel[std::size_t(pair.body_b - origin.body)];
}

bool ContactSearch::isNeedless(const mjModel& m, mjData& d) {
  if (d.ncon > 0 || pairs_.size() > kMaxPairs) return false;
  if (pause_ > 0) {
    --pause_;
    return false;
  }
  move(m, d);
  int measured = 0;
  for (Pair& pair : pairs_) {
    const double now = travelled(pair);
    if (now < pair.apart_until) continue;
    if (d.body_awake[pair.body_a] != mjS_AWAKE && d.body_awake[pair.body_b] != mjS_AWAKE) continue;
    if (measured++ == 0) physics().mj_kinematics(&m, &d);
    const double space = freeSpace(m, d, pair);
    if (!(space > 0.)) {
      pause_ = kPause;
      return false;
    }
    pair.apart_until = now + space;
  }
  if (measured > kMany) pause_ = kPause;
  return true;
}

/// Adds bounds of the motion since the last call to the bodies' travels.
void ContactSearch::move(const mjModel& m, const mjData& d) {
  const mjtNum* before = qpos_.data();
  for (int b = 1; b < m.nbody; ++b) {
    Motion motion;
    double lever = 0.;  // of the turn
    for (int j = m.body_jntadr[b]; j < m.body_jntadr[b] + m.body_jntnum[b]; ++j) {
      const int at = m.jnt_qposadr[j];
      const double moved = std::abs(d.qpos[at] - before[at]);
      switch (m.jnt_type[j]) {
        case mjJNT_FREE:
          motion.shift += (Vector(d.qpos + at) - Vector(before + at)).norm();
          motion.turn += angleBound(d.qpos + at + 3, before + at + 3);
          break;
        case mjJNT_BALL:
          motion.turn += angleBound(d.qpos + at, before + at);
          break;
        case mjJNT_HINGE:
          motion.turn += moved;
          break;
        default:  // a slide
          motion.shift += moved;
          lever += std::max(std::abs(d.qpos[at]), std::abs(before[at]));
      }
      lever += 2. * Vector(m.jnt_pos + 3 * j).norm();
    }
    motion.shift += motion.turn * lever;
    motion.arm = Vector(m.body_pos + 3 * b).norm() + lever;
    motions_[std::size_t(b)] = motion;
  }
  for (Origin& origin : origins_) {
    shift_[std::size_t(origin.body)] = turn_[std::size_t(origin.body)] = 0.;
    for (int b = origin.body + 1; b < origin.end; ++b) {
      const auto i = std::size_t(b), parent = std::size_t(m.body_parentid[b]);
      const Motion& motion = motions_[i];
      turn_[i] = turn_[parent] + motion.turn;
      shift_[i] = shift_[parent] + turn_[parent] * motion.arm + motion.shift;
      origin.travel[std::size_t(b - origin.body)] += shift_[i] + turn_[i] * radius_[i];
    }
  }
  std::copy_n(d.qpos, m.nq, qpos_.begin());
}

/// Returns by how much the geoms of a pair are at least farther apart than contacts reach, m.
double ContactSearch::freeSpace(const mjModel& m, mjData& d, const Pair& pair) {
  const int a = pair.geom_a, b = pair.geom_b;
  const Vector center_a(d.geom_xpos + 3 * a), center_b(d.geom_xpos + 3 * b);
  for (const auto& [plane, other] : {std::pair(a, b), std::pair(b, a)}) {
    if (m.geom_type[plane] != mjGEOM_PLANE) continue;
    const mjtNum* R = d.geom_xmat + 9 * plane;
    const Vector3d offset = Vector(d.geom_xpos + 3 * other) - Vector(d.geom_xpos + 3 * plane);
    return Vector3d(R[2], R[5], R[8]).dot(offset) - m.geom_rbound[other] - pair.reach;
  }
  const double of_spheres = (center_a - center_b).norm() - m.geom_rbound[a] - m.geom_rbound[b] - pair.reach;
  if (of_spheres > kClose) return of_spheres;
  return physics().mj_geomDistance(&m, &d, a, b, 1e3, nullptr) - pair.reach;
}

}  // namespace kinegraph::inline simulation_internal
