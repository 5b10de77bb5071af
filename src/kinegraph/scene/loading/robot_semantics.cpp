#include "kinegraph/scene/loading/robot_semantics.h"

#include <algorithm>
#include <set>
#include <unordered_map>

#include "kinegraph/common/text.h"

namespace kinegraph::inline scene_internal {

namespace {

using Member = RobotSemantics::Member;

template <class T>
T& attribute(FrameData& frame, const char* key) {
  Graph& graph = frame.attributes.edit();
  Node* node = graph.find(key);
  if (!node || !std::holds_alternative<T>(node->value.data)) {
    graph.set({key, {}, {}, {T(), {}}, {}});
    node = graph.find(key);
  }
  return *std::get_if<T>(&node->value.data);
}

class Applier {
 public:
  Applier(const RobotSemantics& semantics, SceneTree& scene, SceneDiagnostics& diagnostics)
      : semantics_(semantics), scene_(scene), diagnostics_(diagnostics) {
    for (const auto& frame : scene.frames()) {
      by_name_.emplace(frame->name, frame.get());
      for (const FrameData* other : frame->no_contact) settled_.insert({frame.get(), other});
    }
    for (const auto& group : semantics.groups) groups_.emplace(group.name, &group);
  }

  void apply() {
    if (!knowsAny()) {
      if (!semantics_.requested) {
        return diagnostics_.warning(
            {semantics_.file, 1, 1},
            "the SRDF file beside the robot's file is ignored: it names none of its links and joints");
      }
      return diagnostics_.error(
          {semantics_.file, 1, 1},
          "none of the links and joints in this file is a frame of the scene; add the robot first");
    }
    if (!semantics_.no_contact.empty() || !semantics_.contact.empty()) dropFlags();
    excludeContacts();
    for (const auto& group : semantics_.groups) {
      std::set<std::string> seen;
      std::vector<FrameData*> joints;
      collect(group, seen, joints);
      std::sort(joints.begin(), joints.end(), [](const FrameData* a, const FrameData* b) { return a->id < b->id; });
      joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
      for (FrameData* joint : joints) {
        StringArray& names = attribute<StringArray>(*joint, "joint_groups");
        if (std::find(names.begin(), names.end(), group.name) == names.end()) names.push_back(group.name);
      }
    }
    for (const auto& state : semantics_.states) {
      for (const auto& value : state.joints) addValue(state, value);
    }
    scene_.structureChanged();
  }

 private:
  FrameData* find(const std::string& name) const {
    const auto found = by_name_.find(semantics_.prefix + name);
    return found == by_name_.end() ? nullptr : found->second;
  }

  /// Finds the frame of a joint. readUrdf appends "_joint" to a joint that shares its name with a link.
  FrameData* findJoint(const std::string& name) const {
    FrameData* frame = find(name);
    FrameData* renamed = frame && !frame->joint ? find(name + "_joint") : nullptr;
    return renamed ? renamed : frame;
  }

  bool knowsAny() const {
    const auto pairs = [&](const std::vector<RobotSemantics::Pair>& list) {
      return std::any_of(list.begin(), list.end(), [&](const auto& pair) { return find(pair.a) || find(pair.b); });
    };
    bool any = false, named = !semantics_.no_contact.empty();
    for (const auto& group : semantics_.groups) {
      for (const Member& member : group.members) {
        any = any || (member.kind != Member::Kind::group && findJoint(member.name));
        named = true;
      }
    }
    for (const auto& state : semantics_.states) {
      for (const auto& value : state.joints) {
        any = any || findJoint(value.joint);
        named = true;
      }
    }
    return any || !named || pairs(semantics_.no_contact);
  }

  void warnMissing(const char* kind, const std::string& name, const SourcePosition& where) {
    if (!missing_.insert(name).second) return;
    const std::string hint = missing_.size() <= 20 ? similarHint(semantics_.prefix + name, scene_.names()) : "";
    diagnostics_.warning(where, cat("the scene has no ", kind, " '", semantics_.prefix, name, "'", hint));
  }

  FrameData* link(const std::string& name, const SourcePosition& where) {
    FrameData* frame = find(name);
    if (!frame) warnMissing("link", name, where);
    return frame;
  }

  /// Replaces negative contact flags by 1, because the file already lists all excluded pairs.
  void dropFlags() {
    for (FrameData* frame : robot()) {
      if (!hasNegativeFlag(*frame)) continue;
      frame->shape->contact = 1;
      scene_.looksChanged(*frame->shape);
    }
  }

  static bool hasNegativeFlag(const FrameData& frame) { return frame.shape && frame.shape->contact < 0; }

  /// Returns the frames of the robot: those of its file, or all frames below the lowest common ancestor of the named
  /// links. Continues to higher frames until another subtree below them has a negative flag: it may be another robot.
  std::vector<FrameData*> robot() const {
    std::vector<FrameData*> frames;
    for (const std::string& name : semantics_.robot) {
      if (FrameData* frame = find(name)) frames.push_back(frame);
    }
    if (!semantics_.robot.empty()) return frames;
    std::vector<FrameData*> tops;  // one per tree
    for (const auto* pairs : {&semantics_.no_contact, &semantics_.contact}) {
      for (const auto& pair : *pairs) {
        for (const std::string& name : {pair.a, pair.b}) addBelowTop(find(name), tops);
      }
    }
    for (FrameData* top : tops) {
      while (top->parent && !hasOtherRobot(*top)) top = top->parent;
      addBranch(*top, frames);
    }
    return frames;
  }

  static bool isAbove(const FrameData* above, const FrameData* frame) {
    while (frame && frame != above) frame = frame->parent;
    return frame != nullptr;
  }

  static void addBelowTop(FrameData* frame, std::vector<FrameData*>& tops) {
    if (!frame) return;
    for (FrameData*& top : tops) {
      FrameData* common = top;
      while (common && !isAbove(common, frame)) common = common->parent;
      if (!common) continue;
      top = common;
      return;
    }
    tops.push_back(frame);
  }

  static bool hasOtherRobot(const FrameData& top) {
    const auto& siblings = top.parent->children;
    return std::any_of(siblings.begin(), siblings.end(), [&](FrameData* sibling) {
      std::vector<FrameData*> branch;
      if (sibling != &top) addBranch(*sibling, branch);
      return std::any_of(branch.begin(), branch.end(), [](const FrameData* frame) { return hasNegativeFlag(*frame); });
    });
  }

  static void addBranch(FrameData& top, std::vector<FrameData*>& frames) {
    frames.push_back(&top);
    for (FrameData* child : top.children) addBranch(*child, frames);
  }

  void excludeContacts() {
    for (const auto& pair : semantics_.contact) {
      FrameData* const a = link(pair.a, pair.where);
      FrameData* const b = link(pair.b, pair.where);
      if (a && b) settled_.insert({a, b});
    }
    for (const auto& pair : semantics_.no_contact) {
      FrameData* const a = link(pair.a, pair.where);
      if (a && pair.b.empty()) {
        excludeAll(*a);
      } else if (FrameData* const b = pair.b.empty() ? nullptr : link(pair.b, pair.where); a && b) {
        exclude(*a, *b);
      }
    }
  }

  void exclude(FrameData& a, FrameData& b) {
    if (&a == &b || settled_.contains({&b, &a}) || !settled_.insert({&a, &b}).second) return;
    a.no_contact.push_back(&b);
  }

  /// Excludes the pairs of this frame with all other shapes of its robot.
  void excludeAll(FrameData& frame) {
    const auto rootOf = [](const FrameData* f) {
      while (f->parent) f = f->parent;
      return f;
    };
    const FrameData* const root = rootOf(&frame);
    for (const auto& other : scene_.frames()) {
      if (!other->shape || rootOf(other.get()) != root) continue;
      const bool part_of_link = other->parent && !other->joint;  // a fixed shape counts as a shape of its link
      exclude(frame, part_of_link ? *other->parent : *other);
    }
  }

  static void addMoving(FrameData* joint, std::vector<FrameData*>& joints) {
    if (joint && joint->moves() && !joint->joint->mimic) joints.push_back(joint);
  }

  void collect(const RobotSemantics::Group& group, std::set<std::string>& seen, std::vector<FrameData*>& joints) {
    if (!seen.insert(group.name).second) return;
    for (const Member& member : group.members) {
      if (member.kind == Member::Kind::joint) {
        FrameData* joint = findJoint(member.name);
        if (!joint && !isOutside(member.name)) warnMissing("joint", member.name, member.where);
        addMoving(joint, joints);
      } else if (member.kind == Member::Kind::link) {
        if (FrameData* frame = link(member.name, member.where))
          addMoving(frame->moves() ? frame : frame->parent, joints);
      } else if (member.kind == Member::Kind::chain) {
        collectChain(member, joints);
      } else if (const auto other = groups_.find(member.name); other != groups_.end()) {
        collect(*other->second, seen, joints);
      }
    }
  }

  void collectChain(const Member& chain, std::vector<FrameData*>& joints) {
    FrameData* const base = link(chain.name, chain.where);
    FrameData* const tip = link(chain.tip, chain.where);
    if (!base || !tip) return;
    const std::size_t before = joints.size();
    FrameData* frame = tip;
    for (; frame && frame != base; frame = frame->parent) addMoving(frame, joints);
    if (frame) return;
    joints.resize(before);
    diagnostics_.warning(chain.where, cat("the chain from '", chain.name, "' to '", chain.tip, "' does not exist: '",
                                          chain.name, "' is not above '", chain.tip, "'"));
  }

  bool isOutside(const std::string& joint) const {
    return std::find(semantics_.outside.begin(), semantics_.outside.end(), joint) != semantics_.outside.end();
  }

  void addValue(const RobotSemantics::State& state, const RobotSemantics::JointValue& value) {
    FrameData* const frame = findJoint(value.joint);
    if (!frame && isOutside(value.joint)) return;
    if (!frame) return warnMissing("joint", value.joint, value.where);
    if (!frame->moves() || frame->joint->mimic) return;
    NumberArray q{value.values, 1};
    const int dofs = frame->joint->dofs();
    if (int(q.numbers.size()) != dofs) {
      return diagnostics_.warning(value.where, cat("state '", state.name, "': joint '", value.joint, "' has ", dofs,
                                                   dofs == 1 ? " dof, not " : " dofs, not ", q.numbers.size()));
    }
    if (frame->joint->type == JointType::free)
      std::rotate(q.numbers.begin() + 3, q.numbers.begin() + 6, q.numbers.end());
    Graph* states = &attribute<Graph>(*frame, "joint_states");
    if (!state.group.empty()) {
      if (!states->find(state.group)) states->set({state.group, {}, {}, {Graph(), {}}, {}});
      states = std::get_if<Graph>(&states->find(state.group)->value.data);
      if (!states) return;
    }
    Value entry;
    if (dofs == 1) {
      entry.data = q.numbers[0];
    } else {
      entry.data = std::move(q);
    }
    states->set({state.name, {}, {}, std::move(entry), {}});
  }

  const RobotSemantics& semantics_;
  SceneTree& scene_;
  SceneDiagnostics& diagnostics_;
  std::unordered_map<std::string, FrameData*> by_name_;
  std::unordered_map<std::string, const RobotSemantics::Group*> groups_;
  std::set<std::pair<const FrameData*, const FrameData*>> settled_;  ///< pairs that need no further change
  std::set<std::string> missing_;
};

}  // namespace

void applySemantics(const RobotSemantics& semantics, SceneTree& scene, SceneDiagnostics& diagnostics) {
  Applier(semantics, scene, diagnostics).apply();
}

}  // namespace kinegraph::inline scene_internal
