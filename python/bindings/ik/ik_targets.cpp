#include "ik/ik_targets.h"

#include <nanobind/stl/string.h>

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/features/make_residual.h"
#include "scene/pose_warnings.h"

namespace kinegraph::python {

namespace {

using Kind = IkTarget::Kind;

constexpr char kCenterOfMass[] = "centerOfMass";  // the only feature with a text as key

std::string typeName(nb::handle value) { return nb::cast<std::string>(nb::str(value.type().attr("__name__"))); }

/// Numbers of one target: one row for all problems, or one row per problem.
struct Rows {
  std::string where;  ///< "targets['gripper']"
  Numbers numbers;
  std::size_t width = 0;
  std::size_t count = 0;  ///< number of rows, 0 if one row serves all problems

  Eigen::Map<const VectorXd> row(std::size_t problem) const {
    return {numbers.values.data() + (count ? problem * width : 0), Eigen::Index(width)};
  }
};

std::string shapeText(const Numbers& numbers) {
  if (numbers.rank == 0) return "is a single number";
  if (numbers.rank == 1) return cat("has shape (", numbers.values.size(), ",)");
  if (numbers.rank == 2) return cat("has shape (", numbers.rows, ", ", numbers.columns(), ")");
  return cat("has ", numbers.rank, " dimensions");
}

/// Reads rows with one of `widths` numbers, or throws; 16 means 4 x 4.
Rows readRows(const std::string& where, nb::handle value, std::initializer_list<std::size_t> widths,
              const char* expected) {
  Rows rows{where, {}, 0, 0};
  if (!readNumbers(value, rows.numbers))
    throw ValueError(cat("solveIk: ", where, " is of type ", typeName(value), "; expected ", expected));
  const Numbers& numbers = rows.numbers;
  const std::size_t size = std::size_t(numbers.values.size());
  for (const std::size_t width : widths) {
    const bool matrix = width == 16;
    if (numbers.rank == (matrix ? 2 : 1) && size == width && (!matrix || numbers.rows == 4)) {
      rows.width = width;
    } else if (numbers.rank == (matrix ? 3 : 2) && numbers.rows > 0 && size == numbers.rows * width) {
      rows.width = width;
      rows.count = numbers.rows;
    } else {
      continue;
    }
    if (!numbers.values.allFinite()) throw ValueError(cat("solveIk: ", where, " has numbers that are not finite"));
    return rows;
  }
  throw ValueError(cat("solveIk: ", where, " ", shapeText(numbers), "; expected ", expected));
}

Pose poseFrom(const Rows& rows, std::size_t problem) {
  const auto row = rows.row(problem);
  if (rows.width != 16) return Pose::fromNumbers(row);
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> T(row.data());
  const Matrix3d R = T.topLeftCorner<3, 3>();
  if (!(R * R.transpose()).isIdentity(1e-6) || R.determinant() < 0. ||
      !T.row(3).isApprox(Eigen::RowVector4d(0., 0., 0., 1.))) {
    throw ValueError(
        cat("solveIk: ", rows.where, " is not a pose: expected a rotation matrix, a position, and the row 0 0 0 1"));
  }
  return Pose(T.topRightCorner<3, 1>(), Quaterniond(R).normalized());
}

/// A target together with its rows, which are distributed to the problems later.
struct TargetRows {
  IkTarget target;
  Rows rows;  ///< width 0 if `target` is complete

  IkTarget of(std::size_t problem) const {
    IkTarget result = target;
    if (rows.width == 0) return result;
    if (target.kind == Kind::direction) {
      result.direction = rows.row(problem);
    } else if (target.kind == Kind::feature) {
      result.value = rows.row(problem);
    } else {
      result.pose = poseFrom(rows, problem);
    }
    return result;
  }
};

class TargetReader {
 public:
  TargetReader(const Config& config, nb::handle targets) : config_(config) {
    if (!nb::isinstance<nb::dict>(targets)) {
      throw ValueError(cat("solveIk: targets is of type ", typeName(targets),
                           "; expected a dict from frame names to positions, poses or directions"));
    }
    for (const auto& [key, value] : nb::borrow<nb::dict>(targets)) readTarget(key, value);
  }

  IkProblems problems() const {
    IkProblems all;
    std::size_t count = 1;
    const TargetRows* leader = nullptr;
    for (const TargetRows& entry : targets_) {
      if (entry.rows.count == 0) continue;
      if (leader && entry.rows.count != count) {
        throw ValueError(cat("solveIk: ", entry.rows.where, " has ", entry.rows.count, " rows, but ",
                             leader->rows.where, " has ", count));
      }
      leader = &entry;
      count = entry.rows.count;
    }
    all.is_batch = leader != nullptr;
    all.problems.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      for (const TargetRows& entry : targets_) all.problems[i].push_back(entry.of(i));
    }
    return all;
  }

 private:
  void readTarget(nb::handle key, nb::handle value) {
    relative_to_.reset();
    const bool listed = nb::isinstance<nb::tuple>(key) && nb::len(key) > 0;
    const nb::object first = listed ? nb::object(key[0]) : nb::borrow(key);
    if (nb::isinstance<FeatureSymbol>(first)) return readFeature(nb::cast<FeatureSymbol>(first), key, listed, value);
    if (nb::isinstance<nb::str>(first) && nb::cast<std::string>(first) == kCenterOfMass)
      return readFeature(IkTarget::centerOfMass(), key, listed, value);
    frame_ = nameOf(key, "a key of targets");
    where_ = cat("targets['", frame_, "']");
    read(value);
  }

  std::string nameOf(nb::handle key, const std::string& what) const {
    if (nb::isinstance<Frame>(key)) return nb::cast<Frame>(key).getName();
    if (!nb::isinstance<nb::str>(key))
      throw ValueError(cat("solveIk: ", what, " is of type ", typeName(key),
                           "; expected the name of a frame, or FS. .. and names of frames in a tuple"));
    return config_.getFrame(nb::cast<std::string>(key)).getName();
  }

  /// Reads {(FS.distance, "a", "b"): -.1}; the number may be a dict of target or atMost, tolerance and scale.
  void readFeature(const FeatureSource& source, nb::handle key, bool listed, nb::handle value) {
    IkFeature feature{source, {}};
    where_ = cat("targets[", source.symbol() ? "FS." : "", source.name(), "]");
    for (std::size_t i = 1; listed && i < nb::len(key); ++i)
      feature.frames.push_back(nameOf(key[i], cat("a frame of ", where_)));
    nb::object goal = nb::borrow(value);
    if (nb::isinstance<nb::dict>(value)) goal = readBounds(nb::borrow<nb::dict>(value), feature);
    IkTarget target = IkTarget::toFeature(feature);
    if (!goal.is_valid()) return add({target, {}});
    const Residual residual = makeResidual(config_.state(), feature.source, feature.frames);
    Rows rows = readValues(goal, std::size_t(residual.feature().rows()));
    if (rows.count == 0) target.value = rows.row(0);
    add({target, rows});
  }

  /// Returns the target in the dict of a feature; invalid if there is none.
  nb::object readBounds(nb::dict parts, IkFeature& feature) const {
    const std::vector<std::string> known = {"target", "atMost", "tolerance", "scale"};
    nb::object goal;
    for (const auto& [part, value] : parts) {
      const std::string name = nb::cast<std::string>(nb::str(part)), where = cat(where_, "['", name, "']");
      if (std::ranges::find(known, name) == known.end())
        throw ValueError(
            cat("solveIk: ", where_, " has the key '", name, "'; expected ", join(known), similarHint(name, known)));
      if (name == "target" || name == "atMost") {
        if (goal.is_valid()) throw ValueError(cat("solveIk: ", where_, " has target and atMost; expected one of them"));
        goal = nb::borrow(value);
        feature.at_most = name == "atMost";
        continue;
      }
      Numbers numbers;
      if (!readNumbers(value, numbers) || (name == "tolerance" && numbers.values.size() != 1))
        throw ValueError(cat("solveIk: ", where, " is of type ", typeName(value), "; expected ",
                             name == "scale" ? "numbers" : "a positive number"));
      if (name == "scale") {
        feature.scale = numbers.rank < 2 ? MatrixXd(numbers.values) : numbers.matrix();
      } else {
        feature.tolerance = numbers.values[0];
      }
    }
    return goal;
  }

  /// Reads one number for all `width` components of a feature, or one for each, or (N, width) for N problems.
  Rows readValues(nb::handle value, std::size_t width) const {
    Numbers numbers;
    const bool read = readNumbers(value, numbers);
    const std::size_t size = std::size_t(numbers.values.size());
    const bool one = numbers.rank < 2 && (size == 1 || size == width);
    const bool many = numbers.rank == 2 && numbers.rows > 0 && numbers.columns() == width;
    if (!read || !(one || many))
      throw ValueError(cat("solveIk: ", where_, " ", read ? shapeText(numbers) : cat("is of type ", typeName(value)),
                           "; expected ", width == 1 ? "" : cat("(", width, ",) or "), "a number, or (N, ", width,
                           ")"));
    if (!numbers.values.allFinite()) throw ValueError(cat("solveIk: ", where_, " has numbers that are not finite"));
    const std::size_t count = many ? numbers.rows : 0;
    return {where_, std::move(numbers), one ? size : width, count};
  }

  void read(nb::handle value) {
    if (nb::isinstance<nb::dict>(value)) return readParts(nb::borrow<nb::dict>(value));
    if (const std::optional<Frame> there = frameOf(value)) return add({partOf(Kind::pose, *there), {}});
    readNumbersTarget(where_, value);
  }

  /// Reads a dict of position, directions, ...; `relativeTo` and `axis` modify the other parts.
  void readParts(nb::dict parts) {
    if (parts.contains("relativeTo"))
      relative_to_ = config_.getFrame(nameOf(parts["relativeTo"], cat(where_, "['relativeTo']")));
    Vector3d axis = Vector3d::UnitZ();
    if (parts.contains("axis")) axis = readRows(cat(where_, "['axis']"), parts["axis"], {3}, "(3,) = x y z").row(0);
    if (parts.contains("axis") && !parts.contains("gaze"))
      throw ValueError(cat("solveIk: ", where_, " has the key 'axis' without 'gaze', which it is for"));
    std::size_t read = 0;
    for (const auto& [part, value] : parts) {
      const std::string key = nb::cast<std::string>(nb::str(part));
      if (key == "relativeTo" || key == "axis") continue;
      readPart(key, value, axis);
      ++read;
    }
    if (read > 0) return;
    if (!relative_to_) throw ValueError(cat("solveIk: ", where_, " is an empty dict; expected ", join(partNames())));
    add({IkTarget::toPose(frame_, Pose()).relativeTo(relative_to_->getName()), {}});
  }

  void readNumbersTarget(const std::string& where, nb::handle value) {
    const Rows rows =
        readRows(where, value, {3, 7, 16},
                 "(3,) = x y z, (7,) = x y z qw qx qy qz, (4, 4), or (N, ...) of them, or a frame's name");
    add({targetOf(rows.width == 3 ? Kind::position : Kind::pose), rows});
  }

  static const std::vector<std::string>& partNames() {
    static const std::vector<std::string> names = {"position", "pose", "quaternion", "x",   "y",
                                                   "z",        "gaze", "relativeTo", "axis"};
    return names;
  }

  void readPart(const std::string& key, nb::handle value, const Vector3d& axis) {
    const std::string where = cat(where_, "['", key, "']");
    const std::optional<Frame> there = frameOf(value);
    if (key == "pose") {
      if (there) return add({partOf(Kind::pose, *there), {}});
      add({targetOf(Kind::pose), readRows(where, value, {7, 16},
                                          "(7,) = x y z qw qx qy qz, (4, 4), or (N, ...) of them, or a frame's name")});
    } else if (key == "position") {
      if (there) return add({partOf(Kind::position, *there), {}});
      add({targetOf(Kind::position), readRows(where, value, {3}, "(3,) = x y z, or (N, 3), or a frame's name")});
    } else if (key == "quaternion") {
      if (there) return add({partOf(Kind::rotation, *there), {}});
      add({targetOf(Kind::rotation), readRows(where, value, {4}, "(4,) = qw qx qy qz, or (N, 4), or a frame's name")});
    } else if (key == "x" || key == "y" || key == "z") {
      IkTarget target = there ? partOf(Kind::direction, *there) : targetOf(Kind::direction);
      target.axis = Vector3d::Unit(key[0] - 'x');
      target.direction = target.pose.q * target.axis;
      if (there) return add({target, {}});
      add({target, readRows(where, value, {3}, "a direction (3,), or (N, 3), or a frame's name")});
    } else if (key == "gaze") {
      if (there) return add({IkTarget::toGaze(frame_, *there, axis), {}});
      IkTarget target = targetOf(Kind::gaze);
      target.axis = axis;
      add({target, readRows(where, value, {3}, "a point (3,), or (N, 3), or a frame's name")});
    } else {
      throw ValueError(cat("solveIk: ", where_, " has the key '", key, "'; expected ", join(partNames()),
                           similarHint(key, partNames())));
    }
  }

  std::optional<Frame> frameOf(nb::handle value) const {
    if (nb::isinstance<nb::str>(value)) return config_.getFrame(nb::cast<std::string>(value));
    if (nb::isinstance<Frame>(value)) return nb::cast<Frame>(value);
    return std::nullopt;
  }

  /// Returns the present pose of a frame, or a part of it, as a target.
  IkTarget partOf(Kind kind, const Frame& there) const {
    IkTarget target = targetOf(kind);
    target.pose = relative_to_ ? there.getPose(*relative_to_) : there.getPose();
    target.taken_from = there.getName();
    return target;
  }

  IkTarget targetOf(Kind kind) const {
    IkTarget target;
    target.frame = frame_;
    target.kind = kind;
    if (relative_to_) target.relative_to = relative_to_->getName();
    return target;
  }

  void add(TargetRows entry) {
    if (entry.rows.count == 0 &&
        (entry.rows.width == 7 || (entry.rows.width == 4 && entry.target.kind == Kind::rotation)))
      warnOfOrder(entry.rows.row(0));
    targets_.push_back(std::move(entry));
  }

  const Config& config_;
  std::vector<TargetRows> targets_;
  std::string frame_, where_;
  std::optional<Frame> relative_to_;  ///< for the present target
};

}  // namespace

IkProblems readIkTargets(const Config& config, nb::handle targets) { return TargetReader(config, targets).problems(); }

}  // namespace kinegraph::python
