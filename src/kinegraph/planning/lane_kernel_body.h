// The kernel of lane_kernel.h for registers of `kLanes` doubles. Each source file that includes this is compiled for its
// own instruction set; all names are local to it, and products are not fused with sums, so that all give the same bits.

#include "kinegraph/planning/lane_kernel.h"

namespace kinegraph::lanes {

namespace {

typedef double Lane __attribute__((vector_size(kLanes * sizeof(double))));
typedef long long Mask __attribute__((vector_size(kLanes * sizeof(double))));

constexpr double kPi = 3.14159265358979323846;

Lane all(double value) { return Lane{} + value; }
Lane smaller(Lane a, Lane b) { return a < b ? a : b; }
Lane larger(Lane a, Lane b) { return a > b ? a : b; }
Lane magnitude(Lane a) { return a < 0. ? -a : a; }

bool any(Mask mask) {
  long long found = 0;
  for (int i = 0; i < kLanes; ++i) found |= mask[i];
  return found != 0;
}

Lane root(Lane a) {
  for (int i = 0; i < kLanes; ++i) a[i] = __builtin_sqrt(a[i]);
  return a;
}

struct Vector {
  Lane x, y, z;
};

Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator*(Lane s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
Vector operator*(double s, const Vector& a) { return all(s) * a; }
Lane dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vector choose(Mask mask, const Vector& a, const Vector& b) { return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z}; }

Vector load(const double* from) {
  const Lane* lane = reinterpret_cast<const Lane*>(from);
  return {lane[0], lane[1], lane[2]};
}

void store(const Vector& a, double* to) {
  Lane* lane = reinterpret_cast<Lane*>(to);
  lane[0] = a.x, lane[1] = a.y, lane[2] = a.z;
}

/// sum_k column k * weights[k]; weights of 0 and 1 are frequent, and the same in all lanes.
Vector combine(const Vector* columns, const double* weights) {
  Vector sum = {Lane{}, Lane{}, Lane{}};
  for (int k = 0; k < 3; ++k) {
    if (weights[k] == 0.) continue;
    sum = sum + all(weights[k]) * columns[k];
  }
  return sum;
}

struct Pose {
  Vector R[3];  ///< columns
  Vector p;

  Pose times(const double* R_const, const double* p_const) const {
    return {{combine(R, R_const), combine(R, R_const + 3), combine(R, R_const + 6)}, p + combine(R, p_const)};
  }
};

/// Taylor series on [-pi/4, pi/4], and quadrants.
void sineAndCosine(Lane angle, Lane& sine, Lane& cosine) {
  constexpr double kRound = 6755399441055744.;  // 1.5 * 2^52: what is added to it is rounded to a whole number
  const Lane shifted = angle * (2. / kPi) + kRound;
  const Lane quarters = shifted - kRound;
  const Lane r = (angle - quarters * 1.5707963267341256) - quarters * 6.077100506506192e-11;  // pi/2 in two parts
  const Lane s = r * r;
  const Lane sin_r = r + r * s * (-1. / 6 + s * (1. / 120 + s * (-1. / 5040 + s * (1. / 362880 + s * (-1. / 39916800 +
                     s * (1. / 6227020800. - s * (1. / 1307674368000.)))))));
  const Lane cos_r = 1. + s * (-.5 + s * (1. / 24 + s * (-1. / 720 + s * (1. / 40320 + s * (-1. / 3628800 +
                     s * (1. / 479001600. + s * (-1. / 87178291200. + s * (1. / 20922789888000.))))))));
  const Mask quadrant = (Mask)shifted;
  const Mask swaps = (quadrant & 1) != 0;
  const Lane a = swaps ? cos_r : sin_r, b = swaps ? sin_r : cos_r;
  sine = (quadrant & 2) != 0 ? -a : a;
  cosine = ((quadrant + 1) & 2) != 0 ? -b : b;
}

/// The angle in [0, pi] of a cosine, and that angle over its sine.
/// Source: Abramowitz & Stegun, Handbook of Mathematical Functions, 4.4.46; to 2e-8.
void angleOfCosine(Lane cosine, Lane& angle, Lane& over_sine) {
  const Lane c = smaller(magnitude(cosine), all(1.));
  const Lane p = 1.5707963050 + c * (-.2145988016 + c * (.0889789874 + c * (-.0501743046 + c * (.0308918810 +
                 c * (-.0170881256 + c * (.0066700901 - c * .0012624911))))));
  const Lane less = root(1. - c), more = root(1. + c);
  const Mask obtuse = cosine < 0.;
  angle = obtuse ? kPi - less * p : less * p;
  over_sine = obtuse ? angle / larger(less * more, all(1e-12)) : p / more;
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
    turn = choose(half, (kPi / root(larger(dot(axis, axis), all(1e-12)))) * axis, turn);
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

Pose loadPose(const double* from) {
  return {{load(from), load(from + 3 * kLanes), load(from + 6 * kLanes)}, load(from + 9 * kLanes)};
}

void move(const LaneModel::Step& step, Lane x, Pose& X, double* motion) {
  const Lane value = step.factor * x;
  if (step.kind == LaneModel::Step::translate) {
    const Vector along = X.R[step.axis];
    store({Lane{}, Lane{}, Lane{}}, motion);
    store(step.factor * along, motion + 3 * kLanes);
    X.p = X.p + value * along;
    return;
  }
  Lane sine, cosine;
  sineAndCosine(value, sine, cosine);
  if (step.kind == LaneModel::Step::rotate) {
    store(step.factor * X.R[step.axis], motion);
    const int i = step.axis == 2 ? 0 : step.axis + 1, j = step.axis == 0 ? 2 : step.axis - 1;
    const Vector a = X.R[i], b = X.R[j];
    X.R[i] = cosine * a + sine * b;
    X.R[j] = cosine * b - sine * a;
  } else {  // every column c turns about the axis: cos c + sin (axis x c) + (1 - cos) (axis . c) axis
    const Vector axis = combine(X.R, step.about);
    store(step.factor * axis, motion);
    const Vector about = {all(step.about[0]), all(step.about[1]), all(step.about[2])};
    const Vector old[3] = {X.R[0], X.R[1], X.R[2]};
    for (int k = 0; k < 3; ++k) {
      const Lane along = (1. - cosine) * (k == 0 ? about.x : k == 1 ? about.y : about.z);
      X.R[k] = cosine * old[k] + sine * cross(axis, old[k]) + along * axis;
    }
  }
  store(X.p, motion + 3 * kLanes);
}

void placeLinks(const LaneModel& model, const LaneMemory& memory) {
  const Lane* x = reinterpret_cast<const Lane*>(memory.x);
  const Lane zero{}, one = all(1.);
  const Pose world = {{{one, zero, zero}, {zero, one, zero}, {zero, zero, one}}, {zero, zero, zero}};
  for (int l = 0; l < model.links; ++l) {
    const LaneModel::Link& link = model.link[l];
    const Pose parent = link.parent < 0 ? world : loadPose(memory.pose + link.parent * LaneMemory::kPerPose * kLanes);
    Pose X = parent.times(link.R, link.p);
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      move(model.step[s], x[model.step[s].variable], X, memory.motion + s * LaneMemory::kPerStep * kLanes);
    }
    double* to = memory.pose + l * LaneMemory::kPerPose * kLanes;
    for (int k = 0; k < 3; ++k) store(X.R[k], to + 3 * k * kLanes);
    store(X.p, to + 9 * kLanes);
  }
}

/// Rows of the targets: errors, and columns of the Jacobian.
void measure(const LaneModel& model, const LaneMemory& memory) {
  Lane* J = reinterpret_cast<Lane*>(memory.jacobian);
  Lane* e = reinterpret_cast<Lane*>(memory.error);
  for (int i = 0; i < model.variables * model.rows; ++i) J[i] = Lane{};
  Lane square{}, worst_distance{}, worst_angle{};
  int row = 0;
  for (int t = 0; t < model.tasks; ++t) {
    const LaneModel::Task& task = model.task[t];
    const double* goal = memory.goal + t * LaneMemory::kPerGoal * kLanes;
    const Vector across[2] = {load(goal + 12 * kLanes), load(goal + 15 * kLanes)};
    const Pose X = loadPose(memory.pose + task.link * LaneMemory::kPerPose * kLanes).times(task.R, task.p);
    int at = row;
    if (task.placed) {
      const Vector missing = load(goal + 9 * kLanes) - X.p;
      const Lane distance = dot(missing, missing);
      square += distance;
      worst_distance = larger(worst_distance, distance);
      e[at++] = missing.x, e[at++] = missing.y, e[at++] = missing.z;
    }
    Lane angle{};
    if (task.turned) {
      const Vector R_goal[3] = {load(goal), load(goal + 3 * kLanes), load(goal + 6 * kLanes)};
      const Vector turn = turnBetween(R_goal, X.R, angle);
      e[at++] = turn.x, e[at++] = turn.y, e[at++] = turn.z;
    } else if (task.directed) {
      const Vector turn = turnBetween(combine(X.R, task.axis), load(goal + 9 * kLanes), across[0], angle);
      e[at++] = dot(turn, across[0]), e[at++] = dot(turn, across[1]);
    }
    square += angle * angle;
    worst_angle = larger(worst_angle, angle);
    for (int c = task.first_column; c < task.first_column + task.columns; ++c) {
      const LaneModel::Step& step = model.step[model.column[c]];
      const double* motion = memory.motion + model.column[c] * LaneMemory::kPerStep * kLanes;
      const Vector angular = load(motion), point = load(motion + 3 * kLanes);
      const bool turns = step.kind != LaneModel::Step::translate;
      Lane* to = J + step.variable * model.rows + row;
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
void solveRows(const LaneModel& model, const LaneMemory& memory, Lane damping) {
  const int m = Rows > 0 ? Rows : model.rows;
  const Lane* J = reinterpret_cast<const Lane*>(memory.jacobian);
  const Lane* e = reinterpret_cast<const Lane*>(memory.error);
  const Lane* keep = reinterpret_cast<const Lane*>(memory.keep);
  Lane* next = reinterpret_cast<Lane*>(memory.next);
  constexpr int kSize = Rows > 0 ? Rows : kMostLaneRows;
  Lane A[kSize * kSize], y[kSize], inverse[kSize];  // lower triangle of A, row by row
  for (int r = 0; r < m; ++r) {
    for (int s = 0; s < r; ++s) A[r * kSize + s] = Lane{};
    A[r * kSize + r] = damping;
    y[r] = e[r];
  }
  for (int v = 0; v < model.variables; ++v) {
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
  for (int v = 0; v < model.variables; ++v) {
    Lane value{};
    for (int r = 0; r < m; ++r) value += J[v * m + r] * y[r];
    next[v] = keep[v] * value;
  }
}

void step(const LaneModel& model, const LaneMemory& memory) {
  const Lane* x = reinterpret_cast<const Lane*>(memory.x);
  Lane* keep = reinterpret_cast<Lane*>(memory.keep);
  Lane* next = reinterpret_cast<Lane*>(memory.next);
  const Lane square = *reinterpret_cast<const Lane*>(memory.square);
  const Lane damping = kLeastDamping + kDampingPerSquare * smaller(square, all(kMostSquares));
  for (int v = 0; v < model.variables; ++v) keep[v] = all(1.);
  for (int pass = 0; pass < 4; ++pass) {
    switch (model.rows) {
      case 3: solveRows<3>(model, memory, damping); break;
      case 6: solveRows<6>(model, memory, damping); break;
      default: solveRows<0>(model, memory, damping); break;
    }
    Mask changed{};
    for (int v = 0; v < model.variables; ++v) {
      const Mask crosses = ((next[v] < 0.) & (x[v] <= model.lower[v])) | ((next[v] > 0.) & (x[v] >= model.upper[v]));
      keep[v] = crosses ? Lane{} : keep[v];
      changed |= crosses;
    }
    if (!any(changed)) break;
  }
  Lane excess = all(1.);
  for (int v = 0; v < model.variables; ++v) excess = larger(excess, magnitude(next[v]) / model.longest[v]);
  const Lane share = 1. / excess;
  for (int v = 0; v < model.variables; ++v) {
    const bool limited = model.longest[v] < 1e300;
    const Lane moved = x[v] + (limited ? share * next[v] : next[v]);
    next[v] = smaller(larger(moved, all(model.lower[v])), all(model.upper[v]));
  }
}

}  // namespace

}  // namespace kinegraph::lanes
