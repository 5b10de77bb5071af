#include "kinegraph/scene/reader.h"

#include <algorithm>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/gfile/parser.h"
#include "kinegraph/scene/attributes.h"
#include "kinegraph/scene/scene_source.h"

namespace kinegraph {

namespace {

/// Makes the frames of a SceneSource. First all frames, then their parents, then what their attributes say, then the
/// joints between two frames, then what refers to other frames by name.
class SceneBuilder {
 public:
  SceneBuilder(SceneSource& source, SceneTree& scene, std::vector<std::string>& warnings)
      : source_(source), scene_(scene), warnings_(warnings) {}

  void build() {
    warnings_.insert(warnings_.end(), source_.warnings.begin(), source_.warnings.end());
    for (SourceFrame& source : source_.frames) addFrame(source);
    for (std::size_t i = 0; i < frames_.size(); ++i) linkToParent(*frames_[i], source_.frames[i]);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      if (!isTuple(source_.frames[i])) interpret(*frames_[i], source_.frames[i]);
    }
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      if (isTuple(source_.frames[i])) insertJoint(*frames_[i], source_.frames[i]);
    }
    for (std::size_t i = 0; i < frames_.size(); ++i) resolveReferences(*frames_[i], source_.frames[i]);
    for (const Node& node : source_.joint_states) setJointState(node);
    throwErrors();
  }

 private:
  static bool isTuple(const SourceFrame& source) { return source.node.parents.size() == 2; }
  static const Graph& attributes(const SourceFrame& source) { return *source.node.value.as<Graph>(); }

  void error(const SourcePosition& where, const std::string& message) { errors_.emplace_back(where, message); }

  /// Files of before 2018 say `shape name (parent) { type=.. }` and `joint name (A B) { type=.. }`.
  static void modernize(Node& node) {
    const auto kind = [&](const char* word) {
      return (!node.tags.empty() && node.tags.front() == word) || (node.tags.empty() && node.key == word && !node.parents.empty());
    };
    const bool joint = kind("joint"), shape = kind("shape");
    if (!joint && !shape) return;
    if (node.tags.empty()) node.key.clear();
    Graph& attributes = *std::get_if<Graph>(&node.value.data);
    if (Node* type = attributes.find("type")) type->key = joint ? "joint" : "shape";
  }

  void addFrame(SourceFrame& source) {
    modernize(source.node);
    std::string name = source.node.key;
    if (isTuple(source) && name.empty()) name = "|" + source.node.parents[1];
    FrameData& frame = scene_.add(name, nullptr);
    for (const std::string& tag : source.node.tags) {
      Node flag;
      flag.key = "%" + tag;
      frame.attributes.nodes.push_back(flag);
    }
    const Graph& given = attributes(source);
    frame.attributes.nodes.insert(frame.attributes.nodes.end(), given.nodes.begin(), given.nodes.end());
    frames_.push_back(&frame);
    if (source.node.parents.size() > 2) {
      error(source.node.where, cat("frame '", name, "' has ", source.node.parents.size(), " parents; one, or two for a joint between them, are possible"));
    }
  }

  FrameData* find(const std::string& name, const SourcePosition& where, const std::string& role) {
    if (FrameData* frame = scene_.find(name)) return frame;
    error(where, cat(role, " '", name, "' is not a frame of this scene", similarHint(name, scene_.names())));
    return nullptr;
  }

  void link(FrameData& frame, FrameData& parent, const SourcePosition& where) {
    try {
      scene_.link(frame, parent);
    } catch (const Error& e) {
      error(where, e.what());
    }
  }

  void linkToParent(FrameData& frame, const SourceFrame& source) {
    std::vector<std::string> parents = source.node.parents;
    SourcePosition where = source.node.where;
    if (const Node* attribute = attributes(source).find("parent"); attribute && parents.empty()) {
      where = attribute->value.where;
      if (const StringArray* names = attribute->value.as<StringArray>()) parents = *names;
      if (const std::string* name = attribute->value.as<std::string>()) parents = {*name};
    }
    if (parents.size() != 1) return;
    if (FrameData* parent = find(parents[0], where, cat("parent of '", frame.name, "':"))) link(frame, *parent, where);
  }

  AttributeReader reader(const FrameData& frame, const SourceFrame& source) {
    return {attributes(source), source.folder, frame.name, source.node.where, errors_, warnings_};
  }

  /// A frame with the constant transform before a joint, between the joint frame and its parent.
  void insertOrigin(FrameData& joint_frame, const Pose& before) {
    if (before.isIdentity(0.)) return;
    FrameData& origin = scene_.add(joint_frame.name + "_origin", joint_frame.parent);
    origin.pose = before;
    scene_.link(joint_frame, origin);
  }

  void interpret(FrameData& frame, const SourceFrame& source) {
    AttributeReader read = reader(frame, source);
    const std::optional<Pose> before = read.readPose({"pre", "A", "from"});
    std::optional<Pose> behind = read.readPose({"post", "B", "to"});
    if (attributes(source).find("BinvA") && before) behind = before->inverse();
    std::optional<Joint> joint = (before || behind) && frame.parent ? read.readJoint() : std::nullopt;
    if (!joint) {
      read.apply(frame);
      return;
    }
    if (behind && !behind->isIdentity(0.)) {  // the joint gets a frame of its own, and this one sits behind it
      FrameData& joint_frame = scene_.add("|" + frame.name, frame.parent);
      joint_frame.joint = joint;
      insertOrigin(joint_frame, before.value_or(Pose()));
      scene_.link(frame, joint_frame);
      frame.pose = *behind;
      read.apply(frame, false);
      return;
    }
    read.apply(frame);
    insertOrigin(frame, before.value_or(Pose()));
  }

  /// `name (A B) { joint: .. }`: a joint frame below A, and B behind it.
  void insertJoint(FrameData& frame, const SourceFrame& source) {
    const std::string role = cat("joint '", frame.name, "' between two frames:");
    FrameData* above = find(source.node.parents[0], source.node.where, role);
    FrameData* below = find(source.node.parents[1], source.node.where, role);
    if (!above || !below) return;
    AttributeReader read = reader(frame, source);
    const Pose before = read.readPose({"pre", "A", "from"}).value_or(Pose());
    std::optional<Pose> behind = read.readPose({"post", "B", "to"});
    if (attributes(source).find("BinvA")) behind = before.inverse();
    const bool was_root = below->parent == nullptr;
    link(frame, *above, source.node.where);
    if (!frame.parent) return;
    link(*below, frame, source.node.where);
    if (below->parent != &frame) return;
    if (behind && !behind->isIdentity(0.)) {
      below->pose = *behind;
    } else if (was_root) {
      below->pose = Pose();
    }
    read.apply(frame);
    insertOrigin(frame, before);
  }

  void resolveReferences(FrameData& frame, const SourceFrame& source) {
    if (const Node* node = attributes(source).find("mimic_shape")) {
      const std::string* name = node->value.as<std::string>();
      const FrameData* other = name ? find(*name, node->value.where, cat("frame '", frame.name, "', mimic_shape:")) : nullptr;
      if (other) frame.shape = other->shape;
    }
    const Node* node = attributes(source).find("mimic");
    if (!node) return;
    FrameData* joint_frame = frame.moves() ? &frame : frame.parent && frame.parent->name == "|" + frame.name ? frame.parent : nullptr;
    std::string name;
    if (const std::string* word = node->value.as<std::string>()) name = *word;
    if (const NameTuple* tuple = node->value.as<NameTuple>(); tuple && tuple->names.size() == 1) name = tuple->names[0];
    FrameData* other = find(name, node->value.where, cat("frame '", frame.name, "', mimic:"));
    if (!other || !joint_frame) return;
    if (!other->joint || other->joint->type != joint_frame->joint->type || other == joint_frame || &dofSource(*other) == joint_frame) {
      error(node->value.where, cat("frame '", frame.name, "', mimic: '", name, "' has ",
                                   other->joint ? "a joint of type " + jointTypeName(other->joint->type) : std::string("no joint"),
                                   "; expected another frame with a ", jointTypeName(joint_frame->joint->type), " joint"));
      return;
    }
    joint_frame->joint->mimic = other;
  }

  void setJointState(const Node& node) {
    if (!errors_.empty()) return;
    const NumberArray* array = node.value.as<NumberArray>();
    const std::vector<double> q = array ? array->numbers : std::vector<double>{*node.value.as<double>()};
    const int dofs = scene_.program()->dofs;
    if (int(q.size()) != dofs) {
      error(node.value.where, cat("q has ", q.size(), " numbers; the scene has ", dofs, " dofs"));
      return;
    }
    scene_.setJointState(q.data());
    for (const auto& frame : scene_.frames()) {
      if (frame->moves()) frame->joint->home = frame->joint->q;
    }
    scene_.structureChanged();
  }

  std::string withExcerpt(const ParseError& e) const {
    const auto text = source_.texts.find(e.where().file);
    return text == source_.texts.end() ? e.reason() : cat(e.reason(), "\n", excerpt(text->second, e.where()));
  }

  void throwErrors() const {
    if (errors_.empty()) return;
    std::string message = withExcerpt(errors_[0]);
    for (std::size_t i = 1; i < errors_.size(); ++i) message += cat("\n", errors_[i].where().str(), ": ", withExcerpt(errors_[i]));
    throw ParseError(errors_[0].where(), message);
  }

  SceneSource& source_;
  SceneTree& scene_;
  std::vector<std::string>& warnings_;
  std::vector<FrameData*> frames_;  ///< one per source frame
  std::vector<ParseError> errors_;
};

}  // namespace

void readSceneFile(const std::string& path, SceneTree& scene, std::vector<std::string>& warnings) {
  SceneSource source = readSource(path);
  SceneBuilder(source, scene, warnings).build();
}

void readSceneText(std::string_view text, const std::string& name, const std::string& folder, SceneTree& scene,
                   std::vector<std::string>& warnings) {
  SceneSource source = readSource(text, name, folder);
  SceneBuilder(source, scene, warnings).build();
}

void applyAttributes(const Graph& attributes, const std::string& folder, FrameData& frame, std::vector<std::string>& warnings) {
  const bool braced = attributes.nodes.size() == 1 && attributes.nodes[0].key.empty() && attributes.nodes[0].value.as<Graph>();
  const Graph& inner = braced ? *attributes.nodes[0].value.as<Graph>() : attributes;
  std::vector<ParseError> errors;
  AttributeReader read(inner, folder, frame.name, {}, errors, warnings);
  frame.attributes = inner;
  read.apply(frame);
  SceneTree& scene = *frame.tree;
  if (const auto before = read.readPose({"pre", "A", "from"}); before && frame.joint && !before->isIdentity(0.)) {
    FrameData& origin = scene.add(frame.name + "_origin", frame.parent);
    origin.pose = *before;
    scene.link(frame, origin);
  }
  if (const Node* mimic = inner.find("mimic"); mimic && frame.joint) {
    const std::string* name = mimic->value.as<std::string>();
    FrameData& other = scene.get(name ? *name : "", cat("frame '", frame.name, "', mimic"));
    if (other.joint && other.joint->type == frame.joint->type && &dofSource(other) != &frame) {
      frame.joint->mimic = &other;
    } else {
      errors.emplace_back(mimic->value.where, cat("mimic: '", other.name, "' has no ", jointTypeName(frame.joint->type), " joint"));
    }
  }
  scene.structureChanged();
  if (!errors.empty()) throw errors.front();
}

}  // namespace kinegraph
