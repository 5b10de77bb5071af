#include "ik_targets.h"

#include <nanobind/stl/string.h>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph::python {

namespace {

using Kind = IkTarget::Kind;

std::string typeName(nb::handle value) { return nb::cast<std::string>(nb::str(value.type().attr("__name__"))); }

/// Numbers of one target: one row, or one per problem.
struct Rows {
  std::string where;  ///< "targets['gripper']"
  Numbers numbers;
  std::size_t width = 0;
  std::size_t count = 0;  ///< 0: one row for all problems

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

/// Throws unless the rows have one of `widths` numbers; 16 stands for 4 x 4.
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

/// A target before its rows are dealt out to the problems.
struct Wish {
  IkTarget target;
  Rows rows;  ///< of width 0 where `target` is complete

  IkTarget of(std::size_t problem) const {
    IkTarget result = target;
    if (rows.width == 0) return result;
    if (target.kind == Kind::direction) {
      result.direction = rows.row(problem);
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
    for (const auto& [frame, value] : nb::borrow<nb::dict>(targets)) {
      frame_ = nb::isinstance<Frame>(frame) ? nb::cast<Frame>(frame).getName() : frameName(frame);
      where_ = cat("targets['", frame_, "']");
      read(value);
    }
  }

  IkRequest request() const {
    IkRequest request;
    std::size_t count = 1;
    const Wish* leader = nullptr;
    for (const Wish& wish : wishes_) {
      if (wish.rows.count == 0) continue;
      if (leader && wish.rows.count != count) {
        throw ValueError(cat("solveIk: ", wish.rows.where, " has ", wish.rows.count, " rows, but ", leader->rows.where,
                             " has ", count));
      }
      leader = &wish;
      count = wish.rows.count;
    }
    request.is_batch = leader != nullptr;
    request.problems.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      for (const Wish& wish : wishes_) request.problems[i].push_back(wish.of(i));
    }
    return request;
  }

 private:
  std::string frameName(nb::handle key) const {
    if (!nb::isinstance<nb::str>(key))
      throw ValueError(cat("solveIk: a key of targets is of type ", typeName(key), "; expected the name of a frame"));
    return config_.getFrame(nb::cast<std::string>(key)).getName();
  }

  void read(nb::handle value) {
    if (nb::isinstance<nb::dict>(value)) {
      for (const auto& [key, part] : nb::borrow<nb::dict>(value)) readPart(nb::cast<std::string>(nb::str(key)), part);
    } else if (const std::optional<Pose> pose = poseOfFrame(value)) {
      add({IkTarget::toPose(frame_, *pose), {}});
    } else {
      readNumbersTarget(where_, value);
    }
  }

  void readNumbersTarget(const std::string& where, nb::handle value) {
    const Rows rows =
        readRows(where, value, {3, 7, 16},
                 "(3,) = x y z, (7,) = x y z qw qx qy qz, (4, 4), or (N, ...) of them, or a frame's name");
    add({targetOf(rows.width == 3 ? Kind::position : Kind::pose), rows});
  }

  void readPart(const std::string& key, nb::handle value) {
    const std::string where = cat(where_, "['", key, "']");
    const std::optional<Pose> pose = poseOfFrame(value);
    if (key == "pose") {
      if (pose) return add({IkTarget::toPose(frame_, *pose), {}});
      add({targetOf(Kind::pose), readRows(where, value, {7, 16},
                                          "(7,) = x y z qw qx qy qz, (4, 4), or (N, ...) of them, or a frame's name")});
    } else if (key == "position") {
      if (pose) return add({IkTarget::toPosition(frame_, pose->p), {}});
      add({targetOf(Kind::position), readRows(where, value, {3}, "(3,) = x y z, or (N, 3), or a frame's name")});
    } else if (key == "quaternion") {
      if (pose) return add({IkTarget::toRotation(frame_, pose->q), {}});
      add({targetOf(Kind::rotation), readRows(where, value, {4}, "(4,) = qw qx qy qz, or (N, 4), or a frame's name")});
    } else if (key == "x" || key == "y" || key == "z") {
      const Vector3d axis = Vector3d::Unit(key[0] - 'x');
      if (pose) return add({IkTarget::toDirection(frame_, axis, pose->q * axis), {}});
      add({IkTarget::toDirection(frame_, axis, axis),
           readRows(where, value, {3}, "a direction (3,), or (N, 3), or a frame's name")});
    } else {
      const std::vector<std::string> known = {"position", "pose", "quaternion", "x", "y", "z"};
      throw ValueError(
          cat("solveIk: ", where_, " has the key '", key, "'; expected ", join(known), similarHint(key, known)));
    }
  }

  std::optional<Pose> poseOfFrame(nb::handle value) const {
    if (nb::isinstance<nb::str>(value)) return config_.getFrame(nb::cast<std::string>(value)).getPose();
    if (nb::isinstance<Frame>(value)) return nb::cast<Frame>(value).getPose();
    return std::nullopt;
  }

  IkTarget targetOf(Kind kind) const {
    IkTarget target;
    target.frame = frame_;
    target.kind = kind;
    return target;
  }

  void add(Wish wish) { wishes_.push_back(std::move(wish)); }

  const Config& config_;
  std::vector<Wish> wishes_;
  std::string frame_, where_;
};

}  // namespace

IkRequest readIkTargets(const Config& config, nb::handle targets) { return TargetReader(config, targets).request(); }

}  // namespace kinegraph::python
