#include "kinegraph/api/next_view.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/ik/solve_ik.h"
#include "kinegraph/perception/occupancy_map.h"
#include "kinegraph/rendering/camera_renderer.h"

namespace kinegraph {

namespace {

constexpr int kDirections = 96;         // around the cells in question
constexpr int kDistances = 3;           // per direction
constexpr int kMostInverse = 60;        // candidates for which a configuration is looked for
constexpr int kCompared = 3;            // configurations
constexpr std::size_t kMostCells = 80;  // whose visibility is computed

struct Candidate {
  Vector3d eye;
  int visible = 0;
};

/// What a camera would see of the cells in question.
class Visibility {
 public:
  Visibility(const OccupancyMap& map, std::vector<Vector3d> cells, const Camera& camera)
      : map_(map), cells_(std::move(cells)), camera_(camera) {}

  const std::vector<Vector3d>& cells() const { return cells_; }

  /// The number of cells with a free line of sight to the eye; with a pose, also within the image.
  int count(const Vector3d& eye, const std::vector<KnownShape>& shapes, const Pose* pose = nullptr) const {
    return int(std::count_if(cells_.begin(), cells_.end(), [&](const Vector3d& cell) {
      return (!pose || isInImage(pose->inverse() * Pose(cell, Quaterniond::Identity()))) && sees(eye, cell, shapes);
    }));
  }

 private:
  bool isInImage(const Pose& cell) const {
    const Vector3d& p = cell.p;
    if (p.z() < camera_.near) return false;
    const Vector4d f = camera_.fxycxy();
    const double u = f[0] * p.x() / p.z() + f[2], v = f[1] * p.y() / p.z() + f[3];
    return u > 0. && v > 0. && u < camera_.width && v < camera_.height;
  }

  /// Shapes before the near plane, such as the housing of the camera, hide nothing.
  bool sees(const Vector3d& eye, const Vector3d& cell, const std::vector<KnownShape>& shapes) const {
    const double length = (cell - eye).norm(), step = std::max(map_.cell(), .01);
    for (double at = step; at < length - camera_.near; at += step) {
      const Vector3d point = cell + at / length * (eye - cell);
      if (map_.state(point) == CellState::occupied) return false;
      for (const KnownShape& shape : shapes) {
        if (!mayBeWithin(*shape.body, shape.X_WB, point, 0.)) continue;
        if (proximity(*pointBody(), {Matrix3d::Identity(), point}, *shape.body, shape.X_WB).distance < 0.) return false;
      }
    }
    return true;
  }

  const OccupancyMap& map_;
  std::vector<Vector3d> cells_;
  Camera camera_;
};

/// Directions that cover the sphere evenly. Source: Gonzalez, Measurement of areas on a sphere using Fibonacci and
/// latitude-longitude lattices, 2010.
Vector3d directionOf(int i) {
  const double z = 1. - (2. * i + 1.) / kDirections, across = std::sqrt(1. - z * z), angle = 2.399963229728653 * i;
  return {across * std::cos(angle), across * std::sin(angle), z};
}

std::vector<Vector3d> thinned(const std::vector<Vector3d>& cells) {
  std::vector<Vector3d> some;
  const std::size_t step = (cells.size() + kMostCells - 1) / kMostCells;
  for (std::size_t i = 0; i < cells.size(); i += step) some.push_back(cells[i]);
  return some;
}

std::vector<Candidate> candidatesAround(const Vector3d& middle, const Visibility& visibility,
                                        const std::vector<KnownShape>& fixed, const NextViewOptions& options) {
  std::vector<Candidate> candidates;
  for (int i = 0; i < kDirections; ++i) {
    for (int j = 0; j < kDistances; ++j) {
      const double distance = options.nearest + (options.farthest - options.nearest) * j / (kDistances - 1);
      Candidate candidate{middle + distance * directionOf(i)};
      candidate.visible = visibility.count(candidate.eye, fixed);
      if (candidate.visible > 0) candidates.push_back(candidate);
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.visible > b.visible; });
  return candidates;
}

}  // namespace

void NextViewOptions::validate() const {
  if (!(nearest > 0.) || !(farthest >= nearest) || !std::isfinite(farthest) || !std::isfinite(margin))
    throw ValueError(cat("nextView: distances from ", nearest, " to ", farthest, " m and margin ", margin,
                         "; expected 0 < nearest <= farthest and a finite margin"));
}

std::string NextView::str() const {
  if (!feasible()) return message;
  return cat("camera at ", pose.p.x(), " ", pose.p.y(), " ", pose.p.z(), " sees ", visible, " of ", cells, " cells");
}

NextView nextView(const Config& config, const OccupancyMap& map, const std::string& camera, const MotionPlan& plan,
                  const NextViewOptions& options) {
  options.validate();
  const Frame frame = config.getFrame(camera);
  if (!plan.blockedByUnseen)
    throw ValueError("nextView: the plan is not blocked by unseen cells; expected one with blockedByUnseen");
  if (!isMoved(frame))
    throw ValueError(cat("nextView: no joint moves camera '", camera, "'; expected a camera on the robot"));
  const std::vector<Vector3d>& asked = plan.blockedByUnseen->cells;
  const Visibility visibility(map, thinned(asked), cameraOf(frame));
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& cell : visibility.cells()) middle += cell / double(visibility.cells().size());
  std::vector<KnownShape> fixed = knownShapes(config, {});
  std::erase_if(fixed, [](const KnownShape& shape) { return shape.moves; });
  NextView best;
  best.cells = int(asked.size());
  best.message = "no configuration holds the camera in front of the unseen cells";
  const double scale = double(asked.size()) / double(std::max<std::size_t>(visibility.cells().size(), 1));
  Config there(config);
  const VectorXd start = config.getJointState();
  int tried = 0, compared = 0;
  for (const Candidate& candidate : candidatesAround(middle, visibility, fixed, options)) {
    if (std::lround(scale * candidate.visible) <= best.visible || tried++ == kMostInverse || compared == kCompared)
      break;
    IkOptions inverse;
    inverse.margin = options.margin;
    inverse.attempts = 20;
    const IkResult found =
        solveIk(config, {IkTarget::toPosition(camera, candidate.eye), IkTarget::toGaze(camera, middle)}, inverse);
    if (!found.feasible()) continue;
    there.setJointState(found.q);
    const Pose pose = there.getFrame(camera).getPose();
    const int visible = int(std::lround(scale * visibility.count(pose.p, knownShapes(there, {}), &pose)));
    if (visible <= best.visible) continue;
    PlanOptions to_there;
    to_there.margin = options.margin;
    MotionPlan motion = planMotion(config, MotionGoal(found.q), to_there, start);
    if (!motion.feasible()) {
      best.message = cat("no motion through seen space leads to a view of the cells: ", motion.message);
      continue;
    }
    ++compared;
    best = {found.q, pose, visible, best.cells, std::move(motion), ""};
  }
  if (best.feasible()) best.message.clear();
  return best;
}

}  // namespace kinegraph
