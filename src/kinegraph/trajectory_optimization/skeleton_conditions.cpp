#include <algorithm>
#include <array>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/recipe.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/komo/force_exchange.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/trajectory_optimization/motion_problems.h"

namespace kinegraph {

namespace {

using enum ObjectiveType;
using F = FeatureSymbol;
using M = SwitchMode;
using Names = std::vector<std::string>;

/// Returns a row that selects one of three components.
MatrixXd componentOf(int axis, double scale) {
  MatrixXd row = MatrixXd::Zero(1, 3);
  row(0, axis) = scale;
  return row;
}

/// Returns the product of the x, y or z axis of one frame with that of another.
F product(int a, int b) {
  constexpr std::array<F, 9> symbols = {F::scalarProductXX, F::scalarProductXY, F::scalarProductXZ,
                                        F::scalarProductYX, F::scalarProductYY, F::scalarProductYZ,
                                        F::scalarProductZX, F::scalarProductZY, F::scalarProductZZ};
  return symbols[std::size_t(3 * a + b)];
}

using Body = ShapeKind::Body;

const ShapeKind& kindOf(const Frame& frame) { return shapeKind(frame.getShapeType()); }

class ConditionAdder {
 public:
  ConditionAdder(Komo& komo, const Skeleton::Entry& entry)
      : komo_(komo),
        symbol_(entry.symbol),
        f_(entry.frames),
        from_(entry.from),
        to_(entry.to),
        scene_(komo.configuration(-komo.order())) {}

  void add() {
    const std::vector<double> at = {from_}, during = {from_, to_};
    switch (symbol_) {
      case M::touch:
        return require(during, F::distance, f_, eq, 1e2);
      case M::above:
        return require(during, F::aboveBox, f_, ineq, 1e1);
      case M::inside:
        return require(during, F::insideBox, f_, ineq, 1e1);
      case M::oppose:
        return require(during, F::oppose, f_, eq, 1e1);
      case M::restingOn:
        return restingOn(during);
      case M::poseEq:
        return require(during, F::poseDiff, f_, eq, 1e2);
      case M::positionEq:
        return require(during, F::positionDiff, f_, eq, 1e2);
      case M::stableRelPose:
        return require({from_, to_ < 0. ? -1. : to_ + 1.}, F::poseRel, f_, eq, 1e2, {}, 1);
      case M::stablePose:
        for (const std::string& frame : f_)
          require({from_, to_ < 0. ? -1. : to_ + 1.}, F::pose, {frame}, eq, 1e2, {}, 1);
        return;
      case M::downUp:
        return downUp();
      case M::lift:
        for (const std::string& frame : f_) lift(frame);
        return;
      case M::relPosY:
        return require(during, F::positionRel, f_, eq, componentOf(1, 1e2));
      case M::contact:
        return void(exchange(ForceExchange::slide));
      case M::contactStick:
        return void(exchange(ForceExchange::stick));
      case M::contactComplementary:
        return void(exchange(ForceExchange::complementary));
      case M::bounce:
        return void(exchange(ForceExchange::bounce));
      case M::push:
        return push(during);
      case M::topBoxGrasp:
        require(at, F::positionDiff, f_, eq, 1e2);
        require(at, F::scalarProductXY, f_, eq, 1e2);
        return fromAbove(at);
      case M::topBoxPlace:
        return topBoxPlace(at);
      case M::touchBoxNormalX:
      case M::touchBoxNormalY:
      case M::touchBoxNormalZ:
        return touchFace(int(symbol_) - int(M::touchBoxNormalX), at, during);
      case M::boxGraspX:
      case M::boxGraspY:
      case M::boxGraspZ:
        return boxGrasp(int(symbol_) - int(M::boxGraspX), at);
      case M::dampMotion:
        for (const std::string& frame : f_) {
          for (int order = 1; order <= std::min(komo_.order(), 2); ++order)
            require(during, F::linangVel, {frame}, sos, 1e-2, {}, order);
        }
        return;
      case M::alignByInt:
        return require(during, F::scalarProductXX, f_, sos, 1.);
      case M::forceBalance:
        for (const std::string& frame : f_) require(during, F::totalForce, {frame}, eq, 1e2);
        return;
      case M::makeFree:  // applied to the scene before the problem is made
      case M::end:
        return;
      default:
        throw ValueError(cat("Skeleton: ", switchModeName(symbol_), " is not available"));
    }
  }

 private:
  /// Omits constraints on derivatives above the order of the problem, as in waypoints.
  void require(const std::vector<double>& times, F feature, const Names& frames, ObjectiveType type, const Scale& scale,
               const Target& target = {}, int order = -1) {
    if (order <= komo_.order()) komo_.addObjective(times, feature, frames, type, scale, target, order);
  }

  /// Adds an objective in the part of the time interval that is inside of the path, if it contains a slice.
  void requireNear(double from, double to, F feature, const Names& frames, ObjectiveType type, const Scale& scale,
                   const Target& target = {}, int order = -1) {
    const auto [first, last] = komo_.path().grid().select({std::max(from, 0.), to});
    if (first <= last) require({std::max(from, 0.), to}, feature, frames, type, scale, target, order);
  }

  const std::vector<double>& boxOf(const std::string& name) {
    const Frame frame = scene_.getFrame(name);
    if (kindOf(frame).body != Body::box)
      throw ValueError(cat("Skeleton: ", switchModeName(symbol_), " needs a box (ssBox); '", name, "' is not one"));
    return size_ = frame.getSize();
  }

  std::string exchange(ForceExchange kind) { return komo_.addForceExchange({from_, to_}, f_[1], f_[0], kind); }

  /// Aligns the top of the lower object with the bottom of the upper one: capsules and cylinders lie, others stand.
  void restingOn(const std::vector<double>& during) {
    const double below = .5 * boxOf(f_[0])[2];
    const Frame upper = scene_.getFrame(f_[1]);
    const ShapeKind& kind = kindOf(upper);
    if (kind.type == ShapeType::none || kind.is_symbol)
      throw ValueError(cat("Skeleton: restingOn: '", f_[1], "' needs a shape to rest on '", f_[0], "'"));
    const bool lies = kind.body == Body::capsule || kind.body == Body::cylinder;
    const double half = lies ? upper.getSize()[1] : .5 * height(upper);
    if (!(half > 0.)) {
      throw ValueError(cat("Skeleton: restingOn: the height of '", f_[1],
                           "' is unknown; expected a box, sphere, capsule or cylinder"));
    }
    require(during, F::positionRel, {f_[1], f_[0]}, eq, componentOf(2, 1e1), Vector3d(0., 0., below + half));
    if (kind.body == Body::ball) return;
    if (kind.body == Body::box) return require(during, F::vectorZDiff, f_, eq, 1e1);
    require(during, F::scalarProductZZ, f_, eq, 1e1);
  }

  void downUp() {
    const double step = 1. / komo_.path().grid().slicesPerPhase();
    const double end = to_ < 0. ? -1. : to_ + step;
    for (const std::string& frame : f_)
      requireNear(from_ + step, end, F::position, {frame}, eq, 1., Vector3d(0., 0., .1), 2);
  }

  void lift(const std::string& frame) {
    if (komo_.order() >= 2)
      requireNear(from_ + .3, from_ + .7, F::position, {frame}, ineqP, componentOf(2, -1e1), Vector3d(0., 0., .4));
  }

  /// Returns the radius of the pushed object if it is a ball or a capsule; otherwise 0.
  double roundness() const {
    const Frame object = scene_.getFrame(f_[1]);
    const Body body = kindOf(object).body;
    if (body == Body::ball) return object.getSize()[0];
    return body == Body::capsule ? object.getSize()[1] : 0.;
  }

  void push(const std::vector<double>& during) {
    const std::string point = exchange(ForceExchange::slide);
    if (const double radius = roundness(); radius > 0. && komo_.order() >= 1 && (to_ < 0. || to_ >= from_ + .8)) {
      const double margin = komo_.order() == 1 ? 0. : .2, step = 1. / komo_.path().grid().slicesPerPhase();
      const std::vector<double> times = {from_ + margin + step, to_ < 0. ? -1. : to_ - margin};
      if (const auto [first, last] = komo_.path().grid().select(times); first <= last) {
        komo_.addObjective(times, FeatureRecipe{"pushRadius", {}, radius}, {point, f_[1]}, sos, 1.);
      }
    }
    if (komo_.order() < 2) return;
    require(during, F::position, {f_[1]}, sos, .3, {}, 2);
    for (const std::string& frame : f_) require({to_}, F::pose, {frame}, eq, 1., {}, 1);
  }

  /// Requires that the gripper's z axis points up. A path also comes to rest there, with accelerations for an approach
  /// from above and a retreat upwards.
  void fromAbove(const std::vector<double>& at) {
    require(at, F::vectorZ, {f_[0]}, eq, 1e2, Vector3d::UnitZ());
    if (komo_.order() < 2) return;
    require(at, F::qItself, {}, eq, 1., {}, 1);
    const Vector3d up(0., 0., .1);
    requireNear(from_ - .1, from_, F::position, {f_[0]}, eq, 1., up, 2);
    // The slice after a grasp or release requires a continuous motion of the object, so it is skipped.
    requireNear(from_ + 2. / komo_.path().grid().slicesPerPhase(), from_ + .1, F::position, {f_[0]}, eq, 1., up, 2);
  }

  void topBoxPlace(const std::vector<double>& at) {
    const double standing = .5 * (height(scene_.getFrame(f_[1])) + height(scene_.getFrame(f_[2])));
    require(at, F::positionDiff, {f_[1], f_[2]}, eq, 1e2, Vector3d(0., 0., standing > 0. ? standing : .08));
    fromAbove(at);
  }

  /// Places the object on a face of the box, with its z axis along the normal.
  void touchFace(int axis, const std::vector<double>& at, const std::vector<double>& during) {
    Vector3d on_face = Vector3d::Zero();
    on_face[axis] = .5 * boxOf(f_[1])[std::size_t(axis)];
    require(at, F::positionRel, f_, eq, componentOf(axis, 1e2), on_face);
    komo_.addObjective(at, FeatureRecipe{"axisDifference", {}, double(axis)}, f_, eq, 1e2);
    MatrixXd inside = MatrixXd::Constant(6, 1, 1e1);
    inside(axis) = inside(axis + 3) = 0.;
    require(during, F::insideBox, f_, ineq, inside);
  }

  /// Places the box between the fingers along one of its axes; the fingers move along the gripper's x axis.
  void boxGrasp(int axis, const std::vector<double>& at) {
    constexpr double kMargin = .02;
    const std::vector<double> size = boxOf(f_[1]);
    const std::string palm = f_.size() > 2 ? f_[2] : "r_palm";
    const int sides[] = {(axis + 1) % 3, (axis + 2) % 3};
    require(at, F::positionRel, {f_[0], f_[1]}, eq, componentOf(axis, 1e1));
    MatrixXd within = MatrixXd::Zero(2, 3);
    VectorXd limit = VectorXd::Zero(3);
    for (int i : {0, 1}) {
      within(i, sides[i]) = 1.;
      limit[sides[i]] = .5 * size[std::size_t(sides[i])] - kMargin;
    }
    require(at, F::positionRel, {f_[0], f_[1]}, ineq, within, limit);
    require(at, F::positionRel, {f_[0], f_[1]}, ineq, -within, -limit);
    const double t = from_;
    for (int side : sides) requireNear(t - .2, t, product(0, side), {f_[0], f_[1]}, eq, 1.);
    requireNear(t - .3, t, F::distance, {palm, f_[1]}, ineq, 1e1, -.001);
    if (komo_.order() < 2) return;
    MatrixXd across = MatrixXd::Zero(2, 3);
    across(0, 0) = across(1, 1) = 1e2;
    requireNear(t - .3, t, F::positionRel, {f_[1], f_[0]}, eq, across, {}, 1);
    requireNear(t - .5, t - .3, F::distance, {palm, f_[1]}, ineq, 1e1, -.1);
    require(at, F::qItself, {}, eq, 1., {}, 1);
  }

  Komo& komo_;
  M symbol_;
  Names f_;
  double from_, to_;
  Config scene_;
  std::vector<double> size_;
};

}  // namespace

void addCondition(Komo& komo, const Skeleton::Entry& entry) { ConditionAdder(komo, entry).add(); }

}  // namespace kinegraph
