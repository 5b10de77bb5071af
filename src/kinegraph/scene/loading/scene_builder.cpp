#include "kinegraph/scene/loading/scene_builder.h"

#include <algorithm>
#include <charconv>
#include <set>

#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/loading/robot_semantics.h"
#include "kinegraph/scene/loading/unit_questions.h"

namespace kinegraph::inline scene_internal {

namespace {

/// Converts files from before 2018: `shape name (parent) { type=.. }` and `joint name (A B) { type=.. }`.
void modernize(Node& node) {
  Graph& attributes = *std::get_if<Graph>(&node.value.data);
  Node* type = attributes.find("type");
  const auto is = [&](const char* word) {
    const bool unnamed = node.tags.empty() && node.key == word && type && !node.parents.empty();
    return unnamed || (!node.tags.empty() && node.tags.front() == word);
  };
  const bool joint = is("joint"), shape = is("shape");
  if (!joint && !shape) return;
  if (node.tags.empty()) node.key.clear();
  if (type) type->key = joint ? "joint" : "shape";
}

/// Replaces file names in attributes by absolute paths, for existing and missing files, so a scene may be saved in
/// another folder. Attributes for transforms are skipped: <...> is a transform there.
void locateFile(Node& node, const std::string& folder) {
  static const std::set<std::string> transforms = {"X", "Q", "pose", "rel", "pre",    "post",
                                                   "A", "B", "from", "to",  "origin", "visual_pose"};
  AngleText* const file = std::get_if<AngleText>(&node.value.data);
  if (!file || file->text.find("://") != std::string::npos || transforms.contains(node.key)) return;
  if (std::string path = resolvePath(file->text, folder); !path.empty()) file->text = std::move(path);
}

/// The frame that carries the joint of a source frame: the frame itself, or the parent inserted by `post`.
FrameData* jointFrame(FrameData& frame) {
  if (frame.joint) return &frame;
  FrameData* parent = frame.parent;
  return parent && parent->joint && parent->name == "|" + frame.name ? parent : nullptr;
}

}  // namespace

void SceneBuilder::build(SceneSource& source) {
  for (SourceFrame& frame : source.frames) addFrame(frame);
  const int count = int(frames_.size());
  for (int i = 0; i < count; ++i) linkToParent(*frames_[i], source.frames[i], i);
  std::vector<int> early;  // frames listed before their parents
  for (int i = 0; i < count; ++i) {
    if (frames_[i]->parent && frames_[i]->parent->id > i) early.push_back(i);
  }
  for (int i = 0; i < count; ++i) {
    if (!isTuple(source.frames[i])) interpret(*frames_[i], source.frames[i]);
  }
  for (int i = 0; i < count; ++i) {
    if (isTuple(source.frames[i])) insertJoint(*frames_[i], source.frames[i]);
  }
  for (int i : early) keepWorldPose(*frames_[i], source.frames[i]);
  for (int i = 0; i < count; ++i) resolveMimicShape(*frames_[i], source.frames[i]);
  for (int i = 0; i < count; ++i) resolveContactExclude(*frames_[i], source.frames[i]);
  for (int i = 0; i < count; ++i) resolveMimic(*frames_[i], source.frames[i]);
  for (const Node& node : source.joint_states) setJointState(node);
  askAboutUnits(source, frames_, diagnostics_);
  for (const RobotSemantics& semantics : source.semantics) {
    if (count > 0) applySemantics(semantics, scene_, diagnostics_);
  }
}

void SceneBuilder::interpretExisting(FrameData& frame, const SourceFrame& source) {
  frame.attributes.edit() = attributes(source);
  interpret(frame, source);
  resolveMimicShape(frame, source);
  resolveContactExclude(frame, source);
  resolveMimic(frame, source);
}

void SceneBuilder::addFrame(SourceFrame& source) {
  modernize(source.node);
  std::string name = source.node.key;
  if (isTuple(source) && name.empty()) name = "|" + source.node.parents[1];
  const bool is_taken = name != source.prefix && scene_.find(name);
  FrameData& frame = scene_.add(name, nullptr);
  for (const std::string& tag : source.node.tags) {
    Node flag;
    flag.key = "%" + tag;
    frame.attributes.edit().nodes.push_back(flag);
  }
  const Graph& given = attributes(source);
  if (!given.nodes.empty()) {
    std::vector<Node>& nodes = frame.attributes.edit().nodes;
    nodes.insert(nodes.end(), given.nodes.begin(), given.nodes.end());
    for (Node& node : nodes) locateFile(node, source.folder);
  }
  frames_.push_back(&frame);
  if (source.node.parents.size() > 2) {
    diagnostics_.error(source.node.where, cat("frame '", name, "' has ", source.node.parents.size(),
                                              " parents; expected one, or two for a joint between them"));
  }
  if (is_taken) {
    diagnostics_.warning(source.node.where,
                         cat("a frame named '", name, "' already exists; references by name find the first"));
  }
}

/// Finds the first (or last) frame of that name, or of that name with `prefix`. Reports an error if there is none.
FrameData* SceneBuilder::find(const std::string& name, const std::string& prefix, const SourcePosition& where,
                              const std::string& role, bool last) {
  for (const std::string& candidate : {name, prefix + name}) {
    if (FrameData* found = last ? scene_.findLast(candidate) : scene_.find(candidate)) return found;
  }
  diagnostics_.error(where, cat(role, " '", name, "' is not a frame of this scene",
                                diagnostics_.flooded() ? "" : similarHint(name, scene_.names())));
  return nullptr;
}

bool SceneBuilder::link(FrameData& frame, FrameData& parent, const SourcePosition& where) {
  try {
    scene_.link(frame, parent);
    return true;
  } catch (const Error& e) {
    diagnostics_.error(where, e.what());
    return false;
  }
}

void SceneBuilder::linkToParent(FrameData& frame, const SourceFrame& source, int place) {
  std::vector<std::string> parents = source.node.parents;
  SourcePosition where = source.node.where;
  if (const Node* attribute = attributes(source).find("parent"); attribute && parents.empty()) {
    where = attribute->value.where;
    if (const StringArray* names = attribute->value.as<StringArray>()) parents = *names;
    if (const std::string* name = attribute->value.as<std::string>()) parents = {*name};
    if (const NameTuple* tuple = attribute->value.as<NameTuple>()) parents = tuple->names;
    if (parents.size() != 1)
      return diagnostics_.error(where, cat("frame '", frame.name, "', parent: expected the name of one frame"));
  }
  if (parents.size() != 1) return;
  if (FrameData* parent = findParent(parents[0], frame, source, where, place)) link(frame, *parent, where);
}

/// Finds the parent by name, or by a negative number in old files: -1 is the previous entry.
FrameData* SceneBuilder::findParent(const std::string& name, const FrameData& frame, const SourceFrame& source,
                                    const SourcePosition& where, int place) {
  int back = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), back);
  const bool counts = error == std::errc{} && end == name.data() + name.size() && back < 0 && back >= -place;
  if (counts && !scene_.find(name)) return frames_[place + back];
  if (orphans_ && !scene_.find(name) && !scene_.find(source.prefix + name)) {
    diagnostics_.warning(where, cat("parent of '", frame.name, "': '", name, "' is not a frame of this scene; '",
                                    frame.name, "' has no parent"));
    return nullptr;
  }
  return find(name, source.prefix, where, cat("parent of '", frame.name, "':"));
}

/// Inserts a frame with the constant transform before a joint, between the joint frame and its parent.
FrameData& SceneBuilder::addOrigin(FrameData& joint_frame, const Pose& before) {
  FrameData& origin = scene_.add(joint_frame.name + "_origin", joint_frame.parent);
  origin.pose = before;
  scene_.link(joint_frame, origin);
  return origin;
}

void SceneBuilder::interpret(FrameData& frame, const SourceFrame& source) {
  AttributeReader read = reader(frame, source);
  if (!frame.parent && !source.node.parents.empty() && !(orphans_ && !read.find({"joint"})))
    return read.applyBody(frame);  // the missing parent is already reported
  const std::optional<Pose> before = read.readBefore(), behind = read.readBehind();
  if (const Node* node = read.find({"from", "to"})) {
    diagnostics_.warning(node->where, cat("frame '", frame.name, "': '", node->key,
                                          "' has a meaning only for a joint between two frames; write '",
                                          node->key == "to" ? "post" : "pre", "'"));
  }
  const bool has_joint = read.find({"joint"}) && frame.parent;
  if (has_joint && behind &&
      !behind->isIdentity(0.)) {  // the joint moves to an extra frame; this one is fixed behind it
    if (read.readJoint()) {
      FrameData& joint_frame = scene_.add("|" + frame.name, frame.parent);
      read.applyJoint(joint_frame);
      if (before && !before->isIdentity(0.)) addOrigin(joint_frame, *before);
      scene_.link(frame, joint_frame);
      frame.pose = *behind;
    }
    read.applyBody(frame);
    return;
  }
  read.applyJoint(frame);
  const bool always = read.find({"origin"}) && !read.find({"pre", "A"});
  if (before && frame.parent && (frame.joint || always) && !before->isIdentity(0.)) addOrigin(frame, *before);
  read.applyBody(frame);
}

/// `name (A B) { joint: .. }`: attaches a joint frame below A, and B below the joint frame.
void SceneBuilder::insertJoint(FrameData& frame, const SourceFrame& source) {
  const std::string role = cat("joint '", frame.name, "' between two frames:");
  FrameData* above = find(source.node.parents[0], source.prefix, source.node.where, role);
  FrameData* below = find(source.node.parents[1], source.prefix, source.node.where, role);
  if (!above || !below) return;
  AttributeReader read = reader(frame, source);
  const auto before = read.find({"from"}) ? read.readPose({"from"}) : read.readBefore();
  const auto behind = read.find({"to"}) ? read.readPose({"to"}) : read.readBehind();
  const bool was_root = below->parent == nullptr;
  if (!link(frame, *above, source.node.where) || !link(*below, frame, source.node.where)) return;
  if (behind && !behind->isIdentity(0.)) {
    below->pose = *behind;
  } else if (was_root) {
    below->pose = Pose();
  }
  read.applyJoint(frame);
  if (before && !before->isIdentity(0.)) addOrigin(frame, *before);
  read.applyBody(frame);
}

/// Applies a world pose read before the parent's pose was known.
void SceneBuilder::keepWorldPose(FrameData& frame, const SourceFrame& source) {
  AttributeReader read = reader(frame, source);
  if (frame.joint || read.find({"Q", "rel", "pose"})) return;
  if (const auto world = read.readPose({"X"})) frame.pose = frame.parent->worldPose().inverse() * *world;
}

void SceneBuilder::resolveMimicShape(FrameData& frame, const SourceFrame& source) {
  AttributeReader read = reader(frame, source);
  const Node* node = read.find({"mimic_shape"});
  const auto name = node ? read.text(*node) : std::nullopt;
  if (!name) return;
  const FrameData* other = find(*name, source.prefix, node->value.where, cat("frame '", frame.name, "', mimic_shape:"));
  if (other && !other->shape) {
    diagnostics_.warning(node->value.where,
                         cat("frame '", frame.name, "', mimic_shape: frame '", *name, "' has no shape"));
  }
  if (other) frame.shape = other->shape;
}

void SceneBuilder::resolveContactExclude(FrameData& frame, const SourceFrame& source) {
  AttributeReader read = reader(frame, source);
  const Node* node = read.find({"contact_exclude"});
  if (!node) return;
  std::vector<std::string> names;
  if (const StringArray* list = node->value.as<StringArray>()) names = *list;
  if (const NameTuple* tuple = node->value.as<NameTuple>()) names = tuple->names;
  if (const std::string* name = node->value.as<std::string>()) names = {*name};
  if (names.empty()) read.error(*node, "expected frame names: [a b]");
  for (const std::string& name : names) {
    const std::string role = cat("frame '", frame.name, "', contact_exclude:");
    if (FrameData* other = find(name, source.prefix, node->value.where, role)) frame.no_contact.push_back(other);
  }
}

void SceneBuilder::resolveMimic(FrameData& frame, const SourceFrame& source) {
  AttributeReader read = reader(frame, source);
  const Node* node = read.find({"mimic"});
  const auto name = node ? read.text(*node) : std::nullopt;
  if (!name) return;
  FrameData* follower = jointFrame(frame);
  if (!follower) return read.error(*node, cat("the frame has no joint to mimic '", *name, "'"));
  FrameData* other = find(*name, source.prefix, node->value.where, cat("frame '", frame.name, "', mimic:"), true);
  if (!other) return;
  FrameData* leader = jointFrame(*other);
  const bool both_have_one_dof = leader && leader->joint->dofs() == 1 && follower->joint->dofs() == 1;
  const bool same_kind =
      leader && leader->joint->type == follower->joint->type && leader->joint->code == follower->joint->code;
  if (!(same_kind || both_have_one_dof) || &dofSource(*leader) == follower) {
    return read.error(*node,
                      cat("'", *name, "' has ",
                          leader ? "a joint of type " + jointTypeName(leader->joint->type) : std::string("no joint"),
                          "; expected another frame with a ", jointTypeName(follower->joint->type),
                          " joint that does not mimic this one"));
  }
  follower->joint->mimic = leader;
}

void SceneBuilder::setJointState(const Node& node) {
  if (diagnostics_.failed()) return;
  const NumberArray* array = node.value.as<NumberArray>();
  const std::vector<double> q = array ? array->numbers : std::vector<double>{*node.value.as<double>()};
  std::vector<FrameData*> joints;
  int dofs = 0;
  for (const auto& frame : scene_.frames()) {
    if (!frame->moves() || !frame->joint->active || frame->joint->mimic) continue;
    joints.push_back(frame.get());
    dofs += frame->joint->dofs();
  }
  if (int(q.size()) != dofs) {
    return diagnostics_.error(node.value.where,
                              cat("q has ", q.size(), " numbers; the scene has ", dofs, " active dofs"));
  }
  const double* next = q.data();
  for (FrameData* frame : joints) {
    frame->joint->q = frame->joint->home = Eigen::Map<const VectorXd>(next, frame->joint->dofs());
    next += frame->joint->dofs();
  }
}

}  // namespace kinegraph::inline scene_internal
