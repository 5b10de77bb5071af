#include "kinegraph/exporters/writers.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/exporters/mjcf_geoms.h"
#include "kinegraph/exporters/mjcf_motors.h"
#include "kinegraph/exporters/srdf_writer.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/parsers/xml/xml.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

constexpr std::size_t kMaxExclusionBodies = 500;  // exclusions are omitted for more bodies: too many pairs
const Quaterniond kHalfTurn(0., 1., 0., 0.);      // about x: converts between our camera axes and MuJoCo's

bool hasShape(const FrameData& frame) {
  return frame.shape && frame.shape->geometry->type != ShapeType::none &&
         !shapeKind(frame.shape->geometry->type).is_symbol;
}

bool isCamera(const FrameData& frame) { return frame.shape && frame.shape->geometry->type == ShapeType::camera; }

bool rotatesFreely(const Joint& joint) {
  const auto is_quaternion = [](const MotionStep& step) { return step.kind == MotionStep::Kind::quaternion; };
  return std::any_of(joint.steps.begin(), joint.steps.end(), is_quaternion);
}

/// A body of the MJCF text, for contact exclusions. Body 0 is the world.
struct Body {
  std::string name;
  int weld = 0;         ///< the topmost body rigidly connected to it
  int parent_weld = 0;  ///< the same for its parent body
};

/// A joint above a body, and the constant transform before it.
struct ChainJoint {
  const FrameData* frame;
  Pose before;
};

/// A dof that follows a dof of another joint times `factor`; 0: MJCF cannot express the coupling.
struct Follower {
  const FrameData* frame;
  int dof;
  double factor;
};

class MjcfWriter {
 public:
  MjcfWriter(const Config& config, const MjcfOptions& options, std::vector<std::string>* warnings)
      : config_(config), options_(options), warnings_(warnings), geoms_(options, warnings) {
    if (options.motors) motors_.emplace(config_);
  }

  std::string write() {
    for (const auto& frame : config_.scene()->frames()) {
      if (!frame->no_contact.empty()) referred_.insert(frame.get());
      referred_.insert(frame->no_contact.begin(), frame->no_contact.end());
    }
    bodies_.push_back({"world"});
    names_["body"].insert("world");
    for (const auto& frame : config_.scene()->frames()) {
      if (!frame->parent) addRoot(*frame);
    }
    std::string text = cat("<mujoco model=\"", xmlEscaped(options_.model_name), "\">\n",
                           "  <compiler angle=\"radian\" inertiafromgeom=\"false\" balanceinertia=\"true\"/>\n");
    if (motors_) text += MjcfMotors::options();
    if (!geoms_.assets().empty()) text += cat("  <asset>\n", geoms_.assets(), "  </asset>\n");
    text += cat("  <worldbody>\n", text_, "  </worldbody>\n");
    if (const std::string exclusions = excludedPairs(); !exclusions.empty())
      text += cat("  <contact>\n", exclusions, "  </contact>\n");
    if (const std::string followers = equalities(); !followers.empty())
      text += cat("  <equality>\n", followers, "  </equality>\n");
    const bool controls = motors_ && !motors_->controls().empty();
    if (motors_) text += motors_->text();
    if (!qpos_.empty())
      text += cat("  <keyframe>\n    <key name=\"now\" qpos=\"", mjcfNumbers(qpos_), "\"",
                  controls ? cat(" ctrl=\"", mjcfNumbers(motors_->controls()), "\"") : "", "/>\n  </keyframe>\n");
    return text + "</mujoco>\n";
  }

 private:
  void warn(const std::string& message) {
    if (warnings_) warnings_->push_back(message);
  }

  /// Returns whether q or, with motors, a hand moves the frame. Other inactive joints and their mimics are fixed.
  bool isMoved(const FrameData& frame) const {
    return frame.moves() && (dofSource(frame).joint->active || (motors_ && motors_->isFinger(frame)));
  }

  /// A name unused by other elements of that kind.
  std::string unused(const std::string& kind, const std::string& name) {
    const std::string stem = name.empty() ? kind : name;
    std::string free = stem;
    for (int number = 2; !names_[kind].insert(free).second; ++number) free = cat(stem, "_", number);
    return free;
  }

  void warnFixed(const FrameData& frame) {
    if (!frame.moves()) return;
    const FrameData& source = dofSource(frame);
    warn(&source == &frame
             ? cat("joint '", frame.name, "' is not in q (joint_active: false) and is fixed at its current value")
             : cat("joint '", frame.name, "' is fixed because the joint '", source.name, "' it mimics is fixed"));
  }

  void line(int depth, const std::string& text) { text_ += std::string(std::size_t(2 * depth), ' ') + text + "\n"; }

  void addRoot(const FrameData& root) {
    if (root.name == "world" && !root.inertia && !root.joint && root.pose.isIdentity(0.)) {
      addContent(root, 0, false, 2);
    } else if (isLeaf(root)) {
      addLeaf(root, 0, root.pose, false, 2);
    } else {
      addBody(root, 0, false, 2);
    }
  }

  /// Returns whether the frame is only a shape or a marker and needs no body.
  bool isLeaf(const FrameData& frame) const {
    const bool weighs_apart =
        frame.inertia && !(hasShape(frame) && frame.parent);  // the body includes the mass of its shapes
    return frame.children.empty() && !isMoved(frame) && !weighs_apart && !referred_.contains(&frame);
  }

  /// Returns whether the frame only carries its child, so its joint moves to the child's body.
  bool mergesIntoChild(const FrameData& frame) const {
    if (frame.children.size() != 1 || hasShape(frame) || isCamera(frame) || frame.inertia || referred_.contains(&frame))
      return false;
    const FrameData& child = *frame.children[0];
    if (!isMoved(frame)) return isMoved(child) && !frame.moves() && frame.name == child.name + "_origin";
    if (!isMoved(child) && mergesIntoChild(child)) return !rotatesFreely(*frame.joint);  // an origin
    return !isMoved(child) && (!rotatesFreely(*frame.joint) || child.relativePose().q.vec().isZero(0.));
  }

  void addBody(const FrameData& top, int parent, bool parent_moves, int depth) {
    const FrameData* frame = &top;
    Pose pose;
    std::vector<ChainJoint> chain;
    for (;; frame = frame->children[0]) {
      if (isMoved(*frame)) {
        chain.push_back({frame, pose});
      } else {
        warnFixed(*frame);
        pose = pose * frame->relativePose();
      }
      if (!mergesIntoChild(*frame)) break;
    }
    const std::string name = unused("body", frame->name);
    std::string joints;
    const Joint* only = chain.size() == 1 ? &*chain[0].frame->joint : nullptr;
    if (only && only->type == JointType::free && only->scale == 1. && !only->mimic && parent == 0 &&
        pose.isIdentity(0.)) {
      pose = chain[0].frame->relativePose();
      const Vector7d start = pose.numbers();
      qpos_.insert(qpos_.end(), start.begin(), start.end());
      joints = cat("<freejoint name=\"", xmlEscaped(unused("joint", chain[0].frame->name)), "\"/>\n");
    } else {
      for (const ChainJoint& joint : chain) joints += jointElements(*joint.frame, joint.before.inverse() * pose);
    }
    const int id = int(bodies_.size());
    const Body& above = bodies_[parent];
    bodies_.push_back({name, joints.empty() ? above.weld : id, joints.empty() ? above.parent_weld : above.weld});
    line(depth, cat("<body name=\"", xmlEscaped(name), "\"", mjcfPose(pose),
                    motors_ && motors_->isDriven(*frame) ? " gravcomp=\"1\"" : "", ">"));
    for (std::size_t at = 0; at < joints.size();) {
      const std::size_t end = joints.find('\n', at);
      line(depth + 1, joints.substr(at, end - at));
      at = end + 1;
    }
    addInertial(*frame, !joints.empty(), depth + 1);
    addContent(*frame, id, parent_moves || !joints.empty(), depth + 1);
    line(depth, "</body>");
  }

  /// Adds the shape of a body's frame, and everything below it.
  void addContent(const FrameData& frame, int body, bool moves, int depth) {
    if (hasShape(frame) || isCamera(frame)) addLeaf(frame, body, Pose(), moves, depth);
    for (const FrameData* child : frame.children) {
      if (isLeaf(*child)) {
        warnFixed(*child);
        addLeaf(*child, body, child->relativePose(), moves, depth);
      }
    }
    for (const FrameData* child : frame.children) {
      if (!isLeaf(*child)) addBody(*child, body, moves, depth);
    }
  }

  void addLeaf(const FrameData& frame, int body, const Pose& pose, bool moves, int depth) {
    if (hasShape(frame)) {
      const std::string geom = geoms_.geom(frame, unused("geom", frame.name), pose, moves);
      if (!geom.empty()) line(depth, geom);
      if (!geom.empty() && frame.shape->contact != 0) body_of_shape_[frame.id] = body;
    } else if (isCamera(frame)) {
      line(depth,
           cat("<camera name=\"", xmlEscaped(unused("camera", frame.name)), "\"",
               mjcfPose(pose * Pose(Vector3d::Zero(), kHalfTurn)), " fovy=\"", exact(verticalAngle(frame)), "\"/>"));
    } else {
      line(depth, cat("<site name=\"", xmlEscaped(unused("site", frame.name)), "\"", mjcfPose(pose),
                      frame.shape ? "/>" : " rgba=\"0 0 0 0\"/>"));
    }
  }

  /// Vertical field of view, degrees.
  static double verticalAngle(const FrameData& camera) {
    const auto number = [&](const char* key) {
      const Node* node = camera.attributes->find(key);
      const double* value = node ? node->value.as<double>() : nullptr;
      return value ? *value : 0.;
    };
    if (const double angle = number("heightAngle"); angle > 0. && angle < 180.) return angle;
    const double focal = number("focalLength");
    return focal > 0. ? 360. / M_PI * std::atan(.5 / focal) : 45.;
  }

  /// The joints of a frame; `behind` is the pose of the body behind them.
  std::string jointElements(const FrameData& frame, const Pose& behind) {
    const Joint& joint = *frame.joint;
    const Joint& source = *dofSource(frame).joint;
    const Vector3d anchor = behind.inverse().p;
    const int moving =
        int(std::count_if(joint.steps.begin(), joint.steps.end(), [](const MotionStep& step) { return step.moves(); }));
    std::string text;
    int dof = 0, index = 0;
    for (const MotionStep& step : joint.steps) {
      const double scale = motionScale(frame) * step.sign;
      const Vector3d axis = step.direction(joint.axis);
      if (step.moves()) {
        const std::string name = unused("joint", moving == 1 ? frame.name : cat(frame.name, "_", index));
        joint_names_[{&frame, dof}] = name;
        text += cat("<joint name=\"", xmlEscaped(name), "\"");
        if (motors_) text += motors_->jointAttributes(frame);
        if (!step.translates() && !anchor.isZero(0.)) text += cat(" pos=\"", mjcfVector(anchor), "\"");
        ++index;
      }
      if (step.kind == MotionStep::Kind::quaternion) {
        text += " type=\"ball\"/>\n";
        const Vector4d q = source.q.segment<4>(dof).normalized();
        qpos_.insert(qpos_.end(), q.begin(), q.end());
      } else if (step.orients()) {
        text += cat(" axis=\"", mjcfVector(axis), "\"/>\n");
        qpos_.push_back(2. * std::atan2(source.q[dof + 1], source.q[dof]));
      } else if (step.moves()) {
        const Vector3d direction = behind.q.conjugate() * (scale < 0. ? Vector3d(-axis) : axis);
        text += cat(step.translates() ? " type=\"slide\"" : "", " axis=\"", mjcfVector(direction), "\"",
                    range(frame, dof, std::abs(scale)), "/>\n");
        qpos_.push_back(std::abs(scale) * source.q[dof]);
        if (motors_) motors_->add(frame, dof, joint_names_[{&frame, dof}], qpos_.back(), std::abs(scale));
      }
      if (joint.mimic && step.moves())
        followers_.push_back({&frame, dof, step.dofs() == 1 ? std::abs(scale / source.scale) : 0.});
      dof += step.dofs();
    }
    return text;
  }

  std::string range(const FrameData& frame, int dof, double unit) {
    const Joint& joint = *frame.joint;
    if (joint.lower.size() <= dof || !std::isfinite(joint.lower[dof]) || !std::isfinite(joint.upper[dof])) return "";
    if (!(joint.lower[dof] < joint.upper[dof])) {
      warn(cat("the limits of joint '", frame.name, "' are omitted: MJCF requires upper > lower"));
      return "";
    }
    return cat(" range=\"", exact(unit * joint.lower[dof]), " ", exact(unit * joint.upper[dof]), "\"");
  }

  /// The couplings of mimicking joints. Requires that all joints have names.
  std::string equalities() {
    std::string text;
    for (const Follower& follower : followers_) {
      const FrameData& source = dofSource(*follower.frame);
      const auto leader = joint_names_.find({&source, follower.dof});
      if (follower.factor == 0. || leader == joint_names_.end()) {
        warn(cat("joint '", follower.frame->name, "' mimics '", source.name, "'; MJCF cannot express this coupling"));
        continue;
      }
      text += cat("    <joint joint1=\"", xmlEscaped(joint_names_.at({follower.frame, follower.dof})), "\" joint2=\"",
                  xmlEscaped(leader->second), "\" polycoef=\"0 ", exact(follower.factor), " 0 0 0\"",
                  motors_ ? MjcfMotors::coupling() : "", "/>\n");
    }
    return text;
  }

  void addInertial(const FrameData& frame, bool moves, int depth) {
    LinkInertia inertia;
    if (frame.inertia) inertia = {frame.inertia->mass, frame.inertia->com, frame.inertia->matrix};
    for (const FrameData* child : frame.children) {
      if (isLeaf(*child) && child->inertia)
        inertia.add({child->inertia->mass, child->inertia->com, child->inertia->matrix}, child->pose.transform());
    }
    if (!(inertia.mass > 0.)) {
      if (moves) line(depth, "<inertial pos=\"0 0 0\" mass=\"0.001\" diaginertia=\"1e-6 1e-6 1e-6\"/>");
      return;
    }
    const Matrix3d m = .5 * (inertia.matrix + inertia.matrix.transpose());
    std::string form =
        m.isDiagonal(0.)
            ? cat("diaginertia=\"", mjcfVector(Vector3d(m.diagonal())), "\"")
            : cat("fullinertia=\"", mjcfNumbers({m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)}), "\"");
    if (!(Eigen::SelfAdjointEigenSolver<Matrix3d>(m).eigenvalues()[0] > 1e-12)) {
      warn(cat("the inertia of frame '", frame.name, "' is not positive definite and is replaced"));
      form = "diaginertia=\"1e-6 1e-6 1e-6\"";
    }
    line(depth, cat("<inertial pos=\"", mjcfVector(inertia.com), "\" mass=\"", exact(inertia.mass), "\" ", form, "/>"));
  }

  /// Excludes the pairs of bodies that MuJoCo checks but the scene does not.
  std::string excludedPairs() {
    std::set<std::pair<int, int>> collidable;
    std::map<std::pair<int, int>, int> shapes_that_collide;
    for (const auto& [a, b] : config_.getCollidablePairs()) {
      if (!body_of_shape_.contains(a) || !body_of_shape_.contains(b)) continue;
      const std::pair<int, int> pair = std::minmax(body_of_shape_.at(a), body_of_shape_.at(b));
      collidable.insert(pair);
      ++shapes_that_collide[pair];
    }
    std::map<int, int> shapes;  // per body
    for (const auto& [frame, body] : body_of_shape_) ++shapes[body];
    std::set<int> with_shapes;
    for (const auto& [frame, body] : body_of_shape_) with_shapes.insert(body);
    if (with_shapes.size() > kMaxExclusionBodies) {
      warn(cat("exclusions of collision pairs are omitted: the scene has ", with_shapes.size(),
               " bodies with contacts"));
      return "";
    }
    std::string text;
    std::vector<std::string> lost, mixed;
    for (const int a : with_shapes) {
      for (const int b : with_shapes) {
        const Body &x = bodies_[a], &y = bodies_[b];
        if (a >= b || x.weld == y.weld) continue;
        const bool family = (x.parent_weld == y.weld && y.weld != 0) || (y.parent_weld == x.weld && x.weld != 0);
        if (collidable.contains({a, b})) {
          if (family) lost.push_back(cat(x.name, " - ", y.name));
          if (shapes_that_collide[{a, b}] < shapes[a] * shapes[b]) mixed.push_back(cat(x.name, " - ", y.name));
          continue;
        }
        if (family) continue;
        text += cat("    <exclude body1=\"", xmlEscaped(x.name), "\" body2=\"", xmlEscaped(y.name), "\"/>\n");
      }
    }
    if (!lost.empty())
      warn(cat("MuJoCo ignores collisions between a body and its parent; lost pairs: ", joinFirst(lost)));
    if (!mixed.empty())
      warn(cat("MJCF excludes pairs of bodies, not of shapes; all shapes of these bodies may collide: ",
               joinFirst(mixed)));
    return text;
  }

  const Config& config_;
  const MjcfOptions& options_;
  std::vector<std::string>* warnings_;
  MjcfGeoms geoms_;
  std::optional<MjcfMotors> motors_;
  std::string text_;
  std::vector<Follower> followers_;
  std::vector<double> qpos_;
  std::vector<Body> bodies_;
  std::map<int, int> body_of_shape_;  ///< bodies by ids of frames with contacts
  std::set<const FrameData*> referred_;
  std::map<std::string, std::set<std::string>> names_;                   ///< used names, by kind
  std::map<std::pair<const FrameData*, int>, std::string> joint_names_;  ///< by frame and dof
};

}  // namespace

std::string writeMjcf(const Config& config, const MjcfOptions& options, std::vector<std::string>* warnings) {
  if (options.motors) return MjcfWriter(withFreeObjects(config), options, warnings).write();
  return MjcfWriter(config, options, warnings).write();
}

}  // namespace kinegraph
