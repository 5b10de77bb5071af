// The kernel of ik_kernel.h for registers of `kLanes` doubles. Each source file that includes this is compiled for its
// own instruction set; all names are local to it, and products are not fused with sums, so that all give the same bits.

#include "kinegraph/ik/damped_rows.h"
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
  // Entries are sums, because joints that mimic one another share a variable.
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
    } else if (task.directed) {  // two rows, across the wanted direction: a turn about it is free
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

void step(const IkKernelModel& model, const IkKernelMemory& memory) {
  const auto lanes = [](double* numbers) { return reinterpret_cast<Lane*>(numbers); };
  Lane A[kMostIkRows * kMostIkRows], y[kMostIkRows], inverse_pivots[kMostIkRows];
  const DampedRows<Lane> rows{model.rows,
                              model.variables(),
                              lanes(memory.jacobian),
                              lanes(memory.error),
                              nullptr,
                              lanes(memory.x),
                              model.lower,
                              model.upper,
                              model.longest,
                              lanes(memory.keep),
                              lanes(memory.next),
                              A,
                              y,
                              inverse_pivots};
  dampedStep(rows, dampingOf(*lanes(memory.square)));
}

void runIk(const IkKernelModel& model, const IkKernelMemory& memory) {
  const auto lanes = [](double* numbers) { return reinterpret_cast<Lane*>(numbers); };
  placeLinks(model.links, lanes(memory.x), lanes(memory.pose), lanes(memory.motion));
  measure(model, memory);
  step(model, memory);
}

}  // namespace

}  // namespace kinegraph::lanes
