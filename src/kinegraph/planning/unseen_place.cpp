#include "kinegraph/planning/unseen_place.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/cell_field.h"
#include "kinegraph/geometry/distance/grid_field.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/geometry/shapes/cells.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/collisions.h"

namespace kinegraph {

namespace {

constexpr int kUnseenSamples = 100;  // of the motion

bool hasUnseen(const Frame& frame) {
  if (frame.getShapeType() != kCells || frame.data().shape->contact == 0) return false;
  const auto& grid = frame.data().shape->geometry->grid;
  return grid && std::find(grid->values.begin(), grid->values.end(), CellKind::unseen) != grid->values.end();
}

void freeUnseen(Frame frame) {
  const Geometry geometry = *frame.data().shape->geometry;
  Grid grid = *geometry.grid;
  std::replace(grid.values.begin(), grid.values.end(), CellKind::unseen, CellKind::free);
  setCells(frame, std::move(grid), {geometry.size[0], geometry.size[1], geometry.size[2]});
}

/// The cells of a map: the unseen ones that a motion entered, and how deep any point is in them.
class UnseenCells {
 public:
  explicit UnseenCells(const Frame& frame)
      : id_(frame.id()),
        grid_(frame.data().shape->geometry->grid),
        entered_(grid_->values.size(), false),
        seen_(makeCollisionBody(inverse(*frame.data().shape->geometry))) {}

  int id() const { return id_; }
  const CellField& seen() const { return *seen_->grid().cells; }
  bool isNew(const std::array<int, 3>& at) const {
    const std::size_t index = seen().index(at);
    return grid_->values[index] == CellKind::unseen && !entered_[index];
  }
  void enter(const std::array<int, 3>& at) { entered_[seen().index(at)] = true; }
  Vector3d middle(const std::array<int, 3>& at) const {
    return seen().cell * Vector3d(at[0] + .5, at[1] + .5, at[2] + .5) - seen().half;
  }

  /// How far the middle of a cell is from the nearest seen place, to within a cell, m.
  double depth(const Vector3d& point) const {
    const double to_side = (seen().half - point.cwiseAbs()).minCoeff();
    return to_side <= 0. ? 0. : std::min(to_side, seen().leastDistance(point) + .5 * seen().cell);
  }

 private:
  static Geometry inverse(Geometry geometry) {
    Grid grid = *geometry.grid;
    for (float& value : grid.values) value = value == CellKind::unseen ? CellKind::free : CellKind::occupied;
    geometry.grid = std::make_shared<const Grid>(std::move(grid));
    return geometry;
  }

  int id_;
  std::shared_ptr<const Grid> grid_;
  std::vector<bool> entered_;
  std::shared_ptr<const CollisionBody> seen_;  ///< all cells but the unseen ones
};

/// Collects the unseen cells that a motion enters.
class EnteredCells {
 public:
  EnteredCells(const Config& config, const std::vector<Frame>& maps, double margin)
      : state_(config.state()), margin_(margin) {
    for (const Frame& map : maps) {
      maps_.emplace_back(map);
      for (const auto& [a, b] : state_.model().movingPairs()) {
        if (a == map.id() || b == map.id()) pairs_.emplace_back(a == map.id() ? b : a, maps_.size() - 1);
      }
    }
    for (const Frame& frame : config.getFrames()) names_[frame.id()] = frame.getName();
  }

  void visit(const VectorXd& q) {
    state_.setJoints(q.data());
    for (const auto& [frame, map] : pairs_) visit(q, frame, maps_[map]);
  }

  std::optional<UnseenPlace> take() { return std::move(place_); }

 private:
  void visit(const VectorXd& q, int frame, UnseenCells& map) {
    const CollisionBody& body = *state_.model().body[std::size_t(frame)];
    const CellField& field = map.seen();
    const RigidTransform X_WM = state_.pose(map.id()), X_MB = X_WM.inverse() * state_.pose(frame);
    const Vector3d center = X_MB * body.boundCenter();
    const Vector3d half = (X_MB.R.cwiseAbs() * body.boundHalf()).array() + body.radius() + margin_;
    const std::array<int, 3> from = field.cellAt(center - half), to = field.cellAt(center + half);
    const double reach = margin_ + .5 * std::sqrt(3.) * field.cell;
    double depth = 0.;
    for (int i = from[0]; i <= to[0]; ++i) {
      for (int j = from[1]; j <= to[1]; ++j) {
        for (int k = from[2]; k <= to[2]; ++k) {
          if (!map.isNew({i, j, k})) continue;
          const Vector3d middle = map.middle({i, j, k});
          if (!mayBeWithin(body, X_MB, middle, reach)) continue;
          if (proximity(*field.cube, {Matrix3d::Identity(), middle}, body, X_MB).distance >= margin_) continue;
          map.enter({i, j, k});
          const Vector3d point = X_WM * middle;
          if (!place_) place_ = UnseenPlace{point, names_[frame], q};
          place_->cells.push_back(point);
          depth = std::max(depth, map.depth(middle));
        }
      }
    }
    if (place_) place_->depth = std::max(place_->depth, depth);
  }

  State state_;
  double margin_;
  std::vector<UnseenCells> maps_;
  std::vector<std::pair<int, std::size_t>> pairs_;  ///< a frame that moves, and a map
  std::map<int, std::string> names_;                ///< of all frames
  std::optional<UnseenPlace> place_;
};

/// A point of a path without times; all of its edges count the same.
VectorXd alongPath(const MatrixXd& path, double share) {
  const double at = share * double(path.rows() - 1);
  const Eigen::Index first = std::clamp<Eigen::Index>(Eigen::Index(at), 0, std::max<Eigen::Index>(path.rows() - 2, 0));
  const Eigen::Index last = std::min(first + 1, path.rows() - 1);
  return path.row(first) + (at - double(first)) * (path.row(last) - path.row(first));
}

}  // namespace

std::string UnseenPlace::str() const {
  return cat("'", frame, "' would enter unseen space at ", position[0], " ", position[1], " ", position[2], " by ",
             depth, " m (", cells.size(), " cells)");
}

std::optional<UnseenPlace> planning_internal::findUnseenPlace(const Config& config, double margin,
                                                              const std::function<MotionPlan(const Config&)>& plan_in) {
  std::vector<Frame> maps;
  for (const Frame& frame : config.getFrames()) {
    if (hasUnseen(frame)) maps.push_back(frame);
  }
  if (maps.empty()) return std::nullopt;
  Config seen(config);
  for (const Frame& map : maps) freeUnseen(seen.getFrame(map.getName()));
  const MotionPlan plan = plan_in(seen);
  if (!plan.feasible()) return std::nullopt;
  EnteredCells entered(config, maps, margin);
  for (int i = 0; i <= kUnseenSamples; ++i) {
    const double share = double(i) / kUnseenSamples;
    entered.visit(plan.options.timing ? plan.eval(share * plan.duration()).q : alongPath(plan.path, share));
  }
  return entered.take();
}

}  // namespace kinegraph
