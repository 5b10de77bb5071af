#include "kinegraph/simulation/scene_model.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/simulation/model_index.h"
#include "kinegraph/simulation/model_shapes.h"

namespace kinegraph::inline simulation_internal {

namespace {

constexpr int kWelds = 32;                ///< equalities reserved for attach
constexpr double kOverlap = 1e-3;         ///< m: pairs of one tree that overlap more at the start never collide
constexpr double kGripStiffness = 2000.;  ///< N/m; the damping is in N s/m
constexpr double kGripDamping = 60.;
constexpr double kRestSpeed = 1e-5;  ///< m/s: bodies that are slower for ten inner steps fall asleep
constexpr double kLocked = 1e-4;     ///< rad or m, to both sides: range of a joint with equal limits
constexpr double kGripLever = .1;    ///< m: converts both to values of rotating fingers

class ModelMaker {
 public:
  ModelMaker(SceneTree& scene, const SimulationOptions& options, const ModelExtras& extras)
      : scene_(scene),
        kinematics_(*scene.model()),
        options_(options),
        extras_(extras),
        spec_(mj_.mj_makeSpec(), mj_.mj_deleteSpec),
        shapes_(spec_.get(), options) {}

  SceneModel make() {
    model_.scene = divideScene(scene_, extras_.forces);
    model_.dofs = kinematics_.dofs;
    setOptions();
    addBodies();
    addShapes();
    excludeOverlaps();
    shapes_.addPairs(kinematics_.contacts, model_.scene.declared, excluded_, extras_.can_change_frictions);
    couple();
    addGrippers();
    addWelds();
    addSensors();
    compile();
    return std::move(model_);
  }

 private:
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
    option.sleep_tolerance = kRestSpeed;
    spec_->compiler.degree = 0;
    spec_->compiler.balanceinertia = 1;
    spec_->compiler.boundmass = 1e-6;
    spec_->compiler.boundinertia = 1e-9;
    spec_->memory = mjtSize(4 << 20) + mjtSize(200 << 10) * mjtSize(model_.scene.bodies.size());
  }

  void addBodies() {
    parts_.bodies.push_back(mj_.mjs_findBody(spec_.get(), "world"));
    for (std::size_t b = 1; b < model_.scene.bodies.size(); ++b) {
      const SceneBody& body = model_.scene.bodies[b];
      mjsBody* made = mj_.mjs_addBody(parts_.bodies[std::size_t(body.parent)], nullptr);
      mj_.mjs_setName(made->element, bodyName(int(b)).c_str());
      std::copy_n(body.X_PB.p.data(), 3, made->pos);
      std::copy_n(wxyz(body.X_PB.q).data(), 4, made->quat);
      made->gravcomp = body.has_gravity ? attributeNumber(*body.frame, "gravityCompensation", 0.) : 1.;
      setInertia(*made, body.inertia);
      parts_.bodies.push_back(made);
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
    ModelParts::MadeJoint made{&frame, {}};
    int q = 0;
    for (std::size_t i = 0; i < joint.steps.size(); ++i) {
      const MotionStep& step = joint.steps[i];
      mjsJoint* m = nullptr;
      if (step.moves()) {
        m = mj_.mjs_addJoint(body, nullptr);
        mj_.mjs_setName(m->element, cat("j", frame.id, "_", i).c_str());
        m->type = step.translates() ? mjJNT_SLIDE : step.kind == MotionKind::quaternion ? mjJNT_BALL : mjJNT_HINGE;
        const Vector3d axis = step.kind == MotionKind::circle ? Vector3d(Vector3d::UnitZ())
                                                              : Vector3d(step.sign * step.direction(joint.axis));
        if (m->type != mjJNT_BALL) std::copy_n(axis.data(), 3, m->axis);
        m->armature = attributeNumber(frame, "armature", driven ? options_.armature : 0.);
        m->damping[0] = attributeNumber(frame, "angularDamping", 0.);
        m->frictionloss = attributeNumber(frame, "jointFriction", 0.);
        m->stiffness[0] = attributeNumber(frame, "springStiffness", 0.);
        m->springref = scale * attributeNumber(frame, "springReference", 0.);
        if (isScalar(step.kind) && source.lower.size() > q && source.upper[q] >= source.lower[q])
          setLimits(*m, scale * source.lower[q], scale * source.upper[q]);
      }
      made.steps.emplace_back(step.kind, m);
      q += step.dofs();
    }
    parts_.joints.push_back(made);
  }

  static void setLimits(mjsJoint& m, double a, double b) {
    if (!std::isfinite(a) || !std::isfinite(b)) return;
    m.limited = mjLIMITED_TRUE;
    m.range[0] = std::min(a, b);
    m.range[1] = std::max(a, b);
    if (a == b) m.range[0] -= kLocked, m.range[1] += kLocked;  // MuJoCo needs a range
    m.solref_limit[0] = m.type == mjJNT_SLIDE ? .004 : .01;
  }

  void addShapes() {
    if (hasGround()) shapes_.addGround();
    for (const auto& frame : scene_.frames()) {
      const PlacedFrame& placed = model_.scene.frames[std::size_t(frame->id)];
      if (!placed.collides) continue;
      mjsBody* body = parts_.bodies[std::size_t(placed.body)];
      Pose X_BF = placed.X_BF;
      if (placed.body == 0) {
        body = mj_.mjs_addBody(body, nullptr);
        mj_.mjs_setName(body->element, fixedName(frame->id).c_str());
      }
      shapes_.body_number = placed.body == 0 ? fixedBody(frame->id) : placed.body;
      shapes_.body_name = placed.body == 0 ? fixedName(frame->id) : bodyName(placed.body);
      shapes_.body_moves = moves(placed.body);
      shapes_.add(*frame, body, X_BF, placed.robot);
    }
  }

  /// Returns whether the plane z = 0 is added: scenes with planes of their own do not need it.
  bool hasGround() const {
    return options_.ground && std::none_of(scene_.frames().begin(), scene_.frames().end(), [&](const auto& frame) {
             return model_.scene.frames[std::size_t(frame->id)].collides &&
                    frame->shape->geometry->type == ShapeType::plane;
           });
  }

  static std::string fixedName(int frame) { return cat("s", frame); }

  bool moves(int body) const {
    while (body > 0 && model_.scene.bodies[std::size_t(body)].kind == SceneBody::Kind::fixed)
      body = model_.scene.bodies[std::size_t(body)].parent;
    return body > 0;
  }

  struct Placed {
    const FrameData *frame, *root;
    int body, robot;
    SceneBody::Kind kind;
    RigidTransform X;
    bool isLink() const { return kind == SceneBody::Kind::jointed || kind == SceneBody::Kind::fixed; }
  };

  /// Returns the shapes that collide, in the scene's present state.
  std::vector<Placed> placedShapes() const {
    std::vector<Placed> all;
    for (const auto& frame : scene_.frames()) {
      const PlacedFrame& placed = model_.scene.frames[std::size_t(frame->id)];
      if (!placed.collides) continue;
      const FrameData* root = frame.get();
      while (root->parent) root = root->parent;
      all.push_back({frame.get(), root, placed.body == 0 ? fixedBody(frame->id) : placed.body, placed.robot,
                     model_.scene.bodies[std::size_t(placed.body)].kind, scene_.worldPose(*frame).transform()});
    }
    return all;
  }

  /// Excludes links of robots that overlap parts of their tree, or the ground.
  void excludeOverlaps() {
    const std::vector<Placed> all = placedShapes();
    if (hasGround()) warnOfSunkenRobots(all);
    for (const Placed& a : all) {
      if (!a.isLink()) continue;
      const CollisionBody& body = *a.frame->shape->body();
      if (hasGround() && lowest(body, a.X) < -kOverlap) exclude(kGroundBody, "ground", a.body, bodyName(a.body));
      for (const Placed& b : all) {
        if (a.root != b.root || (a.robot == b.robot && (a.robot < 0 || model_.scene.declared[std::size_t(a.robot)])))
          continue;
        if (b.kind == SceneBody::Kind::free ? !isAbove(b.body, a.body) : b.body > 0 && b.frame->id < a.frame->id)
          continue;
        const double apart = (a.X * body.boundCenter() - b.X * b.frame->shape->body()->boundCenter()).norm() -
                             body.boundRadius() - b.frame->shape->body()->boundRadius();
        if (apart > 0. || proximity(body, a.X, *b.frame->shape->body(), b.X).distance > -kOverlap) continue;
        exclude(a.body, bodyName(a.body), b.body, b.body < 0 ? fixedName(b.frame->id) : bodyName(b.body));
      }
    }
  }

  /// Tells by how much to raise floating robots of which a link begins below the ground.
  void warnOfSunkenRobots(const std::vector<Placed>& all) {
    struct Sunken {
      const FrameData* link = nullptr;
      double link_height = 0., height = 0.;  // m: of the lowest link, and of all shapes with those of the base
    };
    std::map<int, Sunken> robots;  // by base
    for (const Placed& shape : all) {
      const int base = floatingBase(shape.body);
      if (base <= 0) continue;
      Sunken& robot = robots[base];
      const double z = lowest(*shape.frame->shape->body(), shape.X);
      robot.height = std::min(robot.height, z);
      if (shape.isLink() && z < std::min(-kOverlap, robot.link_height)) robot.link = shape.frame, robot.link_height = z;
    }
    for (const auto& [base, robot] : robots) {
      if (!robot.link) continue;
      model_.scene.warnings.push_back(cat("Simulation: '", robot.link->name, "' of a floating robot begins ",
                                          numberText(-robot.link_height, 3),
                                          " m below the ground, through which it falls; raise the robot's base by ",
                                          numberText(-robot.height, 3), " m or more"));
    }
  }

  /// Returns the body at or above one that moves freely, the base of a floating robot; 0 or less if there is none.
  int floatingBase(int body) const {
    while (body > 0 && model_.scene.bodies[std::size_t(body)].kind != SceneBody::Kind::free)
      body = model_.scene.bodies[std::size_t(body)].parent;
    return body;
  }

  /// Returns whether a body carries another one.
  bool isAbove(int carrier, int body) const {
    while (body > carrier) body = model_.scene.bodies[std::size_t(body)].parent;
    return body == carrier;
  }

  static double lowest(const CollisionBody& body, const RigidTransform& X) {
    if (!body.convex()) return (X * body.boundCenter()).z() - body.boundRadius();
    return (X * body.support(X.R.transpose() * -Vector3d::UnitZ())).z() - body.radius();
  }

  void exclude(int a, const std::string& name_a, int b, const std::string& name_b) {
    if (excluded_.insert(std::minmax(a, b)).second) shapes_.exclude(name_a, name_b);
  }

  static std::string jointName(const FrameData& frame, std::size_t step) { return cat("j", frame.id, "_", step); }

  /// Couples joints to those that they mimic.
  void couple() {
    for (const ModelParts::MadeJoint& joint : parts_.joints) {
      if (!joint.frame->joint->mimic) continue;
      const FrameData& source = dofSource(*joint.frame);
      for (std::size_t i = 0; i < joint.steps.size(); ++i) {
        if (!isScalar(joint.steps[i].first)) continue;
        mjsEquality* equality = mj_.mjs_addEquality(spec_.get(), nullptr);
        equality->type = mjEQ_JOINT;
        equality->objtype = mjOBJ_JOINT;
        mj_.mjs_setString(equality->name1, jointName(*joint.frame, i).c_str());
        mj_.mjs_setString(equality->name2, jointName(source, i).c_str());
        equality->data[1] = motionRatio(*joint.frame, source);
        const double solref[] = {.005, 1.}, solimp[] = {.95, .99, .001, .5, 2.};
        std::copy_n(solref, 2, equality->solref);
        std::copy_n(solimp, 5, equality->solimp);
        ++model_.first_weld;
      }
    }
  }

  void addGrippers() {
    for (const ModelParts::MadeJoint& joint : parts_.joints) {
      if (joint.frame->joint->mimic || !isFingerJoint(*joint.frame)) continue;
      const std::vector<const FrameData*> followers = parts_.followersOf(*joint.frame);
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
        mj_.mjs_wrapJoint(tendon, jointName(*each, 0).c_str(), gripper.coefficient / motionRatio(*each, *joint.frame));
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
      parts_.grippers.push_back(all);
    }
  }

  void addWelds() {
    if (parts_.bodies.size() < 2) return;
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
    mj_.mjs_setName(sensor->element, cat("n", parts_.sensors.size()).c_str());
    sensor->type = type;
    sensor->objtype = mjOBJ_SITE;
    mj_.mjs_setString(sensor->objname, site.c_str());
    parts_.sensors.push_back(sensor);
  }

  void addSensors() {
    const auto site = [&](int frame, const char* letter) {
      const PlacedFrame& placed = model_.scene.frames[std::size_t(frame)];
      mjsSite* made = mj_.mjs_addSite(parts_.bodies[std::size_t(placed.body)], nullptr);
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
    model_.model->flg_surfacevel = 1;
    chooseSleepers();
    indexModel(parts_, shapes_.geoms, kinematics_, model_);
  }

  /// Lets free bodies sleep. Links do not: a pendulum may be slow at a point where it does not stay.
  void chooseSleepers() {
    mjModel& m = *model_.model;
    for (int tree = 0; tree < m.ntree; ++tree) {
      const bool is_free = m.tree_dofnum[tree] == 6 && m.jnt_type[m.dof_jntid[m.tree_dofadr[tree]]] == mjJNT_FREE;
      m.tree_sleep_policy[tree] = is_free ? mjSLEEP_ALLOWED : mjSLEEP_NEVER;
    }
  }

  const Physics& mj_ = physics();
  SceneTree& scene_;
  const KinematicModel& kinematics_;
  const SimulationOptions& options_;
  const ModelExtras& extras_;
  std::unique_ptr<mjSpec, decltype(&::mj_deleteSpec)> spec_;
  ModelShapes shapes_;
  SceneModel model_;
  ModelParts parts_;
  std::set<std::pair<int, int>> excluded_;
};

}  // namespace

SceneModel makeSceneModel(SceneTree& scene, const SimulationOptions& options, const ModelExtras& extras) {
  return ModelMaker(scene, options, extras).make();
}

}  // namespace kinegraph::inline simulation_internal
