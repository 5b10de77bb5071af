#include "kinegraph/planning/infeasibility_proof.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/planning/endpoints.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr double kMostCells = 300000.;
constexpr std::size_t kMostBodies = 4;  // the thickest ones
constexpr double kRounding = 1e-6;      // m
constexpr double kDepth = 2e-5;         // error of depths of round bodies, as a share of their size
constexpr double kParallel = 1e-9;      // rad
constexpr long kPollEvery = 16;         // cells
constexpr double kThin = 1e-4;          // m: a smaller extent is one layer of cells

struct Extent {
  Vector3d low, high;
};

double farthest(const Extent& box, int i, int j) {
  return std::hypot(std::max(std::abs(box.low[i]), std::abs(box.high[i])),
                    std::max(std::abs(box.low[j]), std::abs(box.high[j])));
}

/// Extends a box by the displacements of a step of a joint.
void moveExtent(Extent& box, const LaneModel::Step& step, const MotionStep& kind, int dof,
                const KinematicModel& model) {
  if (kind.translates()) {
    const double a = step.factor * model.lower[dof], b = step.factor * model.upper[dof];
    box.low[step.axis] += std::min(a, b);
    box.high[step.axis] += std::max(a, b);
  } else if (kind.moves()) {
    const bool about_axis = kind.kind == MotionKind::rotate || kind.kind == MotionKind::circle;
    const int axis = kind.kind == MotionKind::circle ? 2 : step.axis;
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const double radius = about_axis ? farthest(box, i, j) : std::hypot(farthest(box, 0, 1), farthest(box, 2, 2));
    for (int k = 0; k < 3; ++k) {
      if (about_axis && k == axis) continue;
      box.low[k] = -radius;
      box.high[k] = radius;
    }
  }
}

/// A box of all places of a point of a link in the world.
Extent reachOf(const State& scene, int link, const Vector3d& point) {
  const KinematicModel& model = scene.model();
  Extent box{point, point};
  for (; link != 0; link = model.links[std::size_t(link)].parent) {
    const KinematicModel::Link& at = model.links[std::size_t(link)];
    int dof = at.dof;
    for (int s = 0; s < at.steps; ++s) dof += model.steps[std::size_t(at.first_step + s)].dofs();
    for (int s = at.first_step + at.steps - 1; s >= at.first_step; --s) {
      const MotionStep& kind = model.steps[std::size_t(s)];
      dof -= kind.dofs();
      moveExtent(box, scene.parameters().step[std::size_t(s)], kind, dof, model);
    }
    const LaneModel::Link& base = scene.parameters().link[std::size_t(link)];
    const Matrix3d R = Eigen::Map<const Matrix3d>(base.R);
    const Vector3d center = R * (.5 * (box.low + box.high)) + Eigen::Map<const Vector3d>(base.p);
    const Vector3d half = R.cwiseAbs() * (.5 * (box.high - box.low));
    box = {center - half, center + half};
  }
  return box;
}

/// A shape inside of a moving body that has the same axes in the world at all configurations, and its static obstacles.
struct Core {
  int frame;
  Vector3d center;  ///< in the frame, m
  double radius;    ///< of the largest ball around it in the body, m
  std::vector<int> obstacles;
  std::string description = {};
  std::shared_ptr<const CollisionBody> body = pointBody();
  Matrix3d R = Matrix3d::Identity();  ///< the body's axes
  double radius_added = 0.;           ///< by which the core is thicker than `body`, m
};

std::vector<Core> thickestBodies(const State& scene) {
  const KinematicModel& model = scene.model();
  const auto point = pointBody();
  std::vector<Core> balls;
  for (std::size_t frame = 0; frame < model.body.size(); ++frame) {
    const auto& body = model.body[frame];
    if (!body || model.frame_link[frame] == 0) continue;
    Core ball{int(frame), body->boundCenter(), 0., {}};
    for (const auto& [a, b] : model.movingPairs()) {
      if (a == int(frame) && model.frame_link[std::size_t(b)] == 0) ball.obstacles.push_back(b);
      if (b == int(frame) && model.frame_link[std::size_t(a)] == 0) ball.obstacles.push_back(a);
    }
    ball.radius = -proximity(*point, {Matrix3d::Identity(), ball.center}, *body, {}).distance - kRounding;
    if (!ball.obstacles.empty() && ball.radius > 0.) balls.push_back(std::move(ball));
  }
  std::stable_sort(balls.begin(), balls.end(), [](const auto& x, const auto& y) { return x.radius > y.radius; });
  if (balls.size() > kMostBodies) balls.resize(kMostBodies);
  return balls;
}

Core ballOf(Core core, const std::string& name) {
  core.description = cat("a ball of ", formatLength(core.radius), " inside of '", name, "'");
  core.radius_added = core.radius;
  return core;
}

/// The core of a body that joints rotate about one direction of the world only, or not at all: the body if these
/// rotations do not change it, or the upright cylinder inscribed in a box.
std::optional<Core> uprightOf(Core core, const State& scene, const std::string& name) {
  const std::shared_ptr<const CollisionBody>& body = scene.model().body[std::size_t(core.frame)];
  if (!body->convex()) return std::nullopt;
  Vector3d axis = Vector3d::Zero();
  bool is_one = true;
  scene.forTwists(core.frame, [&](int, const State::Twist& twist) {
    const double rotation = twist.angular.norm();
    if (rotation == 0.) return;
    if (axis.isZero(0.)) axis = twist.angular / rotation;
    is_one &= axis.cross(twist.angular).norm() <= kParallel * rotation;
  });
  if (!is_one) return std::nullopt;
  core.R = scene.pose(core.frame).R;
  core.body = body;
  core.description = cat("'", name, "'");
  const Vector3d local = core.R.transpose() * axis;
  int along = 0;
  const bool has_axis = local.cwiseAbs().maxCoeff(&along) > 1. - kParallel;
  const auto kind = body->core();
  const bool is_round = kind == CollisionBody::Core::segment || kind == CollisionBody::Core::cylinder;
  if (axis.isZero(0.) || (is_round && has_axis && along == 2)) return core;
  if (kind != CollisionBody::Core::box || !has_axis) return std::nullopt;
  const Vector3d& half = body->halfSides();
  const double radius = std::min(half[(along + 1) % 3], half[(along + 2) % 3]) + body->radius();
  core.body = makeCollisionBody({ShapeType::cylinder, {2. * half[along], radius}, nullptr});
  core.R = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix();
  core.description = cat("an upright cylinder of radius ", formatLength(radius), " inside of '", name, "'");
  return core;
}

/// A grid of the places to which joints can bring the center of a core.
class PlaceGrid {
 public:
  PlaceGrid(const State& scene, const Core& core, double margin) : scene_(scene), core_(core), margin_(margin) {
    const RigidTransform& offset = scene.parameters().frame_offset[std::size_t(core.frame)];
    const Extent reach = reachOf(scene, scene.link(core.frame), offset * core.center);
    low_ = reach.low.array() - 1e-9;
    const Vector3d size = (reach.high - reach.low).cwiseMax(kThin);
    const int wide = int((size.array() > kThin).count());
    double volume = 1.;
    for (int k = 0; k < 3; ++k) volume *= size[k] > kThin ? size[k] : 1.;
    const double edge = std::max(std::pow(volume / kMostCells, 1. / std::max(wide, 1)), 1e-4);
    double cells = 1.;
    for (int k = 0; k < 3; ++k) {
      count_[k] = size[k] > kThin ? int(std::ceil(size[k] / edge)) + 1 : 1;
      edge_[k] = size[k] > kThin ? edge : size[k] + 2e-9;
      cells *= count_[k];
    }
    is_possible_ = std::isfinite(cells) && cells < 4. * kMostCells;
    if (is_possible_) state_.assign(std::size_t(cells), Cell::unknown);
  }

  /// Whether no open cells connect the start's cell to one of the goals'. Records the obstacles that close cells.
  bool separates(const VectorXd& start, const std::vector<VectorXd>& goals, const CancellationToken& cancellation) {
    if (!is_possible_) return false;
    std::set<std::size_t> wanted;
    for (const VectorXd& goal : goals) wanted.insert(cellOf(goal));
    std::vector<std::size_t> front = {cellOf(start)};
    state_[front[0]] = Cell::reached;
    while (!front.empty()) {
      const std::size_t cell = front.back();
      front.pop_back();
      if (wanted.count(cell)) return false;
      if (++visited_ % kPollEvery == 0 && cancellation && cancellation()) return false;
      forNeighbors(cell, [&](std::size_t next) {
        if (state_[next] != Cell::unknown) return;
        state_[next] = isClosed(next) ? Cell::closed : Cell::reached;
        if (state_[next] == Cell::reached) front.push_back(next);
      });
    }
    return true;
  }

  const std::set<int>& closers() const { return closers_; }

 private:
  enum class Cell : unsigned char { unknown, reached, closed };

  std::size_t cellOf(const VectorXd& q) {
    scene_.setJoints(q.data());
    const Vector3d at = scene_.pose(core_.frame) * core_.center;
    std::size_t cell = 0;
    for (int k = 2; k >= 0; --k) {
      const int i = std::clamp(int((at[k] - low_[k]) / edge_[k]), 0, count_[k] - 1);
      cell = cell * std::size_t(count_[k]) + std::size_t(i);
    }
    return cell;
  }

  std::array<int, 3> placeOf(std::size_t cell) const {
    const auto n0 = std::size_t(count_[0]), n1 = std::size_t(count_[1]);
    return {int(cell % n0), int(cell / n0 % n1), int(cell / (n0 * n1))};
  }

  template <class Visit>
  void forNeighbors(std::size_t cell, const Visit& visit) const {
    const std::array<int, 3> at = placeOf(cell);
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int x = at[0] + dx, y = at[1] + dy, z = at[2] + dz;
          if (x < 0 || y < 0 || z < 0 || x >= count_[0] || y >= count_[1] || z >= count_[2]) continue;
          visit((std::size_t(z) * std::size_t(count_[1]) + std::size_t(y)) * std::size_t(count_[0]) + std::size_t(x));
        }
      }
    }
  }

  /// Whether a core with its center anywhere in the cell is too close to one obstacle.
  bool isClosed(std::size_t cell) {
    const std::array<int, 3> at = placeOf(cell);
    Vector3d center;
    for (int k = 0; k < 3; ++k) center[k] = low_[k] + (at[std::size_t(k)] + .5) * edge_[k];
    const double size = core_.body->boundRadius();
    const double near = core_.radius_added + margin_ - .5 * edge_.norm() - kRounding - kDepth * size;
    if (near + size <= 0.) return false;
    const KinematicModel& model = scene_.model();
    const RigidTransform X_WC{core_.R, center - core_.R * core_.body->boundCenter()};
    for (const int frame : core_.obstacles) {
      const CollisionBody& body = *model.body[std::size_t(frame)];
      const RigidTransform X = scene_.pose(frame);
      if (!mayBeWithin(body, X, center, near + size)) continue;
      if (proximity(*core_.body, X_WC, body, X).distance >= near) continue;
      closers_.insert(frame);
      return true;
    }
    return false;
  }

  State scene_;
  const Core& core_;
  double margin_;
  Vector3d low_, edge_;
  int count_[3] = {1, 1, 1};
  bool is_possible_ = false;
  long visited_ = 0;
  std::vector<Cell> state_;
  std::set<int> closers_;
};

}  // namespace

std::string proveInfeasible(const State& scene, const VectorXd& start, const std::vector<VectorXd>& goals,
                            double margin, const CancellationToken& cancellation) {
  const KinematicModel& model = scene.model();
  std::vector<Core> cores;
  for (const Core& body : thickestBodies(scene)) {
    const std::string& name = model.frame_name[std::size_t(body.frame)];
    cores.push_back(ballOf(body, name));
    if (std::optional<Core> upright = uprightOf(body, scene, name)) cores.push_back(std::move(*upright));
  }
  for (const Core& core : cores) {
    if (cancellation && cancellation()) return "";
    PlaceGrid grid(scene, core, margin);
    if (!grid.separates(start, goals, cancellation)) continue;
    std::vector<std::string> names;
    for (const int frame : grid.closers()) {
      if (names.size() < 4) names.push_back(cat("'", model.frame_name[std::size_t(frame)], "'"));
    }
    return cat("there is no path: ", core.description, " does not get past ", join(names),
               margin > 0. ? cat(" with a margin of ", formatLength(margin)) : "");
  }
  return "";
}

}  // namespace kinegraph::inline planning_internal
