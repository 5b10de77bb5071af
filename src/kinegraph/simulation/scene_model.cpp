#include "kinegraph/simulation/scene_model.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/simulation/model_shapes.h"

namespace kinegraph {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr int kWelds = 32;                ///< kept for attach
constexpr double kOverlap = 1e-3;         ///< m: what overlaps more at the start never touches, in one tree
constexpr double kGripStiffness = 2000.;  ///< N/m; and damping N s/m
constexpr double kGripDamping = 60.;
constexpr double kGripLever = .1;  ///< m: turns them into those of fingers that turn

bool isScalar(MotionKind kind) {
  return kind == MotionKind::translate || kind == MotionKind::rotate || kind == MotionKind::rotateAbout;
}

bool isFingerJoint(const FrameData& frame) {
  const Joint& joint = *frame.joint;
  return !joint.active && !joint.mimic && joint.dofs() == 1 && isScalar(joint.steps.front().kind);
}

class ModelMaker {
 public:
  ModelMaker(SceneTree& scene, const SimulationOptions& options, const ModelExtras& extras)
      : scene_(scene),
        program_(*scene.program()),
        options_(options),
        extras_(extras),
        spec_(mj_.mj_makeSpec(), mj_.mj_deleteSpec),
        shapes_(spec_.get(), options) {}

  SceneModel make() {
    model_.scene = divideScene(scene_, extras_.forces);
    model_.dofs = program_.dofs;
    setOptions();
    addBodies();
    addShapes();
    excludeOverlaps();
    shapes_.addFrictionPairs(excluded_, extras_.can_change_frictions);
    couple();
    addGrippers();
    addWelds();
    addSensors();
    compile();
    return std::move(model_);
  }

 private:
  struct MadeJoint {
    const FrameData* frame;
    std::vector<std::pair<MotionKind, mjsJoint*>> steps;
  };

  void setOptions() {
    mjOption& option = spec_->option;
    option.timestep = options_.inner_step;
    option.integrator = mjINT_DISCRETE;
    option.cone = mjCONE_ELLIPTIC;
    option.impratio = 1000.;
    option.gravity[2] = -options_.gravity;
    option.disableflags |= mjDSBL_AUTORESET;
    if (options_.speculative) option.enableflags |= mjENBL_SPECULATIVE;
    if (options_.sleep) option.enableflags |= mjENBL_SLEEP;
    spec_->compiler.degree = 0;
    spec_->compiler.balanceinertia = 1;
    spec_->compiler.boundmass = 1e-6;
    spec_->compiler.boundinertia = 1e-9;
    spec_->memory = mjtSize(4 << 20) + mjtSize(200 << 10) * mjtSize(model_.scene.bodies.size());
  }

  void addBodies() {
    made_bodies_.push_back(mj_.mjs_findBody(spec_.get(), "world"));
    for (std::size_t b = 1; b < model_.scene.bodies.size(); ++b) {
      const SceneBody& body = model_.scene.bodies[b];
      mjsBody* made = mj_.mjs_addBody(made_bodies_[std::size_t(body.parent)], nullptr);
      mj_.mjs_setName(made->element, bodyName(int(b)).c_str());
      std::copy_n(body.X_PB.p.data(), 3, made->pos);
      std::copy_n(wxyz(body.X_PB.q).data(), 4, made->quat);
      made->gravcomp = body.has_gravity ? 0. : 1.;
      setInertia(*made, body.inertia);
      made_bodies_.push_back(made);
      if (body.kind == SceneBody::Kind::free) mj_.mjs_addFreeJoint(made);
      if (body.kind == SceneBody::Kind::jointed) addJoint(*body.frame, made);
    }
  }

  static std::string bodyName(int body) { return body == 0 ? "world" : cat("b", body); }

  static void setInertia(mjsBody& made, const LinkInertia& inertia) {
    made.explicitinertial = 1;
    made.mass = inertia.mass;
    std::copy_n(inertia.com.data(), 3, made.ipos);
    const Matrix3d& I = inertia.matrix;
    Vector3d principal = I.diagonal();
    Quaterniond axes = Quaterniond::Identity();
    if (!I.isDiagonal(1e-12)) {
      const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(I);
      Matrix3d R = solver.eigenvectors();
      if (R.determinant() < 0.) R.col(0) *= -1.;
      principal = solver.eigenvalues().cwiseMax(0.);
      axes = Quaterniond(R);
    }
    std::copy_n(principal.data(), 3, made.inertia);
    std::copy_n(wxyz(axes).data(), 4, made.iquat);
  }

  void addJoint(const FrameData& frame, mjsBody* body) {
    const Joint& joint = *frame.joint;
    const Joint& source = *dofSource(frame).joint;
    const double scale = motionScale(frame);
    const bool driven = !attributeFlag(frame, "noMotor", false);
    MadeJoint made{&frame, {}};
    int q = 0;
    for (std::size_t i = 0; i < joint.steps.size(); ++i) {
      const MotionStep& step = joint.steps[i];
      mjsJoint* m = nullptr;
      if (step.moves()) {
        m = mj_.mjs_addJoint(body, nullptr);
        mj_.mjs_setName(m->element, cat("j", frame.id, "_", i).c_str());
        m->type = step.slides() ? mjJNT_SLIDE : step.kind == MotionKind::quaternion ? mjJNT_BALL : mjJNT_HINGE;
        const Vector3d axis = step.kind == MotionKind::circle ? Vector3d(Vector3d::UnitZ())
                                                              : Vector3d(step.sign * step.direction(joint.axis));
        if (m->type != mjJNT_BALL) std::copy_n(axis.data(), 3, m->axis);
        m->armature = driven ? options_.armature : 0.;
        m->damping[0] = attributeNumber(frame, "angularDamping", 0.);
        m->frictionloss = driven ? 0. : attributeNumber(frame, "jointFriction", 0.);
        if (isScalar(step.kind) && source.lower.size() > q && source.upper[q] > source.lower[q])
          setLimits(*m, scale * source.lower[q], scale * source.upper[q]);
      }
      made.steps.emplace_back(step.kind, m);
      q += step.dofs();
    }
    made_joints_.push_back(made);
  }

  static void setLimits(mjsJoint& m, double a, double b) {
    if (!std::isfinite(a) || !std::isfinite(b)) return;
    m.limited = mjLIMITED_TRUE;
    m.range[0] = std::min(a, b);
    m.range[1] = std::max(a, b);
    m.solref_limit[0] = m.type == mjJNT_SLIDE ? .004 : .01;
  }

  void addShapes() {
    if (options_.ground) shapes_.addGround();
    for (const auto& frame : scene_.frames()) {
      if (!takesPart(*frame)) continue;
      const PlacedFrame& placed = model_.scene.frames[std::size_t(frame->id)];
      mjsBody* body = made_bodies_[std::size_t(placed.body)];
      Pose X_BF = placed.X_BF;
      if (placed.body == 0) {
        body = mj_.mjs_addBody(body, nullptr);
        mj_.mjs_setName(body->element, fixedName(frame->id).c_str());
      }
      shapes_.body_number = placed.body == 0 ? fixedBody(frame->id) : placed.body;
      shapes_.body_moves = moves(placed.body);
      shapes_.add(*frame, body, X_BF, placed.robot);
      warnOfRestitution(*frame);
    }
  }

  static std::string fixedName(int frame) { return cat("s", frame); }

  bool moves(int body) const {
    while (body > 0 && model_.scene.bodies[std::size_t(body)].kind == SceneBody::Kind::fixed)
      body = model_.scene.bodies[std::size_t(body)].parent;
    return body > 0;
  }

  void warnOfRestitution(const FrameData& frame) {
    const double restitution = attributeNumber(frame, "restitution", 0.);
    if (restitution > .2)
      model_.scene.warnings.push_back(cat("Simulation: frame '", frame.name, "' has restitution ", restitution,
                                          "; things bounce by .1 to .2 here, not more"));
  }

  /// Links of robots that overlap, as the scene is, with others of their tree, or with the ground.
  void excludeOverlaps() {
    struct Placed {
      const FrameData *frame, *root;
      int body, robot;
      bool jointed;
      RigidTransform X;
    };
    std::vector<Placed> all;
    for (const auto& frame : scene_.frames()) {
      if (!takesPart(*frame)) continue;
      const PlacedFrame& placed = model_.scene.frames[std::size_t(frame->id)];
      if (model_.scene.bodies[std::size_t(placed.body)].kind == SceneBody::Kind::free) continue;
      const FrameData* root = frame.get();
      while (root->parent) root = root->parent;
      all.push_back({frame.get(), root, placed.body == 0 ? fixedBody(frame->id) : placed.body, placed.robot,
                     placed.body > 0, scene_.worldPose(*frame).transform()});
    }
    for (const Placed& a : all) {
      if (!a.jointed) continue;
      const CollisionBody& body = *a.frame->shape->body();
      if (options_.ground && lowest(body, a.X) < -kOverlap) exclude(kGroundBody, "ground", a.body, bodyName(a.body));
      for (const Placed& b : all) {
        if (a.robot == b.robot || a.root != b.root || (b.jointed && b.frame->id < a.frame->id)) continue;
        const double apart = (a.X * body.boundCenter() - b.X * b.frame->shape->body()->boundCenter()).norm() -
                             body.boundRadius() - b.frame->shape->body()->boundRadius();
        if (apart > 0. || proximity(body, a.X, *b.frame->shape->body(), b.X).distance > -kOverlap) continue;
        exclude(a.body, bodyName(a.body), b.body, b.body < 0 ? fixedName(b.frame->id) : bodyName(b.body));
      }
    }
  }

  static double lowest(const CollisionBody& body, const RigidTransform& X) {
    if (!body.convex()) return (X * body.boundCenter()).z() - body.boundRadius();
    return (X * body.support(X.R.transpose() * -Vector3d::UnitZ())).z() - body.radius();
  }

  void exclude(int a, const std::string& name_a, int b, const std::string& name_b) {
    if (excluded_.insert(std::minmax(a, b)).second) shapes_.exclude(name_a, name_b);
  }

  const MadeJoint& madeJoint(const FrameData& frame) const {
    return *std::find_if(made_joints_.begin(), made_joints_.end(),
                         [&](const MadeJoint& j) { return j.frame == &frame; });
  }

  static std::string jointName(const FrameData& frame, std::size_t step) { return cat("j", frame.id, "_", step); }

  /// Joints that mimic others.
  void couple() {
    for (const MadeJoint& joint : made_joints_) {
      if (!joint.frame->joint->mimic) continue;
      const FrameData& source = dofSource(*joint.frame);
      for (std::size_t i = 0; i < joint.steps.size(); ++i) {
        if (!isScalar(joint.steps[i].first)) continue;
        mjsEquality* equality = mj_.mjs_addEquality(spec_.get(), nullptr);
        equality->type = mjEQ_JOINT;
        equality->objtype = mjOBJ_JOINT;
        mj_.mjs_setString(equality->name1, jointName(*joint.frame, i).c_str());
        mj_.mjs_setString(equality->name2, jointName(source, i).c_str());
        equality->data[1] = ratio(*joint.frame, source);
        const double solref[] = {.005, 1.}, solimp[] = {.95, .99, .001, .5, 2.};
        std::copy_n(solref, 2, equality->solref);
        std::copy_n(solimp, 5, equality->solimp);
        ++model_.first_weld;
      }
    }
  }

  static double ratio(const FrameData& follower, const FrameData& source) {
    return motionScale(follower) / motionScale(source);
  }

  std::vector<const FrameData*> followersOf(const FrameData& source) const {
    std::vector<const FrameData*> found;
    for (const MadeJoint& joint : made_joints_) {
      if (joint.frame->joint->mimic && &dofSource(*joint.frame) == &source) found.push_back(joint.frame);
    }
    return found;
  }

  void addGrippers() {
    for (const MadeJoint& joint : made_joints_) {
      if (joint.frame->joint->mimic || !isFingerJoint(*joint.frame)) continue;
      const std::vector<const FrameData*> followers = followersOf(*joint.frame);
      if (followers.empty()) continue;
      std::vector<const FrameData*> all{joint.frame};
      all.insert(all.end(), followers.begin(), followers.end());
      const std::string name = cat("t", joint.frame->id);
      mjsTendon* tendon = mj_.mjs_addTendon(spec_.get(), nullptr);
      mj_.mjs_setName(tendon->element, name.c_str());
      GripperJoint gripper;
      gripper.followers = int(followers.size());
      gripper.coefficient = 1. / double(all.size());
      for (const FrameData* each : all)
        mj_.mjs_wrapJoint(tendon, jointName(*each, 0).c_str(), gripper.coefficient / ratio(*each, *joint.frame));
      const double lever = joint.steps[0].second->type == mjJNT_SLIDE ? 1. : kGripLever * kGripLever;
      mjsActuator* actuator = mj_.mjs_addActuator(spec_.get(), nullptr);
      mj_.mjs_setName(actuator->element, name.c_str());
      actuator->trntype = mjTRN_TENDON;
      mj_.mjs_setString(actuator->target, name.c_str());
      actuator->gaintype = mjGAIN_FIXED;
      actuator->biastype = mjBIAS_AFFINE;
      actuator->gainprm[0] = gripper.stiffness = lever * kGripStiffness;
      actuator->biasprm[1] = -gripper.stiffness;
      actuator->biasprm[2] = -lever * kGripDamping;
      model_.grippers.push_back(gripper);
      gripper_frames_.push_back(all);
    }
  }

  void addWelds() {
    if (made_bodies_.size() < 2) return;
    model_.welds = kWelds;
    for (int i = 0; i < kWelds; ++i) {
      mjsEquality* weld = mj_.mjs_addEquality(spec_.get(), nullptr);
      weld->type = mjEQ_WELD;
      weld->objtype = mjOBJ_BODY;
      mj_.mjs_setString(weld->name1, "world");
      mj_.mjs_setString(weld->name2, bodyName(1).c_str());
      weld->active = 0;
      const double solref[] = {.004, 1.}, solimp[] = {.99, .999, .001, .5, 2.};
      std::copy_n(solref, 2, weld->solref);
      std::copy_n(solimp, 5, weld->solimp);
    }
  }

  void addSensor(mjtSensor type, const std::string& site) {
    mjsSensor* sensor = mj_.mjs_addSensor(spec_.get());
    mj_.mjs_setName(sensor->element, cat("n", made_sensors_.size()).c_str());
    sensor->type = type;
    sensor->objtype = mjOBJ_SITE;
    mj_.mjs_setString(sensor->objname, site.c_str());
    made_sensors_.push_back(sensor);
  }

  void addSensors() {
    const auto site = [&](int frame, const char* letter) {
      const PlacedFrame& placed = model_.scene.frames[std::size_t(frame)];
      mjsSite* made = mj_.mjs_addSite(made_bodies_[std::size_t(placed.body)], nullptr);
      const std::string name = cat(letter, frame);
      mj_.mjs_setName(made->element, name.c_str());
      std::copy_n(placed.X_BF.p.data(), 3, made->pos);
      std::copy_n(wxyz(placed.X_BF.q).data(), 4, made->quat);
      return name;
    };
    for (const int frame : extras_.forces) {
      const std::string name = site(frame, "f");
      addSensor(mjSENS_FORCE, name);
      addSensor(mjSENS_TORQUE, name);
      model_.force_sensors.push_back({frame, 0, 6});
    }
    for (const int frame : extras_.accelerations) {
      addSensor(mjSENS_ACCELEROMETER, site(frame, "a"));
      model_.accelerometers.push_back({frame, 0, 3});
    }
  }

  void compile() {
    model_.model = PhysicsModel(mj_.mj_compile(spec_.get(), nullptr), mj_.mj_deleteModel);
    if (!model_.model) throw ValueError(cat("Simulation: ", mj_.mjs_getError(spec_.get())));
    mjModel& m = *model_.model;
    m.flg_surfacevel = 1;
    model_.body_of_id.assign(std::size_t(m.nbody), 0);
    for (std::size_t b = 0; b < made_bodies_.size(); ++b) {
      model_.body_id.push_back(mj_.mjs_getId(made_bodies_[b]->element));
      model_.body_of_id[std::size_t(model_.body_id.back())] = int(b);
    }
    model_.geom_frame.assign(std::size_t(m.ngeom), -1);
    for (const ModelShapes::Geom& geom : shapes_.geoms)
      model_.geom_frame[std::size_t(mj_.mjs_getId(geom.spec->element))] = geom.frame;
    indexFree(m);
    indexJoints(m);
    indexGrippers(m);
    for (std::size_t i = 0, s = 0; i < model_.force_sensors.size(); ++i, s += 2)
      model_.force_sensors[i].address = m.sensor_adr[mj_.mjs_getId(made_sensors_[s]->element)];
    for (std::size_t i = 0; i < model_.accelerometers.size(); ++i)
      model_.accelerometers[i].address =
          m.sensor_adr[mj_.mjs_getId(made_sensors_[2 * model_.force_sensors.size() + i]->element)];
  }

  void indexFree(const mjModel& m) {
    for (std::size_t b = 1; b < model_.scene.bodies.size(); ++b) {
      if (model_.scene.bodies[b].kind != SceneBody::Kind::free) continue;
      const int joint = m.body_jntadr[model_.body_id[b]];
      model_.free_frames.push_back(model_.scene.bodies[b].frame->id);
      model_.free_qpos.push_back(m.jnt_qposadr[joint]);
      model_.free_dof.push_back(m.jnt_dofadr[joint]);
    }
  }

  ModelStep indexed(const mjModel& m, const std::pair<MotionKind, mjsJoint*>& step) const {
    if (!step.second) return {step.first, -1, -1};
    const int id = mj_.mjs_getId(step.second->element);
    return {step.first, m.jnt_qposadr[id], m.jnt_dofadr[id]};
  }

  void indexJoints(const mjModel& m) {
    for (const MadeJoint& made : made_joints_) {
      const FrameData& frame = *made.frame;
      const FrameData& source = dofSource(frame);
      if (frame.joint->mimic) {
        const MadeJoint& from = madeJoint(source);
        for (std::size_t i = 0; i < made.steps.size(); ++i) {
          if (!isScalar(made.steps[i].first)) continue;
          const ModelStep a = indexed(m, made.steps[i]), b = indexed(m, from.steps[i]);
          model_.followers.push_back({a.qpos, a.dof, b.qpos, b.dof, ratio(frame, source)});
        }
        continue;
      }
      ModelJoint joint;
      joint.frame = frame.id;
      joint.dofs = frame.joint->dofs();
      joint.scale = motionScale(frame);
      if (frame.joint->active) joint.first_q = program_.frame_dofs[std::size_t(frame.id)].first;
      for (const auto& step : made.steps) joint.steps.push_back(indexed(m, step));
      model_.joints.push_back(joint);
      const bool gripper = isFingerJoint(frame) && !followersOf(frame).empty();
      if (!gripper && !attributeFlag(frame, "noMotor", false)) addDrives(frame);
    }
  }

  void addDrives(const FrameData& frame) {
    const ModelJoint& joint = model_.joints.back();
    int q = 0;
    for (std::size_t i = 0; i < joint.steps.size(); ++i) {
      const ModelStep& step = joint.steps[i];
      if (step.dof >= 0) {
        Drive drive;
        drive.joint = int(model_.joints.size()) - 1;
        drive.qpos = step.qpos;
        drive.dof = step.dof;
        drive.q = joint.first_q < 0 ? -1 : joint.first_q + q;
        drive.kind = step.kind;
        drive.scale = joint.scale;
        setMotor(drive, frame);
        model_.drives.push_back(drive);
      }
      q += frame.joint->steps[i].dofs();
    }
  }

  static void setMotor(Drive& drive, const FrameData& frame) {
    const Node* node = frame.attributes->find("ctrl_limits");
    const NumberArray* limits = node ? node->value.as<NumberArray>() : nullptr;
    const auto limit = [&](std::size_t i) {
      return limits && limits->numbers.size() > i && limits->numbers[i] > 0. ? limits->numbers[i] : kInfinite;
    };
    drive.velocity = limit(0);
    drive.effort = std::min(limit(1), attributeNumber(frame, "motorLimit", kInfinite));
    if (frame.attributes->find("motorLambda")) {
      const double lambda = attributeNumber(frame, "motorLambda", 1.), mass = attributeNumber(frame, "motorMass", 1.);
      if (!(lambda > 0.)) throw ValueError(cat("Simulation: frame '", frame.name, "': motorLambda must be positive"));
      drive.gains = {mass / (lambda * lambda), 2. * mass / lambda};
    } else if (frame.attributes->find("motorKp")) {
      drive.gains = {attributeNumber(frame, "motorKp", 0.), attributeNumber(frame, "motorKd", 0.)};
      if (!(drive.gains->first >= 0.) || !(drive.gains->second >= 0.))
        throw ValueError(cat("Simulation: frame '", frame.name, "': motorKp and motorKd must not be negative"));
    }
  }

  void indexGrippers(const mjModel& m) {
    for (std::size_t g = 0; g < model_.grippers.size(); ++g) {
      GripperJoint& gripper = model_.grippers[g];
      const FrameData& frame = *gripper_frames_[g].front();
      gripper.actuator = int(g);
      for (std::size_t j = 0; j < model_.joints.size(); ++j) {
        if (model_.joints[j].frame == frame.id) gripper.joint = int(j);
      }
      for (const FrameData* each : gripper_frames_[g]) {
        const ModelStep step = indexed(m, madeJoint(*each).steps[0]);
        gripper.qpos.push_back(step.qpos);
        gripper.dof.push_back(step.dof);
        gripper.ratio.push_back(ratio(*each, frame));
      }
      const mjsJoint* joint = madeJoint(frame).steps[0].second;
      gripper.lower = joint->limited == mjLIMITED_TRUE ? joint->range[0] : -kInfinite;
      gripper.upper = joint->limited == mjLIMITED_TRUE ? joint->range[1] : kInfinite;
    }
  }

  const Physics& mj_ = physics();
  SceneTree& scene_;
  const Program& program_;
  const SimulationOptions& options_;
  const ModelExtras& extras_;
  std::unique_ptr<mjSpec, decltype(&::mj_deleteSpec)> spec_;
  ModelShapes shapes_;
  SceneModel model_;
  std::vector<mjsBody*> made_bodies_;
  std::vector<MadeJoint> made_joints_;
  std::vector<std::vector<const FrameData*>> gripper_frames_;
  std::vector<mjsSensor*> made_sensors_;
  std::set<std::pair<int, int>> excluded_;
};

}  // namespace

SceneModel makeSceneModel(SceneTree& scene, const SimulationOptions& options, const ModelExtras& extras) {
  return ModelMaker(scene, options, extras).make();
}

}  // namespace kinegraph
