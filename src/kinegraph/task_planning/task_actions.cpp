#include "kinegraph/task_planning/task_actions.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/logic/domain.h"

namespace kinegraph {

namespace {

constexpr double kUp = .9;     ///< cosine of axes that point up
constexpr double kLong = 1.5;  ///< minimum ratio of length and thickness of a bar

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
