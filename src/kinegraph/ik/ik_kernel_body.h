// The kernel of ik_kernel.h for registers of `kLanes` doubles. Each source file that includes this is compiled for its
// own instruction set. All names are local to it. Products are not fused with sums, so that all instruction sets give
// the same bits.

#include "kinegraph/ik/damped_rows.h"
#include "kinegraph/ik/ik_kernel.h"
#include "kinegraph/kinematics/place_lanes.h"

namespace kinegraph::lanes {

namespace {

using Lane = Pack<kLanes>;
using Mask = decltype(Lane{} < Lane{});
using Vector = Vec3<Lane>;
using Pose = Place<Vector>;

/// Computes the angle in [0, pi] of a cosine, and that angle over its sine, accurate to 2e-8.
/// Source: Abramowitz & Stegun, Handbook of Mathematical Functions, 4.4.46.
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

constexpr double kHalfRotation = 1e-6;  // below this sine the cross product does not give the axis of an obtuse angle

/// Returns the rotation vector from R to R_goal, in world coordinates.
Vector rotationBetween(const Vector* R_goal, const Vector* R, Lane& angle) {
  const Vector twice_sine = cross(R[0], R_goal[0]) + cross(R[1], R_goal[1]) + cross(R[2], R_goal[2]);
  const Lane cosine = .5 * (dot(R[0], R_goal[0]) + dot(R[1], R_goal[1]) + dot(R[2], R_goal[2]) - 1.);
  const Lane sine = .5 * root(dot(twice_sine, twice_sine));
  Lane over_sine;
  angleOfCosine(cosine, angle, over_sine);
  angle = cosine < 0. ? angle : over_sine * sine;
  Vector rotation = (.5 * over_sine) * twice_sine;
  const Mask half = (sine < kHalfRotation) & (cosine < 0.);
  if (any(half)) {  // R_goal R^T + 1 = 2 a a^T then: its largest column gives the axis a
    Vector sum[3];
    for (int k = 0; k < 3; ++k) {
      const auto entry = [k](const Vector& a) { return k == 0 ? a.x : k == 1 ? a.y : a.z; };
      sum[k] = entry(R[0]) * R_goal[0] + entry(R[1]) * R_goal[1] + entry(R[2]) * R_goal[2];
    }
    sum[0].x += 1., sum[1].y += 1., sum[2].z += 1.;
    const Mask first = (sum[0].x >= sum[1].y) & (sum[0].x >= sum[2].z);
    const Vector axis = choose(first, sum[0], choose(sum[1].y >= sum[2].z, sum[1], sum[2]));
    rotation = choose(half, (kPi / root(larger(dot(axis, axis), all<Lane>(1e-12)))) * axis, rotation);
  }
  return rotation;
}

/// Returns the shortest rotation vector that brings the unit vector a to b; about `across` if they are opposite.
Vector rotationBetween(const Vector& a, const Vector& b, const Vector& across, Lane& angle) {
  const Vector normal = cross(a, b);
  const Lane cosine = dot(a, b), sine = root(dot(normal, normal));
  Lane over_sine;
  angleOfCosine(cosine, angle, over_sine);
  angle = cosine < 0. ? angle : over_sine * sine;
  return choose((sine < kHalfRotation) & (cosine < 0.), kPi * across, over_sine * normal);
}

/// Computes the errors of the targets and their Jacobian.
void measure(const IkKernelModel& model, const IkKernelMemory& memory) {
  Lane* J = reinterpret_cast<Lane*>(memory.jacobian);
  Lane* e = reinterpret_cast<Lane*>(memory.error);
  // Entries are sums because joints that mimic one another share a variable.
  for (int i = 0; i < model.variables() * model.rows; ++i) J[i] = Lane{};
  Lane square{}, worst_distance{}, worst_angle{};
  int row = 0;
  for (int t = 0; t < model.tasks; ++t) {
    const IkKernelModel::Task& task = model.task[t];
    const Lane* goal = reinterpret_cast<const Lane*>(memory.goal) + t * IkKernelMemory::kPerGoal;
    const Vector across[2] = {load(goal + 12), load(goal + 15)};
    const Lane* link = reinterpret_cast<const Lane*>(memory.pose) + task.frame.link * LaneMemory::kPerPose;
    const Pose X = moved<Vector>(link, task.frame.rotation, task.frame.R, task.frame.p);
    int at = row;
    if (task.has_position) {
      const Vector offset = load(goal + 9) - X.p;
      const Lane distance = dot(offset, offset);
      square += distance;
      worst_distance = larger(worst_distance, distance);
      e[at++] = offset.x, e[at++] = offset.y, e[at++] = offset.z;
    }
    Lane angle{};
    if (task.has_rotation) {
      const Vector R_goal[3] = {load(goal), load(goal + 3), load(goal + 6)};
      const Vector rotation = rotationBetween(R_goal, X.R, angle);
      e[at++] = rotation.x, e[at++] = rotation.y, e[at++] = rotation.z;
    } else if (task.has_direction) {  // two rows, across the target direction: the rotation about it is free
      const Vector rotation = rotationBetween(combine(X.R, task.axis), load(goal + 9), across[0], angle);
      e[at++] = dot(rotation, across[0]), e[at++] = dot(rotation, across[1]);
    }
    square += angle * angle;
    worst_angle = larger(worst_angle, angle);
    for (int c = task.first_column; c < task.first_column + task.columns; ++c) {
      const IkKernelModel::Column& column = model.column[c];
      const Lane* motion = reinterpret_cast<const Lane*>(memory.motion) + column.column * LaneMemory::kPerColumn;
      const Vector angular = load(motion), point = load(motion + 3);
      const bool is_rotation = column.is_rotation;
      Lane* to = J + column.variable * model.rows + row;
      if (task.has_position) {
        const Vector velocity = is_rotation ? cross(angular, X.p - point) : point;
        *to++ += velocity.x, *to++ += velocity.y, *to++ += velocity.z;
      }
      if (!is_rotation) continue;
      if (task.has_rotation) {
        *to++ += angular.x, *to++ += angular.y, *to++ += angular.z;
      } else if (task.has_direction) {
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
