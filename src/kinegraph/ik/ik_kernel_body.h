// The kernel of ik_kernel.h for registers of `kLanes` doubles. Each source file that includes this is compiled for its
// own instruction set; all names are local to it, and products are not fused with sums, so that all give the same bits.

#include "kinegraph/ik/ik_kernel.h"
#include "kinegraph/kinematics/place_lanes.h"

namespace kinegraph::lanes {

namespace {

using Lane = Pack<kLanes>;
using Mask = decltype(Lane{} < Lane{});
using Vector = Vec3<Lane>;
using Pose = Place<Vector>;

/// The angle in [0, pi] of a cosine, and that angle over its sine.
/// Source: Abramowitz & Stegun, Handbook of Mathematical Functions, 4.4.46; to 2e-8.
void angleOfCosine(Lane cosine, Lane& angle, Lane& over_sine) {
  const Lane c = smaller(magnitude(cosine), all<Lane>(1.));
  const Lane p =
      1.5707963050 +
      c * (-.2145988016 +
           c * (.0889789874 +
                c * (-.0501743046 + c * (.0308918810 + c * (-.0170881256 + c * (.0066700901 - c * .0012624911))))));
  const Lane less = root(1. - c), more = root(1. + c);
  const Mask obtuse = cosine < 0.;
  angle = obtuse ? kPi - less * p : less * p;
  over_sine = obtuse ? angle / larger(less * more, all<Lane>(1e-12)) : p / more;
}

constexpr double kHalfTurn = 1e-6;  // sine below which the axis of an obtuse angle is not in the cross product

/// The rotation vector that brings R to the goal's, in world coordinates.
Vector turnBetween(const Vector* R_goal, const Vector* R, Lane& angle) {
  const Vector twice_sine = cross(R[0], R_goal[0]) + cross(R[1], R_goal[1]) + cross(R[2], R_goal[2]);
  const Lane cosine = .5 * (dot(R[0], R_goal[0]) + dot(R[1], R_goal[1]) + dot(R[2], R_goal[2]) - 1.);
  const Lane sine = .5 * root(dot(twice_sine, twice_sine));
  Lane over_sine;
  angleOfCosine(cosine, angle, over_sine);
  angle = cosine < 0. ? angle : over_sine * sine;
  Vector turn = (.5 * over_sine) * twice_sine;
  const Mask half = (sine < kHalfTurn) & (cosine < 0.);
  if (any(half)) {  // R_goal R^T + 1 = 2 a a^T there: its largest column gives the axis
    Vector sum[3];
    for (int k = 0; k < 3; ++k) {
      const auto entry = [k](const Vector& a) { return k == 0 ? a.x : k == 1 ? a.y : a.z; };
      sum[k] = entry(R[0]) * R_goal[0] + entry(R[1]) * R_goal[1] + entry(R[2]) * R_goal[2];
    }
    sum[0].x += 1., sum[1].y += 1., sum[2].z += 1.;
    const Mask first = (sum[0].x >= sum[1].y) & (sum[0].x >= sum[2].z);
    const Vector axis = choose(first, sum[0], choose(sum[1].y >= sum[2].z, sum[1], sum[2]));
    turn = choose(half, (kPi / root(larger(dot(axis, axis), all<Lane>(1e-12)))) * axis, turn);
  }
  return turn;
}

/// The rotation vector that turns the unit vector a into b the short way; about `across` where they are opposite.
Vector turnBetween(const Vector& a, const Vector& b, const Vector& across, Lane& angle) {
  const Vector normal = cross(a, b);
  const Lane cosine = dot(a, b), sine = root(dot(normal, normal));
  Lane over_sine;
  angleOfCosine(cosine, angle, over_sine);
  angle = cosine < 0. ? angle : over_sine * sine;
  return choose((sine < kHalfTurn) & (cosine < 0.), kPi * across, over_sine * normal);
}

/// Rows of the targets: errors, and columns of the Jacobian.
void measure(const IkKernelModel& model, const IkKernelMemory& memory) {
  Lane* J = reinterpret_cast<Lane*>(memory.jacobian);
  Lane* e = reinterpret_cast<Lane*>(memory.error);
  for (int i = 0; i < model.variables() * model.rows; ++i) J[i] = Lane{};
  Lane square{}, worst_distance{}, worst_angle{};
  int row = 0;
  for (int t = 0; t < model.tasks; ++t) {
    const IkKernelModel::Task& task = model.task[t];
    const Lane* goal = reinterpret_cast<const Lane*>(memory.goal) + t * IkKernelMemory::kPerGoal;
    const Vector across[2] = {load(goal + 12), load(goal + 15)};
    const Lane* link = reinterpret_cast<const Lane*>(memory.pose) + task.frame.link * LaneMemory::kPerPose;
    const Pose X = moved<Vector>(link, task.frame.turn, task.frame.R, task.frame.p);
    int at = row;
    if (task.placed) {
      const Vector missing = load(goal + 9) - X.p;
      const Lane distance = dot(missing, missing);
      square += distance;
      worst_distance = larger(worst_distance, distance);
      e[at++] = missing.x, e[at++] = missing.y, e[at++] = missing.z;
    }
    Lane angle{};
    if (task.turned) {
      const Vector R_goal[3] = {load(goal), load(goal + 3), load(goal + 6)};
      const Vector turn = turnBetween(R_goal, X.R, angle);
      e[at++] = turn.x, e[at++] = turn.y, e[at++] = turn.z;
    } else if (task.directed) {
      const Vector turn = turnBetween(combine(X.R, task.axis), load(goal + 9), across[0], angle);
      e[at++] = dot(turn, across[0]), e[at++] = dot(turn, across[1]);
    }
    square += angle * angle;
    worst_angle = larger(worst_angle, angle);
    for (int c = task.first_column; c < task.first_column + task.columns; ++c) {
      const IkKernelModel::Column& column = model.column[c];
      const Lane* motion = reinterpret_cast<const Lane*>(memory.motion) + column.column * LaneMemory::kPerColumn;
      const Vector angular = load(motion), point = load(motion + 3);
      const bool turns = column.turns;
      Lane* to = J + column.variable * model.rows + row;
      if (task.placed) {
        const Vector velocity = turns ? cross(angular, X.p - point) : point;
        *to++ += velocity.x, *to++ += velocity.y, *to++ += velocity.z;
      }
      if (!turns) continue;
      if (task.turned) {
        *to++ += angular.x, *to++ += angular.y, *to++ += angular.z;
      } else if (task.directed) {
        *to++ += dot(angular, across[0]), *to++ += dot(angular, across[1]);
      }
    }
    row = at;
  }
  *reinterpret_cast<Lane*>(memory.square) = square;
  *reinterpret_cast<Lane*>(memory.distance) = worst_distance;
  *reinterpret_cast<Lane*>(memory.angle) = worst_angle;
}

/// next = keep J^T (J keep J^T + damping)^-1 error
template <int Rows>
void solveRows(const IkKernelModel& model, const IkKernelMemory& memory, Lane damping) {
  const int m = Rows > 0 ? Rows : model.rows;
  const Lane* J = reinterpret_cast<const Lane*>(memory.jacobian);
  const Lane* e = reinterpret_cast<const Lane*>(memory.error);
  const Lane* keep = reinterpret_cast<const Lane*>(memory.keep);
  Lane* next = reinterpret_cast<Lane*>(memory.next);
  constexpr int kSize = Rows > 0 ? Rows : kMostIkRows;
  Lane A[kSize * kSize], y[kSize], inverse[kSize];  // lower triangle of A, row by row
  for (int r = 0; r < m; ++r) {
    for (int s = 0; s < r; ++s) A[r * kSize + s] = Lane{};
    A[r * kSize + r] = damping;
    y[r] = e[r];
  }
  for (int v = 0; v < model.variables(); ++v) {
    for (int r = 0; r < m; ++r) {
      const Lane kept = keep[v] * J[v * m + r];
      for (int s = 0; s <= r; ++s) A[r * kSize + s] += kept * J[v * m + s];
    }
  }
  const Lane least = 1e-3 * damping;
  for (int r = 0; r < m; ++r) {  // A = L D L^T in place, and y = L^-1 y on the way
    Lane* row = A + r * kSize;
    for (int s = 0; s < r; ++s) {
      for (int t = 0; t < s; ++t) row[s] -= A[s * kSize + t] * row[t];
    }
    Lane pivot = row[r];
    for (int s = 0; s < r; ++s) {
      const Lane value = row[s] * inverse[s];
      pivot -= row[s] * value;
      row[s] = value;
      y[r] -= value * y[s];
    }
    inverse[r] = 1. / larger(pivot, least);
  }
  for (int r = m - 1; r >= 0; --r) {
    y[r] *= inverse[r];
    for (int s = r + 1; s < m; ++s) y[r] -= A[s * kSize + r] * y[s];
  }
  for (int v = 0; v < model.variables(); ++v) {
    Lane value{};
    for (int r = 0; r < m; ++r) value += J[v * m + r] * y[r];
    next[v] = keep[v] * value;
  }
}

void step(const IkKernelModel& model, const IkKernelMemory& memory) {
  const Lane* x = reinterpret_cast<const Lane*>(memory.x);
  Lane* keep = reinterpret_cast<Lane*>(memory.keep);
  Lane* next = reinterpret_cast<Lane*>(memory.next);
  const Lane square = *reinterpret_cast<const Lane*>(memory.square);
  const Lane damping = kLeastDamping + kDampingPerSquare * smaller(square, all<Lane>(kMostSquares));
  for (int v = 0; v < model.variables(); ++v) keep[v] = all<Lane>(1.);
  for (int pass = 0; pass < 4; ++pass) {
    switch (model.rows) {
      case 3:
        solveRows<3>(model, memory, damping);
        break;
      case 6:
        solveRows<6>(model, memory, damping);
        break;
      default:
        solveRows<0>(model, memory, damping);
        break;
    }
    Mask changed{};
    for (int v = 0; v < model.variables(); ++v) {
      const Mask crosses = ((next[v] < 0.) & (x[v] <= model.lower[v])) | ((next[v] > 0.) & (x[v] >= model.upper[v]));
      keep[v] = crosses ? Lane{} : keep[v];
      changed |= crosses;
    }
    if (!any(changed)) break;
  }
  Lane excess = all<Lane>(1.);
  for (int v = 0; v < model.variables(); ++v) excess = larger(excess, magnitude(next[v]) / model.longest[v]);
  const Lane share = 1. / excess;
  for (int v = 0; v < model.variables(); ++v) {
    const bool limited = model.longest[v] < 1e300;
    const Lane moved = x[v] + (limited ? share * next[v] : next[v]);
    next[v] = smaller(larger(moved, all<Lane>(model.lower[v])), all<Lane>(model.upper[v]));
  }
}

void runIk(const IkKernelModel& model, const IkKernelMemory& memory) {
  const auto lanes = [](double* numbers) { return reinterpret_cast<Lane*>(numbers); };
  placeLinks(model.links, lanes(memory.x), lanes(memory.pose), lanes(memory.motion));
  measure(model, memory);
  step(model, memory);
}

}  // namespace

}  // namespace kinegraph::lanes
