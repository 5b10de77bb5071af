#include "kinegraph/perception/occupancy_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/cells.h"
#include "kinegraph/perception/free_depth.h"
#include "kinegraph/perception/known_points.h"
#include "kinegraph/scene/collisions.h"

namespace kinegraph {

namespace {

constexpr double kMostCells = 5e7;
constexpr double kRobotClearance = .005;  // m, space around the robot that is taken to be free
constexpr double kHalfDiagonal = .8660254037844386;
constexpr double kDoubtful = .05;  // share of points behind known shapes

/// Calls visit(index, middle) for the cells whose middles may be within a distance (m) of a shape.
template <class Visit>
void forCellsNear(const OccupancyMap& map, const KnownShape& shape, double distance, const Visit& visit) {
  const CollisionBody& body = *shape.body;
  const Vector3d center = shape.X_WB * body.boundCenter();
  const Vector3d half = (shape.X_WB.R.cwiseAbs() * body.boundHalf()).array() + body.radius() + distance;
  std::array<int, 3> from, to;
  for (int axis = 0; axis < 3; ++axis) {
    const double last = map.counts()[std::size_t(axis)], low = (center[axis] - half[axis] - map.lower()[axis]),
                 high = (center[axis] + half[axis] - map.lower()[axis]);
    from[std::size_t(axis)] = int(std::clamp(std::floor(low / map.cell()), 0., last));
    to[std::size_t(axis)] = int(std::clamp(std::ceil(high / map.cell()), 0., last));
  }
  for (int i = from[0]; i < to[0]; ++i) {
    for (int j = from[1]; j < to[1]; ++j) {
      const std::size_t row =
          (std::size_t(i) * std::size_t(map.counts()[1]) + std::size_t(j)) * std::size_t(map.counts()[2]);
      for (int k = from[2]; k < to[2]; ++k)
        visit(row + std::size_t(k), Vector3d(map.lower() + map.cell() * Vector3d(i + .5, j + .5, k + .5)));
    }
  }
}

/// The index of the cell that holds a point (world); none outside of the map.
std::optional<std::size_t> cellAt(const OccupancyMap& map, const Vector3d& point) {
  const Vector3d at = (point - map.lower()) / map.cell();
  const std::array<int, 3>& counts = map.counts();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(at[Eigen::Index(axis)] >= 0. && at[Eigen::Index(axis)] < counts[axis])) return std::nullopt;
  }
  return (std::size_t(at[0]) * std::size_t(counts[1]) + std::size_t(at[1])) * std::size_t(counts[2]) +
         std::size_t(at[2]);
}

/// The numbers of points in each cell that no known shape explains, up to 255.
std::vector<std::uint8_t> countHits(const OccupancyMap& map, const ObservedView& view) {
  std::vector<std::uint8_t> hits(map.states().size(), 0);
  for (int row = 0; row < view.height; ++row) {
    for (int column = 0; column < view.width; ++column) {
      if (view.pixels[view.index(row, column)] != ObservedView::Pixel::other) continue;
      const std::optional<std::size_t> cell = cellAt(map, view.point(row, column));
      if (cell && hits[*cell] < 255) ++hits[*cell];
    }
  }
  return hits;
}

/// The least depth of a corner of the map, m.
double nearestCorner(const OccupancyMap& map, const RigidTransform& X_CW) {
  const auto [x, y, z] = map.counts();
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 8; ++i) {
    const Vector3d corner = map.lower() + map.cell() * Vector3d(i & 1 ? x : 0, i & 2 ? y : 0, i & 4 ? z : 0);
    nearest = std::min(nearest, (X_CW * corner).z());
  }
  return nearest;
}

/// Sets the state of a cell, of which the middle is given in the camera's frame; returns whether it is in the image.
bool addCell(const FreeDepth& depth, const Vector3d& middle, int hits, CellState& state) {
  using Answer = FreeDepth::Answer;
  const Answer answer = depth.ask(middle);
  if (hits > 0 && hits >= depth.neededHits(middle.z())) {
    state = CellState::occupied;
  } else if (answer == Answer::free || (state != CellState::free && depth.isFreeInParts(middle))) {
    state = CellState::free;
  } else if (state == CellState::unseen || state == CellState::undecided) {
    if (answer == Answer::behind) state = CellState::hidden;
    if (answer == Answer::undecided) state = CellState::undecided;
  }
  return answer != Answer::outside;
}

/// Sets the states of the cells in a block; returns whether some are in the image.
bool addBlock(const OccupancyMap& map, const FreeDepth& depth, const RigidTransform& X_CW,
              const std::vector<std::uint8_t>& hits, const std::array<int, 3>& first, std::vector<CellState>& states) {
  const std::array<int, 3>& count = map.counts();
  constexpr int kBlock = FreeDepth::kBlock;
  std::array<int, 3> end;
  for (std::size_t axis = 0; axis < 3; ++axis) end[axis] = std::min(first[axis] + kBlock, count[axis]);
  const Vector3d corner(first[0], first[1], first[2]);
  const bool is_free =
      depth.isFreeBlock(X_CW * Vector3d(map.lower() + map.cell() * (corner.array() + .5 * kBlock).matrix()));
  const Vector3d step = map.cell() * X_CW.R.col(2);
  bool in_view = is_free;
  for (int i = first[0]; i < end[0]; ++i) {
    for (int j = first[1]; j < end[1]; ++j) {
      std::size_t index =
          (std::size_t(i) * std::size_t(count[1]) + std::size_t(j)) * std::size_t(count[2]) + std::size_t(first[2]);
      if (is_free) {
        std::fill_n(states.begin() + std::ptrdiff_t(index), end[2] - first[2], CellState::free);
        continue;
      }
      Vector3d p = X_CW * Vector3d(map.lower() + map.cell() * Vector3d(i + .5, j + .5, first[2] + .5));
      for (int k = first[2]; k < end[2]; ++k, ++index, p += step)
        in_view |= addCell(depth, p, hits[index], states[index]);
    }
  }
  return in_view;
}

}  // namespace

Unseen unseenFromName(const std::string& name) {
  if (name == "blocked") return Unseen::blocked;
  if (name == "shadows") return Unseen::shadows;
  if (name == "free") return Unseen::free;
  throw ValueError(cat("unseen is '", name, "'; expected 'blocked', 'shadows' or 'free'"));
}

OccupancyMap::OccupancyMap(const Config& config, const Vector3d& lower, const Vector3d& upper, double cell,
                           const std::vector<std::string>& free)
    : lower_(lower), cell_(cell) {
  if (!lower.allFinite() || !upper.allFinite() ||
      !(upper - lower).cwiseQuotient(Vector3d::Ones()).array().isFinite().all() || (upper - lower).minCoeff() <= 0.)
    throw ValueError(cat("OccupancyMap: region from (", lower[0], ", ", lower[1], ", ", lower[2], ") to (", upper[0],
                         ", ", upper[1], ", ", upper[2], ") m; expected finite corners, the second one larger"));
  if (!(cell > 0.) || !std::isfinite(cell)) throw ValueError(cat("OccupancyMap: cell is ", cell, " m; expected > 0"));
  const Vector3d counts = ((upper - lower) / cell).array() - 1e-6;
  if (counts.cwiseMax(2.).prod() > kMostCells)
    throw ValueError(cat("OccupancyMap: the region has ", counts.prod(), " cells of ", cell,
                         " m; expected at most 50 million: make the region smaller or the cells larger"));
  for (int axis = 0; axis < 3; ++axis) count_[std::size_t(axis)] = std::max(int(std::ceil(counts[axis])), 2);
  states_.assign(std::size_t(count_[0]) * std::size_t(count_[1]) * std::size_t(count_[2]), CellState::unseen);
  for (const std::string& name : free) {
    const Frame frame = config.getFrame(name);
    if (!frame.data().shape) throw ValueError(cat("OccupancyMap: the free frame '", name, "' has no shape"));
    const KnownShape shape{frame.data().shape->body(), frame.getPose().transform(), frame.id(), false};
    forCellsNear(*this, shape, 0., [&](std::size_t index, const Vector3d& middle) {
      if (isWithin(shape, middle, 0.)) states_[index] = CellState::free;
    });
  }
  clearKnown(knownShapes(config, {}));
}

Vector3d OccupancyMap::middle(std::size_t index) const {
  const std::size_t z = index % std::size_t(count_[2]), rest = index / std::size_t(count_[2]);
  return lower_ + cell_ * Vector3d(double(rest / std::size_t(count_[1])) + .5,
                                   double(rest % std::size_t(count_[1])) + .5, double(z) + .5);
}

/// Cells that a known shape touches are free but for the shape itself. What was measured close to the robot stays.
void OccupancyMap::clearKnown(const std::vector<KnownShape>& known) {
  for (const KnownShape& shape : known) {
    if (shape.body->core() == CollisionBody::Core::half_space) continue;
    const double unseen = kHalfDiagonal * cell_ + (shape.moves ? kRobotClearance : 1e-6), occupied = .5 * cell_;
    forCellsNear(*this, shape, unseen, [&](std::size_t index, const Vector3d& middle) {
      CellState& state = states_[index];
      if (state == CellState::free) return;
      if (isWithin(shape, middle, state == CellState::occupied ? occupied : unseen)) state = CellState::free;
    });
  }
}

std::vector<std::string> OccupancyMap::update(const Config& config, std::span<const DepthView> views,
                                              const SeenScene& known) {
  std::vector<std::string> warnings;
  std::set<int> lost;
  for (const auto& [name, seen] : known.frames) {
    if (seen.status == SeenStatus::seen) continue;
    const int lost_id = config.getFrame(name).id();
    for (const Frame& frame : config.getFrames()) {
      for (std::optional<Frame> at = frame; at; at = at->getParent()) {
        if (at->id() == lost_id) lost.insert(frame.id());
      }
    }
  }
  std::vector<Pose> cameras;
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i].validate(cat("OccupancyMap.update: view ", i));
    cameras.push_back(views[i].cameraPose(config));
  }
  const std::vector<KnownShape> shapes = knownShapes(config, lost);
  for (std::size_t i = 0; i < views.size(); ++i) addView(views[i], cameras[i], shapes, warnings, cat("view ", i));
  clearKnown(shapes);
  return warnings;
}

void OccupancyMap::addView(const DepthView& given, const Pose& camera, const std::vector<KnownShape>& known,
                           std::vector<std::string>& warnings, const std::string& name) {
  const ObservedView view = compareWithKnown(nearestOfFour(given, cell_), camera, known, nullptr);
  if (std::none_of(view.depth.begin(), view.depth.end(), [](float d) { return d > 0.f; })) {
    warnings.push_back(cat(name, " has no depth"));
    return;
  }
  if (const double share = shareBehind(view, known); share > kDoubtful)
    warnings.push_back(cat(name, " looks through known shapes at ", int(std::lround(100. * share)),
                           " % of its points; check the camera's pose (z forward, x to the right, y down), and the "
                           "poses of these shapes"));
  const std::vector<std::uint8_t> hits = countHits(*this, view);
  const RigidTransform X_CW = view.X_WC.inverse();
  const FreeDepth depth(view, cell_, nearestCorner(*this, X_CW));
  constexpr int kBlock = FreeDepth::kBlock;
  bool in_view = false;
  for (int i = 0; i < count_[0]; i += kBlock) {
    for (int j = 0; j < count_[1]; j += kBlock) {
      for (int k = 0; k < count_[2]; k += kBlock) in_view |= addBlock(*this, depth, X_CW, hits, {i, j, k}, states_);
    }
  }
  if (!in_view) warnings.push_back(cat(name, " shows nothing of the region"));
}

/// The cells that can hold something: those from which cells that may hold something lead to a measured one, to a
/// shape on which things rest, or to an unseen one that blocks.
std::vector<bool> OccupancyMap::grounded(const Config& config, Unseen unseen) const {
  const bool unseen_blocks = unseen == Unseen::blocked;
  const auto mayHold = [&](std::size_t i) {
    return states_[i] != CellState::free && (unseen_blocks || states_[i] != CellState::unseen);
  };
  std::vector<bool> reached(states_.size(), false);
  std::vector<std::size_t> open;
  const auto reach = [&](std::size_t i) {
    if (reached[i] || !mayHold(i)) return;
    reached[i] = true;
    open.push_back(i);
  };
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (states_[i] == CellState::occupied || (unseen_blocks && states_[i] == CellState::unseen)) reach(i);
  }
  const double beside = (kHalfDiagonal + 1.) * cell_ + 1e-6;  // the next cell touches the shape
  for (const KnownShape& shape : knownShapes(config, {})) {
    if (!shape.supports) continue;
    forCellsNear(*this, shape, beside, [&](std::size_t index, const Vector3d& middle) {
      if (!reached[index] && mayHold(index) && isWithin(shape, middle, beside)) reach(index);
    });
  }
  const std::array<std::size_t, 3> count = {std::size_t(count_[0]), std::size_t(count_[1]), std::size_t(count_[2])};
  const std::array<std::size_t, 3> step = {count[1] * count[2], count[2], 1};
  while (!open.empty()) {  // through faces: a solid thing does not hang together by edges or corners alone
    const std::size_t index = open.back();
    open.pop_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t at = index / step[axis] % count[axis];
      if (at > 0) reach(index - step[axis]);
      if (at + 1 < count[axis]) reach(index + step[axis]);
    }
  }
  return reached;
}

void OccupancyMap::attach(Config& config, Unseen unseen, const std::string& name) const {
  Grid grid;
  grid.cells = count_;
  grid.values.resize(states_.size());
  const float of_unseen = unseen == Unseen::blocked ? CellKind::unseen : CellKind::free,
              of_hidden = unseen == Unseen::free ? CellKind::free : CellKind::unseen;
  const std::array<float, 5> values = {of_unseen, of_hidden, CellKind::free, CellKind::occupied, of_unseen};
  for (std::size_t i = 0; i < states_.size(); ++i) grid.values[i] = values[std::size_t(states_[i])];
  if (unseen != Unseen::free) {
    const std::vector<bool> holds = grounded(config, unseen);
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (!holds[i]) grid.values[i] = CellKind::free;
    }
  }
  const Vector3d size = cell_ * Vector3d(count_[0], count_[1], count_[2]);
  const bool exists = config.findFrame(name).has_value();
  Frame frame = exists ? config.getFrame(name) : config.addFrame(name);
  if (exists && frame.data().shape && frame.getShapeType() != kCells)
    throw ValueError(cat("OccupancyMap.attach: frame '", name, "' exists and has another shape; give another name"));
  setCells(frame, std::move(grid), size);
  if (!exists) {
    frame.setPosition(lower_ + .5 * size);
    frame.setContact(1);
  }
}

CellState OccupancyMap::state(const Vector3d& point) const {
  const std::optional<std::size_t> cell = cellAt(*this, point);
  return cell ? states_[*cell] : CellState::free;
}

void OccupancyMap::setStates(std::vector<CellState> states) {
  if (states.size() != states_.size())
    throw ValueError(cat("OccupancyMap: ", states.size(), " states; expected ", states_.size()));
  const auto unknown = std::ranges::find_if(states, [](CellState state) { return state > CellState::undecided; });
  if (unknown != states.end())
    throw ValueError(cat("OccupancyMap: a state is ", int(*unknown), "; expected 0 to ", int(CellState::undecided)));
  states_ = std::move(states);
}

std::string OccupancyMap::str() const {
  std::array<std::size_t, 5> counts{};
  for (const CellState state : states_) ++counts[std::size_t(state)];
  return cat("OccupancyMap of ", count_[0], " x ", count_[1], " x ", count_[2], " cells of ", cell_, " m: ", counts[2],
             " free, ", counts[3], " occupied, ", counts[1], " hidden, ", counts[4], " undecided, ", counts[0],
             " unseen");
}

}  // namespace kinegraph
