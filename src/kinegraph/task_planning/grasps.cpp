#include "kinegraph/task_planning/grasps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/scene/hand_fingers.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_tools.h"

// Grasps: the shape of an object that the fingers hold, and the axis along which they close.
namespace kinegraph {

namespace {

using F = FeatureSymbol;
using O = ObjectiveType;
using Body = ShapeKind::Body;
using Variants = std::vector<std::string>;

constexpr double kUsualOpening = .08;      ///< m: default opening of a hand with a palm
constexpr double kLeastClearance = .0015;  ///< m: of fingertips from the ground next to a thin object
constexpr double kThinnest = .004;         ///< m: fingertips do not hold lower objects on their ground
constexpr double kFreeShare = .25;         ///< share of the height of a low object that fingertips leave free
constexpr double kNoShift = 1e-4;          ///< m: smaller shifts are none
constexpr std::size_t kMostGrasps = 6;     ///< by parts of a body
constexpr double kTurns = 1e2;             ///< per m, of a center of mass that is too far away
constexpr double kEasyShare = .5;          ///< of the lever that a hand withstands
constexpr double kOffShare = .6;           ///< of the half length of fingertips: most distance from their middle
constexpr double kMostOff = .008;          ///< m: the same
constexpr double kSlack = .002;            ///< m: round things that are nearer to the hand's link are held off center
constexpr std::string_view kOffCenter = "off center";
constexpr std::string_view kOpening = "opening";
constexpr std::string_view kLeastOpening = "least_opening";

/// The sizes of a box, or of the box around a mesh, along x, y, z, m.
Vector3d widthsOf(const Frame& frame) {
  const Eigen::AlignedBox3d around = boxOfShape(frame);
  if (around.isEmpty())
    throw ValueError(cat("planTask: object '", frame.getName(), "' has no shape that can be grasped"));
  return around.sizes();
}

/// The colliding shapes of a hand's fingers, or of the link that carries them.
std::vector<std::string> shapesOfHand(const Config& C, const std::string& hand, bool of_fingers) {
  const auto headOf = [](Frame frame, bool& is_finger) {
    while (!frame.data().moves() || !dofSource(frame.data()).joint->active) {
      is_finger = is_finger || frame.data().moves();
      const std::optional<Frame> parent = frame.getParent();
      if (!parent) break;
      frame = *parent;
    }
    return frame;
  };
  bool unused = false;
  const Frame head = headOf(C.getFrame(hand), unused);
  std::vector<std::string> names;
  for (const Frame& frame : C.getFrames()) {
    bool is_finger = false;
    if (frame.data().shape && frame.data().shape->contact && headOf(frame, is_finger) == head &&
        is_finger == of_fingers)
      names.push_back(frame.getName());
  }
  return names;
}

/// Whether a round thing between the middles of the fingertips meets the link of a hand, such as a camera on it.
bool meetsHand(const Config& C, const Frame& thing, const std::string& hand) {
  const std::vector<double> size = thing.getSize();
  const double radius = shapeKind(thing.getShapeType()).body == Body::ball ? size.back() : size[1];
  return std::ranges::any_of(shapesOfHand(C, hand, false), [&](const std::string& part) {
    return -eval(C, F::distance, {part, hand}).y[0] < radius + kSlack;
  });
}

/// The distance by which fingers are shifted so that their tips hold a low object without meeting the ground, m.
double gripShift(const Config& C, const std::string& hand, const std::string& obj, const std::string& variant) {
  const GraspWords words = graspWords(obj, variant);
  const double reach = fingerReach(C, hand);
  if (words.way == "touch" || !(reach > 0.)) return 0.;
  if (const int axis = words.axis(); axis >= 0) {
    constexpr double kUpright = .7;  // fingers above and below the object
    if (std::abs(heldShape(C, obj, words).frame.getRotationMatrix()(2, axis)) > kUpright) return 0.;
  }
  const HeldHeights at = heldHeights(C, obj, words);
  const double top = at.below + at.height;
  if (top < kThinnest) return 0.;
  const double clearance = std::clamp(kFreeShare * top, kLeastClearance, kTaskMargin);
  const double highest = top - std::min(kGraspInside, kFreeShare * at.height);
  return highest >= reach + clearance ? 0. : std::max(reach + clearance - at.below - .5 * at.height, 0.);
}

std::string gripName(const std::string& hand, const std::string& obj, const std::string& variant) {
  return cat("grip of ", hand, " at ", obj, " (", variant, ")");
}

/// The openings of a hand.
struct Openings {
  double least, most;  // m
  bool hold(double width) const { return least <= width && width <= most; }
};

/// The value of an attribute of a hand's frame, m; none if the frame does not have it.
std::optional<double> saidWidth(const Frame& hand, std::string_view key) {
  const Node* said = hand.attributes().find(key);
  if (!said) return std::nullopt;
  const double* width = said->value.as<double>();
  if (width && *width >= 0.) return *width;
  throw ValueError(cat("planTask: frame '", hand.getName(), "' has the attribute ", key, " with ",
                       describe(said->value), "; expected a number >= 0, in m"));
}

Openings openingsOf(const Config& C, const std::string& hand) {
  return {saidWidth(C.getFrame(hand), kLeastOpening).value_or(0.), opening(C, hand).value_or(0.)};
}

/// The ways in which fingers close on one shape, the narrow ones first; none if it does not fit between them.
Variants waysOf(const Frame& frame, const Openings& hand) {
  const std::vector<double> size = frame.getSize();
  const Body body = shapeKind(frame.getShapeType()).body;
  if (body == Body::ball) return hand.hold(2. * size.back()) ? Variants{"center"} : Variants{};
  if (body == Body::capsule) return hand.hold(2. * size[1]) ? Variants{"around"} : Variants{};
  if (body == Body::cylinder && hand.hold(2. * size[1])) return {"around"};
  if (body == Body::cylinder) return hand.hold(size[0]) ? Variants{"z"} : Variants{};  // a disk, at its rim
  const Vector3d widths = widthsOf(frame);
  std::array<int, 3> axes = {0, 1, 2};
  std::ranges::stable_sort(axes, {}, [&](int k) { return widths[k]; });
  Variants ways;
  for (const int k : axes)
    if (hand.hold(widths[k])) ways.emplace_back(1, "xyz"[k]);
  return ways;
}

/// Whether a round thing also has to be held beside the middle of the fingertips.
bool isHeldOffCenter(const Config& C, const Frame& thing, const std::string& hand, const Variants& ways) {
  return (ways == Variants{"center"} || ways == Variants{"around"}) && meetsHand(C, thing, hand);
}

/// Grasps of a body of several shapes: by the shape of its own frame, across all of it, then by its parts. First those
/// that fingers get around, close to the center of mass and not too far beside it; parts at equal distances are spread.
Variants waysOfBody(const Config& C, const std::string& obj, const std::string& hand) {
  constexpr double kRing = .005;  // m
  constexpr long kLast = 1000;    // rings: parts at which the weight turns the body in the hand come last
  const Frame body = C.getFrame(obj);
  const Openings openings = openingsOf(C, hand);
  const PartAccess access(C, obj, openings.most);
  const Vector3d center = centerOfBody(body), from = C.getFrame(hand).getPosition();
  Variants first, others;
  const auto add = [&](const std::string& variant) { (access.guess(variant) ? first : others).push_back(variant); };
  if (body.getShapeType() != ShapeType::none) {
    const Variants ways = waysOf(body, openings);
    for (const std::string& way : ways) add(way);
    if (isHeldOffCenter(C, body, hand, ways)) add(std::string(kOffCenter));
  }
  const Eigen::AlignedBox3d around = boxOfBody(body);
  for (int k = 0; k < 3; ++k)
    if (openings.hold(around.sizes()[k]) && !boxAcross(body, k).isEmpty())
      add(cat(std::string(1, "xyz"[k]), kOfPart, kAllParts));
  using Ranked = std::pair<std::pair<long, double>, std::string>;
  std::vector<Ranked> parts;
  for (const Frame& part : heldShapes(body)) {
    if (part == body) continue;
    for (const std::string& way : waysOf(part, openings)) {
      const std::string variant = cat(way, kOfPart, part.getName());
      const std::optional<GraspGuess> guess = access.guess(variant);
      if (!guess) {
        others.push_back(variant);
        continue;
      }
      const Vector3d at = body.getPose().transform() * guess->at, off = guess->at - center;
      const bool turns = Vector3d(body.getRotationMatrix() * off).head<2>().norm() > leverOf(body);
      parts.push_back({{std::lround(off.norm() / kRing) + (turns ? kLast : 0), (at - from).norm()}, variant});
    }
  }
  std::ranges::sort(parts);
  const std::size_t room = kMostGrasps - std::min(first.size(), kMostGrasps - 1);
  const std::size_t count = std::min(parts.size(), room);
  for (std::size_t k = 0; k < count; ++k)
    first.push_back(parts[count < 2 ? 0 : k * (parts.size() - 1) / (count - 1)].second);
  first.insert(first.end(), others.begin(), others.end());
  return first;
}

// --- constraints -----------------------------------------------------------------------------------------------------

/// The fingers close along an axis of a box, inside of its other sides.
void graspBox(TaskWaypoints& w, double time, const std::string& grip, const std::string& obj,
              const Eigen::AlignedBox3d& box, int axis, const std::string& palm) {
  const Vector3d middle = box.center(), half = .5 * box.sizes();
  const Vector3d inside = half.array() - (.5 * half.array()).min(kGraspInside);
  std::vector<int> others = {0, 1, 2};
  others.erase(others.begin() + axis);
  const MatrixXd all = 1e1 * Eigen::Matrix3d::Identity(), along = all.row(axis), across = all(others, Eigen::all);
  const Vector3d most = middle + inside, least = middle - inside;
  w.komo().addObjective({time}, F::positionRel, {grip, obj}, O::eq, along, middle);
  w.komo().addObjective({time}, F::positionRel, {grip, obj}, O::ineq, across, most);
  w.komo().addObjective({time}, F::positionRel, {grip, obj}, O::ineq, -across, least);
  constexpr std::array kProducts = {F::scalarProductXX, F::scalarProductXY, F::scalarProductXZ};
  for (const int other : others)
    w.komo().addObjective({time - .2, time}, kProducts[std::size_t(other)], {grip, obj}, O::eq, 1e0);
  if (!palm.empty()) w.komo().addObjective({time - .3, time}, F::distance, {palm, obj}, O::ineq, 1e1, -.001);
}

/// A grasp far inside and close to the center of mass reduces the rotation in the hand.
void nearCenter(TaskWaypoints& w, double time, const std::string& grip, const std::string& obj) {
  const Vector3d center = centerOfBody(w.C.getFrame(obj));
  if (isCentered(center))
    w.komo().addObjective({time}, F::positionDiff, {grip, obj}, O::sos, 3e0);
  else
    w.komo().addObjective({time}, F::positionRel, {grip, obj}, O::sos, 3e0, center);
}

/// A grasp is preferred so close to the center of mass that the weight does not turn the object between the fingers.
void withinLever(TaskWaypoints& w, double time, const std::string& grip, const std::string& obj) {
  const Frame body = w.C.getFrame(obj);
  const double lever = kEasyShare * leverOf(body);
  if (!std::isfinite(lever) || body.getJointType() != JointType::rigid) return;  // hinges carry doors
  const Matrix3d R = body.getRotationMatrix();
  const MatrixXd level = kTurns * R.topRows<2>();
  const Vector3d center = centerOfBody(body), away = R.transpose() * Vector3d(lever, lever, 0.);
  w.komo().addObjective({time}, F::positionRel, {grip, obj}, O::ineqP, level, Vector3d(center + away));
  w.komo().addObjective({time}, F::positionRel, {grip, obj}, O::ineqP, -level, Vector3d(center - away));
}

/// Fingers hold a round thing with the upper or lower parts of their tips, so that the palm or what is mounted at the
/// hand has room.
void graspOffCenter(TaskWaypoints& w, double time, const std::string& hand, const std::string& grip,
                    const std::string& part, double inside) {
  const double off = std::min(kOffShare * fingerReach(w.C, hand), kMostOff);
  const MatrixXd all = 1e1 * Eigen::Matrix3d::Identity(), across = all.row(0), others = all.bottomRows(2);
  const Frame thing = w.C.getFrame(part);
  w.komo().addObjective({time}, F::positionRel, {part, grip}, O::eq, across);
  if (!isRoundBody(thing)) {
    w.komo().addObjective({time}, F::positionRel, {part, grip}, O::ineq, others, {0., off, off});
    w.komo().addObjective({time}, F::positionRel, {part, grip}, O::ineq, -others, {0., -off, -off});
    return;
  }
  const double along = std::max(.5 * thing.getSize()[0] - inside, 0.);
  const Vector3d most(off, off, along);
  w.komo().addObjective({time}, F::positionRel, {grip, part}, O::ineq, all, most);
  w.komo().addObjective({time}, F::positionRel, {grip, part}, O::ineq, -all, Vector3d(-most));
  w.komo().addObjective({time - .2, time}, F::scalarProductXZ, {grip, part}, O::eq, 1e0);
}

/// The box in a disk, in whose sides fingers hold its rim.
Eigen::AlignedBox3d boxInDisk(const Frame& disk) {
  const double half = disk.getSize()[1] / std::sqrt(2.), thick = .5 * disk.getSize()[0];
  return {Vector3d(-half, -half, -thick), Vector3d(half, half, thick)};
}

}  // namespace

std::vector<std::string> task_planning_internal::fingerShapes(const Config& C, const std::string& hand) {
  return shapesOfHand(C, hand, true);
}

double task_planning_internal::fingerReach(const Config& C, const std::string& hand) {
  double reach = 0.;
  const Frame frame = C.getFrame(hand);
  for (const std::string& name : fingerShapes(C, hand)) {
    const Frame finger = C.getFrame(name);
    const RigidTransform X = finger.getPose(frame).transform();
    for (const Vector3d& corner : boxCorners(finger)) reach = std::max(reach, -Vector3d(X * corner).z());
  }
  return reach;
}

std::string task_planning_internal::addGripFrame(Config& scene, const std::string& hand, const std::string& obj,
                                                 const std::string& variant) {
  const double shift = gripShift(scene, hand, obj, variant);
  if (shift < kNoShift) return hand;
  const std::string name = gripName(hand, obj, variant);
  if (!scene.findFrame(name)) scene.addFrame(name, hand).setRelativePosition({0., 0., -shift});
  return name;
}

std::optional<GraspGuess> task_planning_internal::graspGuess(const Config& C, const std::string& obj,
                                                             const std::string& hand, const std::string& variant) {
  const std::optional<double> wide = opening(C, hand);
  if (!wide || !isCompound(C.getFrame(obj)) || variant == "touch") return std::nullopt;
  return PartAccess(C, obj, *wide).guess(variant);
}

void task_planning_internal::addGrasp(TaskWaypoints& w, double time, const std::string& hand, const std::string& obj,
                                      const std::string& variant, double inside) {
  const std::string palm = palmOf(w.C, hand), shifted = gripName(hand, obj, variant);
  const std::string grip = w.C.findFrame(shifted) ? shifted : hand;
  const GraspWords words = graspWords(obj, variant);
  if (!palm.empty()) nearCenter(w, time, grip, obj);
  if (!palm.empty()) withinLever(w, time, grip, obj);
  if (words.isOfAllParts()) {
    graspBox(w, time, grip, obj, heldShape(w.C, obj, words).box, words.axis(), "");
    return;
  }
  const Frame thing = w.C.getFrame(words.part);
  const std::vector<double> size = thing.getSize();
  const int axis = words.axis();
  if (words.way == "touch") {
    w.komo().addObjective({time}, F::distance, {words.part, hand}, O::eq, 1e1);
  } else if (words.way == "center") {
    w.komo().addObjective({time}, F::positionDiff, {grip, words.part}, O::eq, 1e1);
  } else if (words.way == kOffCenter) {
    graspOffCenter(w, time, hand, grip, words.part, std::min(inside, .25 * size[0]));
  } else if (words.way == "around") {
    w.m->grasp_cylinder(time, grip, words.part, palm, std::min(inside, .25 * size[0]));
  } else if (isBox(thing)) {
    double least = std::min({size[0], size[1], size[2]});
    if (words.part != obj && axis >= 0)
      least = std::min(size[std::size_t(axis + 1) % 3], size[std::size_t(axis + 2) % 3]);
    w.m->grasp_box(time, grip, words.part, palm, words.way, std::min(inside, .25 * least));
  } else if (axis >= 0) {
    graspBox(w, time, grip, words.part, isRoundBody(thing) ? boxInDisk(thing) : boxAround(thing), axis, palm);
  } else {
    throw ValueError(cat("planTask: '", hand, "' cannot hold '", obj, "' by '", variant, "'; expected x, y or z"));
  }
}

std::string task_planning_internal::graspFlaw(const Config& C, const std::string& obj, const std::string& place,
                                              const std::string& hand) {
  if (!opening(C, hand)) return "";
  const Variants ways = graspVariants(C, obj, hand);
  const HeldHeights at = heldHeights(C, obj, {"", std::string(kAllParts)});
  const std::string lies = cat("lies flat on '", place, "': let it overhang an edge, or raise it");
  if (isTooWideAcross(C, obj, hand))
    return cat(graspMisfit(C, obj, hand), " along its level axes, and no finger gets below it while it ", lies);
  if (!ways.empty() && at.height < kThinnest && fingerReach(C, hand) > 0.)
    return cat("'", obj, "' is ", fixed(1e3 * at.height, 1), " mm high, too thin for the tips of '", hand, "' (",
               fixed(1e3 * kThinnest, 0), " mm) while it ", lies);
  return "";
}

std::string task_planning_internal::graspMisfit(const Config& C, const std::string& obj, const std::string& hand) {
  const Openings openings = openingsOf(C, hand);
  if (openings.least > 0.)
    return cat("'", obj, "' does not fit between the fingers of '", hand, "' (", fixed(openings.least, 3), " to ",
               fixed(openings.most, 3), " m)");
  return cat("'", obj, "' is wider than '", hand, "' opens (", fixed(openings.most, 3), " m)");
}

std::string palmOf(const Config& C, const std::string& hand) {
  constexpr std::string_view kGripper = "gripper";
  const bool is_named = hand.ends_with(kGripper);
  const std::string name = hand.substr(0, hand.size() - (is_named ? kGripper.size() : 0)) + "palm";
  return C.findFrame(name) ? name : "";
}

std::optional<double> opening(const Config& C, const std::string& hand) {
  if (const std::optional<double> said = saidWidth(C.getFrame(hand), kOpening)) return said;
  return palmOf(C, hand).empty() ? std::nullopt : std::optional(kUsualOpening);
}

Config withOpenings(const Config& C, const std::vector<std::string>& hands) {
  Config scene = C;
  const std::vector<HandFingers> all = handFingersOf(C);
  for (const std::string& hand : hands) {
    Frame frame = scene.getFrame(hand);
    std::optional<Frame> head = frame;
    while (head->getJointType() == JointType::none && head->getParent()) head = head->getParent();
    const auto isBelow = [&](const HandFingers& fingers) {
      for (std::optional<Frame> up = scene.getFrame(fingers.joint); up; up = up->getParent())
        if (*up == *head) return true;
      return false;
    };
    const auto found = std::ranges::find_if(all, isBelow);
    if (found == all.end() || !(found->maxWidth() > 0.)) continue;
    const auto add = [&](std::string_view key, double width) {
      if (!frame.attributes().find(key)) frame.editAttributes().set({std::string(key), {}, {}, {width, {}}, {}});
    };
    add(kOpening, found->maxWidth());
    if (found->minWidth() > kThinnest) add(kLeastOpening, found->minWidth());
  }
  return scene;
}

Variants graspVariants(const Config& C, const std::string& obj, const std::string& hand) {
  if (!opening(C, hand)) return {"touch"};
  const Frame frame = C.getFrame(obj);
  if (isCompound(frame)) return waysOfBody(C, obj, hand);
  Variants ways = waysOf(frame, openingsOf(C, hand));
  if (isHeldOffCenter(C, frame, hand, ways)) ways.emplace_back(kOffCenter);
  const std::string up = upOf(C, obj).substr(0, 1);  // a finger would have to be below the object
  std::ranges::stable_partition(ways, [&](const std::string& way) { return way != up; });
  return ways;
}

bool isTooWideAcross(const Config& C, const std::string& obj, const std::string& hand) {
  const Variants ways = graspVariants(C, obj, hand);
  return ways.size() == 1 && ways[0].size() == 1 && upOf(C, obj).starts_with(ways[0]);
}

}  // namespace kinegraph
