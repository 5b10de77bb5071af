#include "kinegraph/task_planning/task_actions.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/logic/fol_reader.h"
#include "kinegraph/task_planning/scene_facts.h"
#include "kinegraph/task_planning/task_doors.h"

namespace kinegraph {

namespace {

constexpr double kLevel = .999, kUp = .9;  ///< cosines of level axes, and of axes that point up
constexpr double kLong = 1.5;              ///< minimum ratio of length and thickness of a bar
constexpr double kLeastPlace = .05;        ///< m: narrower boxes are no places

constexpr char kDefaultFol[] = R"(
is_gripper is_object is_place is_face is_pose is_carrier is_pushable is_hook is_handle is_guided partOf on busy up fresh posed
pushes holds held opened closed ajar z
DecisionRule pick { Obj, From, Hand,
  { (is_gripper Hand) (is_object Obj) (on From Obj) (is_place From) (busy Hand)! (on Obj ANY)!
    (pushes ANY Obj)! }
  { (on From Obj)! (on Hand Obj) (busy Hand) } }
DecisionRule lift { Obj, From, Hand,
  { (is_gripper Hand) (is_object Obj) (is_carrier Obj) (on From Obj) (is_place From) (busy Hand)! }
  { (on From Obj)! (on Hand Obj) (busy Hand) } }
DecisionRule place { Obj, Hand, To,
  { (is_gripper Hand) (is_object Obj) (on Hand Obj) (is_place To) (on Obj To)! (pushes Obj ANY)! }
  { (busy Hand)! (on Hand Obj)! (on To Obj) (fresh Obj)! (up ANY Obj)! (up z Obj) } }
DecisionRule lay { Obj, Hand, To, Face,
  { (is_gripper Hand) (is_object Obj) (on Hand Obj) (is_place To) (is_face Face) (on Obj To)!
    (pushes Obj ANY)! }
  { (busy Hand)! (on Hand Obj)! (on To Obj) (fresh Obj)! (up ANY Obj)! (up Face Obj) } }
DecisionRule handover { Obj, Hand, To,
  { (is_gripper Hand) (is_object Obj) (on Hand Obj) (is_gripper To) (busy To)! (pushes Obj ANY)! }
  { (busy Hand)! (on Hand Obj)! (on To Obj) (busy To) } }
DecisionRule push_start { Obj, From, Hand,
  { (is_gripper Hand) (is_pushable Obj) (on From Obj) (is_place From) (busy Hand)! (on Obj ANY)! (pushes ANY Obj)! }
  { (busy Hand) (pushes Hand Obj) } }
DecisionRule push_end { Obj, Hand, To,
  { (is_gripper Hand) (pushes Hand Obj) (is_place To) (on Obj To)! }
  { (pushes Hand Obj)! (busy Hand)! (on ANY Obj)! (on To Obj) (fresh Obj)! } }
DecisionRule hook_start { Obj, From, Hook, Tool, Hand,
  { (is_gripper Hand) (is_hook Hook) (partOf Tool Hook) (on Hand Tool) (is_object Obj) (on From Obj) (is_place From)
    (on Obj ANY)! (pushes ANY Obj)! (pushes Tool ANY)! }
  { (pushes Tool Obj) } }
DecisionRule hook_end { Obj, Hook, To, Tool, Hand,
  { (is_gripper Hand) (is_hook Hook) (partOf Tool Hook) (on Hand Tool) (pushes Tool Obj) (is_place To) (on Obj To)! }
  { (pushes Tool Obj)! (on ANY Obj)! (on To Obj) (fresh Obj)! } }
DecisionRule hold { Door, Handle, Hand,
  { (is_gripper Hand) (is_guided Door) (is_handle Handle) (partOf Door Handle) (busy Hand)! (held Door)! }
  { (busy Hand) (holds Hand Handle) (held Door) } }
DecisionRule open { Door, Handle, Hand,
  { (is_gripper Hand) (is_guided Door) (partOf Door Handle) (holds Hand Handle) (opened Door)! }
  { (busy Hand)! (holds Hand Handle)! (held Door)! (closed Door)! (ajar Door)! (opened Door) } }
DecisionRule close { Door, Handle, Hand,
  { (is_gripper Hand) (is_guided Door) (partOf Door Handle) (holds Hand Handle) (closed Door)! }
  { (busy Hand)! (holds Hand Handle)! (held Door)! (opened Door)! (ajar Door)! (closed Door) } }
DecisionRule pose { Obj, Hand, Goal,
  { (is_gripper Hand) (is_object Obj) (on Hand Obj) (is_pose Goal) (pushes Obj ANY)! }
  { (posed Obj Goal) } }
)";

/// Whether a frame is a place: large, level, and static or in a drawer.
bool isPlaceFrame(const Frame& frame, const std::set<std::string>& objects, const std::set<std::string>& drawers) {
  if (objects.contains(frame.getName())) return true;
  for (std::optional<Frame> up = frame; up; up = up->getParent()) {
    const JointType type = up->getJointType();
    if (type != JointType::none && type != JointType::rigid && !drawers.contains(up->getName())) return false;
  }
  const std::vector<double> size = frame.getSize();
  return std::abs(frame.getRotationMatrix()(2, 2)) > kLevel && std::min(size[0], size[1]) >= kLeastPlace;
}

std::set<std::string> setOf(const std::vector<std::string>& words) { return {words.begin(), words.end()}; }

/// Drops facts that are already known.
std::vector<Literal> unique(const std::vector<Literal>& facts) {
  std::vector<Literal> kept;
  for (const Literal& fact : facts) {
    if (!contains(kept, fact)) kept.push_back(fact);
  }
  return kept;
}

class StartFacts {
 public:
  explicit StartFacts(const Config& C) : C_(C), said_(sceneFacts(C)) {}

  std::vector<Literal> with(const std::vector<Literal>& goal) {
    const std::vector<Frame> frames = C_.getFrames();
    std::erase_if(said_, [&](const Literal& fact) {  // the base of a robot is no object
      return fact.predicate == "is_object" && carriesJoints(C_.getFrame(fact.arguments[0]));
    });
    const bool names_grippers = has("is_gripper"), names_places = has("is_place");
    if (!names_grippers) {
      for (const Frame& f : frames)
        if (f.getName().ends_with("gripper")) said_.push_back({"is_gripper", {f.getName()}});
    }
    const std::set<std::string> grippers = setOf(wordsOf(said_, "is_gripper")),
                                objects = setOf(wordsOf(said_, "is_object")),
                                drawers = setOf(wordsOf(said_, "is_drawer"));
    if (!names_places) {
      for (const Frame& f : frames)
        if (isBox(f) && !grippers.contains(f.getName()) && isPlaceFrame(f, objects, drawers))
          said_.push_back({"is_place", {f.getName()}});
    }
    addWhatIsOn(grippers, objects);
    const VectorXd q = C_.getJointState();
    for (const TaskDoor& door : doorsOf(C_)) {
      said_.push_back({"is_guided", {door.name}});
      said_.push_back({door.stateAt(q[door.dof]), {door.name}});
    }
    for (const std::string& hand : grippers)
      if (holdsAnything(hand)) said_.push_back({"busy", {hand}});
    for (const std::string& name : objects)
      if (const std::string up = upOf(C_, name); !up.empty()) said_.push_back({"up", {up, name}});
    std::vector<std::string> kinds = {"is_carrier", "is_pushable"};
    if (has("is_hook")) kinds.emplace_back("is_object");  // any object may be pulled within reach
    for (const std::string& kind : kinds)
      for (const std::string& name : wordsOf(said_, kind)) said_.push_back({"fresh", {name}});
    if (std::ranges::any_of(goal, [](const Literal& g) { return g.predicate == "up"; })) {
      for (const std::string& face : otherFaces()) said_.push_back({"is_face", {face}});
    }
    return unique(said_);
  }

 private:
  static bool carriesJoints(const Frame& frame) {
    return std::ranges::any_of(frame.getSubtree(), [](const Frame& below) {
      const auto& joint = below.data().joint;
      return joint && joint->active && joint->dofs() > 0;
    });
  }

  bool has(const std::string& predicate) const {
    return std::ranges::any_of(said_, [&](const Literal& fact) { return fact.predicate == predicate; });
  }

  bool holdsAnything(const std::string& hand) const {
    return std::ranges::any_of(whatIsBelow(said_), [&](const auto& entry) { return entry.second == hand; });
  }

  /// Facts about objects that hang below unlabeled frames.
  void addWhatIsOn(const std::set<std::string>& grippers, const std::set<std::string>& objects) {
    const std::map<std::string, std::string> below = whatIsBelow(said_);
    for (const std::string& name : objects) {
      if (below.contains(name)) continue;
      const std::optional<Frame> parent = C_.getFrame(name).getParent();
      if (parent && contains(said_, {"is_place", {parent->getName()}})) {
        said_.push_back({"on", {parent->getName(), name}});
      } else if (const std::string hand = holderOf(C_, name, {grippers.begin(), grippers.end()}); !hand.empty()) {
        said_.push_back({"on", {hand, name}});
      }
    }
  }

  const Config& C_;
  std::vector<Literal> said_;
};

}  // namespace

bool isPick(const TaskAction& action) { return !action.empty() && (action[0] == "pick" || action[0] == "lift"); }

bool isPlace(const TaskAction& action) { return !action.empty() && (action[0] == "place" || action[0] == "lay"); }

bool startsSliding(const TaskAction& action) {
  return !action.empty() && (action[0] == "push_start" || action[0] == "hook_start");
}

bool endsSliding(const TaskAction& action) {
  return !action.empty() && (action[0] == "push_end" || action[0] == "hook_end");
}

/// The words of the actions of defaultDomain, by name.
static const std::map<std::string, std::string>& wordsOfActions() {
  static const std::map<std::string, std::string> known = {
      {"pick", "obj from hand"},
      {"lift", "obj from hand"},
      {"place", "obj hand to"},
      {"lay", "obj hand to face"},
      {"handover", "obj hand to"},
      {"push_start", "obj from hand"},
      {"push_end", "obj hand to"},
      {"pose", "obj hand goal"},
      {"hook_start", "obj from hook tool hand"},
      {"hook_end", "obj hook to tool hand"},
      {"hold", "door handle hand"},
      {"open", "door handle hand"},
      {"close", "door handle hand"},
  };
  return known;
}

bool isDefaultAction(const TaskAction& action) { return !action.empty() && wordsOfActions().contains(action[0]); }

void requireWords(const TaskAction& action) {
  if (action.empty()) throw ValueError("planTask: an action has no words");
  const std::map<std::string, std::string>& known = wordsOfActions();
  const auto found = known.find(action[0]);
  if (found == known.end()) return;
  const auto count = std::size_t(std::ranges::count(found->second, ' ')) + 2;
  if (action.size() < count)
    throw ValueError(cat("planTask: the action ", planText({action}), " has ", action.size() - 1,
                         " words behind its name; expected (", action[0], " ", found->second, ")"));
}

std::string objectOf(const TaskAction& action) { return action.size() > 1 ? action[1] : ""; }

const std::vector<std::string>& otherFaces() {
  static const std::vector<std::string> faces = {"zNeg", "x", "xNeg", "y", "yNeg"};
  return faces;
}

LogicDomain defaultDomain() { return readFol(kDefaultFol, "default domain"); }

std::vector<Literal> taskFacts(const Config& C, const std::vector<Literal>& goal) { return StartFacts(C).with(goal); }

std::string planText(const std::vector<TaskAction>& actions) {
  std::string text;
  for (const TaskAction& action : actions) {
    text += text.empty() ? "(" : " (";
    for (std::size_t i = 0; i < action.size(); ++i) text += (i ? " " : "") + action[i];
    text += ")";
  }
  return text;
}

std::string fixed(double value, int digits) {
  std::array<char, 512> buffer;  // the largest double has 309 digits before the point
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, digits);
  (void)error;
  return {buffer.data(), end};
}

bool contains(const std::vector<Literal>& facts, const Literal& fact) {
  return std::ranges::find(facts, fact) != facts.end();
}

std::vector<std::string> wordsOf(const std::vector<Literal>& facts, const std::string& predicate) {
  std::vector<std::string> words;
  for (const Literal& fact : facts)
    if (fact.predicate == predicate && !fact.arguments.empty()) words.push_back(fact.arguments[0]);
  return words;
}

std::map<std::string, std::string> whatIsBelow(const std::vector<Literal>& facts) {
  std::map<std::string, std::string> below;
  for (const Literal& fact : facts)
    if (fact.predicate == "on" && fact.arguments.size() == 2) below[fact.arguments[1]] = fact.arguments[0];
  return below;
}

std::string holderOf(const Config& C, const std::string& obj, const std::vector<std::string>& hands) {
  std::set<std::string> moving;
  for (const std::string& name : C.getJointNames()) moving.insert(name.substr(0, name.find(':')));
  std::optional<Frame> frame = C.getFrame(obj);
  while (frame && !moving.contains(frame->getName())) {
    frame = frame->getParent();
    if (frame && std::ranges::find(hands, frame->getName()) != hands.end()) return frame->getName();
  }
  return "";
}

std::vector<std::string> carriedBy(const Config& C, const std::vector<std::string>& hands,
                                   const std::vector<std::string>& objects) {
  std::vector<std::string> carried;
  for (const std::string& obj : objects)
    if (!holderOf(C, obj, hands).empty() && !holderOf(C, obj, objects).empty()) carried.push_back(obj);
  return carried;
}

std::string upOf(const Config& C, const std::string& name) {
  const Vector3d heights = C.getFrame(name).getRotationMatrix().row(2);
  Eigen::Index axis = 0;
  if (heights.cwiseAbs().maxCoeff(&axis) <= kUp) return "";
  return std::string(1, "xyz"[axis]) + (heights[axis] < 0. ? "Neg" : "");
}

int longAxis(const Frame& frame) {
  if (!isBox(frame)) return -1;
  const std::vector<double> size = frame.getSize();
  const int axis = int(std::max_element(size.begin(), size.begin() + 3) - size.begin());
  for (int k = 0; k < 3; ++k)
    if (k != axis && size[std::size_t(axis)] < kLong * size[std::size_t(k)]) return -1;
  return axis;
}

bool isBox(const Frame& frame) {
  return frame.getShapeType() == ShapeType::box || frame.getShapeType() == ShapeType::ssBox;
}

}  // namespace kinegraph
