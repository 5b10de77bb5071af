#include "kinegraph/scene/config.h"
#include "kinegraph/collision/edge_check.h"
#include "kinegraph/scene/tree/contact_warnings.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/gfile/parser.h"
#include "kinegraph/scene/floating_base.h"
#include "kinegraph/scene/loading/reader.h"
#include "kinegraph/scene/loading/robot_semantics.h"
#include "kinegraph/scene/tree/inertia_edits.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

Config::Config() : Config(std::make_shared<SceneTree>()) {}

Config::Config(const SceneTree& scene) : Config() { scene_->append(scene, ""); }

Config::Config(const Config& other) : Config(*other.scene_) { file_warnings_ = other.file_warnings_; }

Config& Config::operator=(const Config& other) {
  if (this != &other) {
    Config copy(other);
    if (scene_) copy.scene_->viewer = std::exchange(scene_->viewer, nullptr);  // it continues, with the assigned scene
    *this = std::move(copy);
  }
  return *this;
}

namespace {

/// Returns a warning that lists the names of `added` already present in `scene`, or "" if there are none.
std::string duplicatesWarning(SceneTree& scene, const SceneTree& added, const std::string& prefix,
                              std::string_view file) {
  std::vector<std::string> twice;
  for (const std::string& name : added.names()) {
    if (!name.empty() && scene.find(prefix + name)) twice.push_back(prefix + name);
  }
  if (twice.empty()) return "";
  const std::size_t count = twice.size();
  twice.resize(std::min<std::size_t>(count, 3));
  return cat(file, ": duplicate frame names: ", count, " (", join(twice), count > 3 ? ", ..." : "",
             "); a look-up by name finds the first frame; pass a prefix to keep the names distinct");
}

}  // namespace

std::vector<std::string> Config::getFrameNames() const { return scene_->names(); }
int Config::getFrameDimension() const { return int(scene_->frames().size()); }
int Config::getJointDimension() const { return scene_->model()->dofs; }
VectorXd Config::getJointState() const { return scene_->jointState(); }
const std::vector<LinkInertia>& Config::inertias() const { return scene_->inertias(); }
std::pair<double, Vector3d> Config::centerOfMass() const {
  return kinegraph::centerOfMass(scene_->state(), inertias());
}
std::vector<std::pair<int, int>> Config::getCollidablePairs() const { return scene_->model()->collidable(); }
std::shared_ptr<const KinematicModel> Config::model() const { return scene_->model(); }
std::shared_ptr<const Parameters> Config::parameters() const { return scene_->parameters(); }
const State& Config::state() const { return scene_->state(); }

void Config::clear() {
  scene_->clear();
  file_warnings_.clear();
}

void Config::keepWarnings(const std::vector<std::string>& warnings) {
  for (std::vector<std::string>* list : {&warnings_, &file_warnings_})
    list->insert(list->end(), warnings.begin(), warnings.end());
}

std::optional<Frame> Config::addFile(const std::string& path, const std::string& prefix, const FileOptions& options) {
  std::vector<std::string> warnings;
  if (isSemanticsFile(path)) {
    readSemanticsFile(path, prefix, *scene_, warnings, options);
    keepWarnings(warnings);
    return std::nullopt;
  }
  SceneTree scratch;
  readSceneFile(path, scratch, warnings, options);
  if (options.floating) checkFloatingRoot(scratch, path);
  const std::optional<Frame> first = appendFile(scratch, prefix, path, std::move(warnings));
  if (first && options.floating) makeFloating(*first, prefix);
  return first;
}

std::optional<Frame> Config::addText(std::string_view text, const std::string& name, const std::string& folder,
                                     bool strict) {
  SceneTree scratch;
  std::vector<std::string> warnings;
  readSceneText(text, name, folder, scratch, warnings, strict);
  return appendFile(scratch, "", name, std::move(warnings));
}

std::optional<Frame> Config::appendFile(const SceneTree& scratch, const std::string& prefix, const std::string& file,
                                        std::vector<std::string> warnings) {
  if (std::string warning = duplicatesWarning(*scene_, scratch, prefix, file); !warning.empty())
    warnings.push_back(std::move(warning));
  keepWarnings(warnings);
  FrameData* first = scene_->append(scratch, prefix);
  if (!first) return std::nullopt;
  return Frame(scene_, *first);
}

namespace {

/// A script or a notebook cell that runs again may add a frame twice. A request that differs from the existing frame is
/// an error.
void checkSameRequest(const FrameData& existing, const FrameData* parent, const std::string& attributes) {
  const FrameData* above = existing.parent;
  while (above && (above->name == existing.name + "_origin" || above->name == "|" + existing.name))
    above = above->parent;  // skips the frames that `pre` and `post` inserted
  std::string difference;
  if (parent && above != parent) {
    difference = cat(above ? cat("below '", above->name, "'") : "without a parent", ", not below '", parent->name, "'");
  } else if (!attributes.empty() && parse(attributes, cat("addFrame('", existing.name, "')")) != *existing.attributes) {
    difference = "with other attributes";
  }
  if (difference.empty()) return;
  int number = 2;
  while (existing.tree->find(cat(existing.name, "_", number))) ++number;
  throw ValueError(cat("addFrame: a frame named '", existing.name, "' already exists, ", difference,
                       "; choose another name (such as '", existing.name, "_", number, "'), or call delFrame('",
                       existing.name, "') first"));
}

}  // namespace

Frame Config::addFrame(const std::string& name, const std::string& parent, const std::string& attributes) {
  return addFrameBelow(name, parent.empty() ? nullptr : &scene_->get(parent, cat("addFrame('", name, "'): parent")),
                       attributes);
}

Frame Config::addFrame(const std::string& name, const Frame& parent, const std::string& attributes) {
  return addFrameBelow(name, &ownFrame(parent, "addFrame"), attributes);
}

Frame Config::addFrameBelow(const std::string& name, FrameData* parent, const std::string& attributes) {
  if (FrameData* existing = name.empty() ? nullptr : scene_->find(name)) {
    checkSameRequest(*existing, parent, attributes);
    warnings_.push_back(cat("addFrame: a frame named '", name, "' already exists and is returned unchanged"));
    return Frame(scene_, *existing);
  }
  FrameData& frame = scene_->add(name, parent);
  try {
    if (!attributes.empty()) readAttributes(attributes, std::filesystem::current_path().string(), frame, warnings_);
  } catch (...) {
    scene_->remove(frame);
    throw;
  }
  return Frame(scene_, frame);
}

std::optional<Frame> Config::addConfigurationCopy(const Config& other, const std::string& prefix) {
  FrameData* first = scene_->append(*other.scene_, prefix);
  if (!first) return std::nullopt;
  return Frame(scene_, *first);
}

void Config::delFrame(const std::string& name) { scene_->remove(scene_->get(name, "delFrame")); }

void Config::delFrame(const Frame& frame) { scene_->remove(ownFrame(frame, "delFrame")); }

FrameData& Config::ownFrame(const Frame& frame, const char* call) const {
  if (frame.scene() == scene_.pointer()) return frame.data();
  throw ValueError(cat(call, ": frame '", frame.getName(), "' belongs to another configuration"));
}

void Config::attach(const std::string& parent, const std::string& child) {
  FrameData& target = scene_->get(parent, "attach");
  FrameData* top = &scene_->get(child, "attach");
  while (!top->joint && top->parent) top = top->parent;
  const FrameData* above = &target;
  while (above && above != top) above = above->parent;
  if (above && top->name != child) {
    throw ValueError(cat("attach: '", child, "' has no joint and is fixed to '", top->name, "', which also carries '",
                         parent,
                         "'; give it its own joint first, such as setJoint(JointType::rigid), to move it alone"));
  }
  const Pose world = scene_->worldPose(*top);
  const std::optional<Joint> former_joint = top->joint;
  FrameData* former_parent = top->parent;
  const Pose former_pose = top->pose;
  if (top->parent) scene_->unlink(*top);
  top->joint = Joint(JointType::rigid);
  try {
    scene_->link(*top, target);
  } catch (const Error&) {
    top->joint = former_joint;
    top->pose = former_pose;
    if (former_parent) scene_->link(*top, *former_parent);
    throw;
  }
  Frame(scene_, *top).setPose(world);
}

Frame Config::readOnly(FrameData& frame) const {
  Frame handle(scene_, frame);
  handle.is_const_ = true;
  return handle;
}

Frame Config::getFrame(std::string_view name) { return Frame(scene_, scene_->get(name, "getFrame")); }
Frame Config::getFrame(std::string_view name) const { return readOnly(scene_->get(name, "getFrame")); }

std::optional<Frame> Config::findFrame(std::string_view name) {
  FrameData* frame = scene_->find(name);
  return frame ? std::optional(Frame(scene_, *frame)) : std::nullopt;
}

std::optional<Frame> Config::findFrame(std::string_view name) const {
  FrameData* frame = scene_->find(name);
  return frame ? std::optional(readOnly(*frame)) : std::nullopt;
}

Frame Config::getFrame(int id) const {
  if (id < 0 || id >= getFrameDimension()) {
    throw ValueError(cat("getFrame: id ", id, " is not in 0..", getFrameDimension() - 1));
  }
  return readOnly(*scene_->frames()[std::size_t(id)]);
}

Frame Config::getFrame(int id) { return editable({std::as_const(*this).getFrame(id)}).front(); }

namespace {

bool isRoot(const FrameData& frame) { return !frame.parent; }
bool hasActiveJoint(const FrameData& frame) { return frame.moves() && dofSource(frame).joint->active; }

}  // namespace

std::vector<Frame> Config::framesThat(bool (*apply)(const FrameData&)) const {
  std::vector<Frame> frames;
  for (const auto& frame : scene_->frames())
    if (!apply || apply(*frame)) frames.push_back(readOnly(*frame));
  return frames;
}

std::vector<Frame> Config::editable(std::vector<Frame> frames) {
  for (Frame& frame : frames) frame.is_const_ = false;
  return frames;
}

std::vector<Frame> Config::getFrames() const { return framesThat(nullptr); }
std::vector<Frame> Config::getFrames() { return editable(framesThat(nullptr)); }
std::vector<Frame> Config::getRoots() const { return framesThat(isRoot); }
std::vector<Frame> Config::getRoots() { return editable(framesThat(isRoot)); }
std::vector<Frame> Config::getJoints() const { return framesThat(hasActiveJoint); }
std::vector<Frame> Config::getJoints() { return editable(framesThat(hasActiveJoint)); }

MatrixXd Config::getFrameState() const {
  const State& state = scene_->state();
  MatrixXd poses(getFrameDimension(), 7);
  for (int i = 0; i < poses.rows(); ++i) {
    poses.row(i) = Pose(state.pose(i)).canonical().numbers();
  }
  return poses;
}

void Config::setFrameState(const MatrixXd& poses, const std::vector<std::string>& names) {
  std::vector<Frame> frames;
  for (const std::string& name : names) frames.push_back(Frame(scene_, scene_->get(name, "setFrameState")));
  if (names.empty()) frames = getFrames();
  if (poses.rows() != Eigen::Index(frames.size()) || poses.cols() != 7) {
    throw ValueError(cat("setFrameState: got ", poses.rows(), " x ", poses.cols(), " numbers; expected ", frames.size(),
                         " x 7, one pose x y z qw qx qy qz per frame"));
  }
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].setPose(Pose::fromNumbers(poses.row(i).transpose()));
}

namespace {

void checkVelocity(const Eigen::Ref<const VectorXd>& velocity, int dofs, const char* call) {
  if (velocity.size() != dofs || !velocity.allFinite()) {
    throw ValueError(
        cat("Config::", call, ": got ", velocity.size(), " numbers; expected ", dofs, " finite ones, one per dof"));
  }
}

}  // namespace

EquationOfMotion Config::equationOfMotion(const VectorXd& velocity) const {
  checkVelocity(velocity, getJointDimension(), "equationOfMotion");
  return kinegraph::equationOfMotion(scene_->state(), inertias(), velocity);
}

VectorXd Config::inverseDynamics(const VectorXd& velocity, const VectorXd& acceleration) const {
  checkVelocity(velocity, getJointDimension(), "inverseDynamics");
  checkVelocity(acceleration, getJointDimension(), "inverseDynamics");
  return kinegraph::inverseDynamics(scene_->state(), inertias(), velocity, acceleration);
}

void Config::inverseDynamics(const Eigen::Ref<const VectorXd>& velocity, const Eigen::Ref<const VectorXd>& acceleration,
                             Eigen::Ref<VectorXd> forces) const {
  checkVelocity(velocity, getJointDimension(), "inverseDynamics");
  checkVelocity(acceleration, getJointDimension(), "inverseDynamics");
  if (forces.size() != getJointDimension())
    throw ValueError(cat("Config::inverseDynamics: there is room for ", forces.size(), " forces; expected ",
                         getJointDimension(), ", one per dof"));
  kinegraph::inverseDynamics(scene_->state(), inertias(), velocity, acceleration, forces);
}

std::vector<Config::NearPair> Config::getCollisions(double margin) const {
  if (std::isnan(margin)) throw ValueError("getCollisions: margin is nan; expected a distance in m");
  std::vector<NearPair> near;
  scene_->nearPairs().forDistances(margin, [&](int a, int b, double distance) { near.push_back({a, b, distance}); });
  return near;
}

double Config::getTotalPenetration(bool largest_only) const {
  double sum = 0., largest = 0.;
  scene_->nearPairs().forDistances(0., [&](int, int, double distance) {
    sum -= distance;
    largest = std::max(largest, -distance);
  });
  return largest_only ? largest : sum;
}

std::optional<MotionContact> Config::checkMotion(const VectorXd& from, const VectorXd& to, double margin,
                                                 double tolerance) const {
  for (const VectorXd* q : {&from, &to}) {
    if (q->size() == getJointDimension() && q->allFinite()) continue;
    throw ValueError(cat("checkMotion: ", q == &from ? "the start" : "the end", " has ", q->size(),
                         " numbers; expected ", getJointDimension(), " finite ones, one per active dof"));
  }
  if (!std::isfinite(margin)) throw ValueError(cat("checkMotion: margin is ", margin, "; expected a distance in m"));
  if (!(tolerance > 0.))
    throw ValueError(cat("checkMotion: tolerance is ", tolerance, "; expected a distance > 0 in m"));
  const std::optional<LimitPassed> limit = firstLimitPassed(*scene_->model(), from.data(), to.data());
  std::optional<MotionContact> contact =
      scene_->motionChecker().firstContact(from.data(), to.data(), margin, tolerance);
  if (!limit || (contact && contact->time < limit->time)) return contact;
  const int frame = frameOfDof(*scene_->model(), limit->dof);
  return MotionContact{limit->time, frame, frame, -limit->beyond, limit->dof};
}

std::string Config::report() const {
  constexpr std::size_t kMaxNamed = 40;
  int shapes = 0;
  for (const auto& frame : scene_->frames()) shapes += frame->shape != nullptr;
  const KinematicModel& model = *scene_->model();
  std::vector<std::string> colliding;
  for (const ContactRules::Body& body : model.contacts.bodies)
    if (colliding.size() < kMaxNamed) colliding.push_back(model.frame_name[std::size_t(body.frame)]);
  const std::size_t count = model.contacts.bodies.size();
  std::string text = cat("Configuration: q.N=", getJointDimension(), " #frames=", getFrameDimension(),
                         " #joints=", getJoints().size(), " #shapes=", shapes, " #pairs=", getCollidablePairs().size());
  if (count > 0)
    text += cat("\ncollide: ", join(colliding, " "), count > kMaxNamed ? cat(" and ", count - kMaxNamed, " more") : "");
  if (const double mass = totalMass(*scene_); mass > 0.) text += cat("\nmass: ", mass, " kg");
  for (const std::string& note : contactWarnings()) text += cat("\nnote: ", note);
  return text;
}

std::vector<std::string> Config::contactWarnings() const {
  return describe(kinegraph::contactWarnings(*scene_), *scene_);
}

std::vector<std::string> Config::takeWarnings() { return std::exchange(warnings_, {}); }

}  // namespace kinegraph
