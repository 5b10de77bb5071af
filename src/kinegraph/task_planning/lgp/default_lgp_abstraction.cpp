#include "kinegraph/task_planning/lgp/lgp_abstraction.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/gfile/parser.h"
#include "kinegraph/logic/domain.h"
#include "kinegraph/logic/grounding.h"
#include "kinegraph/task_planning/lgp/lgp_actions.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

namespace {

/// The contents of a .lgp file.
struct LgpFile {
  std::string fol;                ///< path
  std::string terminal;           ///< literals, at their position in the file
  std::vector<std::string> coll;  ///< pairs of names
};

std::string textOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(cat("default_LGP_TAMP_Abstraction: cannot read '", path, "'"));
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

const Node& required(const Graph& entries, const char* key, const std::string& path) {
  const Node* node = entries.find(key);
  if (node && (node->value.as<std::string>() || node->value.as<AngleText>())) return *node;
  const SourcePosition where = node ? node->where : SourcePosition{path, 1, 1};
  throw ParseError(where, cat("missing `", key, ":`; expected fol: <file> and terminal: \"(on tray cup)\""));
}

std::string wordsOf(const Value& value) {
  const AngleText* angle = value.as<AngleText>();
  return angle ? angle->text : *value.as<std::string>();
}

/// Pads a text with the lines and blanks before it in its file, so that errors have the right position.
std::string inPlace(const Value& value) {
  return std::string(std::size_t(value.where.line - 1), '\n') + std::string(std::size_t(value.where.column), ' ') +
         wordsOf(value);
}

std::vector<std::string> pairs(const Config& C, const Node& node) {
  std::vector<std::string> names;
  if (const StringArray* list = node.value.as<StringArray>())
    names = *list;
  else if (const NumberArray* none = node.value.as<NumberArray>(); !none || !none->numbers.empty())
    throw ParseError(node.where, cat("coll is ", describe(node.value), "; expected pairs of frames: [a b, c d]"));
  for (const std::string& name : names) C.getFrame(name);  // throws, with similar names
  if (names.size() % 2 != 0) throw ParseError(node.where, cat("coll has ", names.size(), " names; expected pairs"));
  return names;
}

LgpFile readLgpFile(const Config& C, const std::string& path) {
  const Graph entries = parse(textOf(path), path);
  LgpFile file;
  const std::string fol = wordsOf(required(entries, "fol", path).value);
  file.fol = (std::filesystem::absolute(path).parent_path() / fol).lexically_normal().string();
  file.terminal = inPlace(required(entries, "terminal", path).value);
  if (const Node* coll = entries.find("coll")) file.coll = pairs(C, *coll);
  return file;
}

}  // namespace

DefaultLgpAbstraction::DefaultLgpAbstraction(const Config& scene, const std::string& lgp_file,
                                             CancellationToken cancellation)
    : LgpAbstraction(scene) {
  const LgpFile file = readLgpFile(C, lgp_file);
  explicitCollisions = file.coll;
  const LogicDomain domain = readFolFile(file.fol);
  LogicProblem problem{"problem", domain, {}, domain.start, readLiterals(file.terminal, lgp_file)};
  for (Literal& fact : sceneFacts(C)) problem.start.push_back(std::move(fact));
  PlanSearch::Options options;
  options.cancellation = [this, cancellation = std::move(cancellation)] {
    try {
      cancellation.check();
    } catch (...) {
      interruption_ = std::current_exception();
    }
    return bool(interruption_);
  };
  search_ = std::make_shared<PlanSearch>(ground(std::move(problem)), options);
  if (!search_->problem().unreachable.empty()) {
    throw ParseError({lgp_file, 1, 1},
                     cat("the goal cannot be reached: ", join(diagnostics(search_->problem()), "; ")));
  }
}

std::optional<std::vector<TaskAction>> DefaultLgpAbstraction::getNewActionSequence() {
  interruption_ = nullptr;
  const auto plan = search_->next();
  if (interruption_) std::rethrow_exception(interruption_);
  if (!plan) return std::nullopt;
  return actionWords(search_->problem(), *plan);
}

void DefaultLgpAbstraction::forbidBeginning(const std::vector<TaskAction>& plan) {
  search_->forbidBeginning(actionNumbers(search_->problem(), plan));
}

void DefaultLgpAbstraction::add_action_constraints(const std::shared_ptr<Komo>& komo, double time, const TaskAction&,
                                                   const TaskAction& action) {
  const auto helper = newHelper();
  helper->komo = komo;
  addLgpAction(*this, *helper, time, action);
}

void DefaultLgpAbstraction::begin(int actions) {
  held_.clear();
  count_ = actions;
}

void DefaultLgpAbstraction::switchTo(ManipulationHelper& m, double time, const std::string& frame,
                                     const std::string& obj) {
  using F = FeatureSymbol;
  const auto held = held_.find(obj);
  m.komo->addRigidSwitch(time, frame, obj, false);
  if (held != held_.end())
    m.komo->addObjective({time}, F::poseRel, {obj, held->second}, ObjectiveType::eq, 1e1, {}, 1);
  else
    m.komo->addObjective({time}, F::pose, {obj}, ObjectiveType::eq, 1e1, {}, 1);
  if (const int slices = steps(*m.komo); slices > 1 && time < count_)  // an acceleration spans two velocities
    m.komo->addObjective({time + 1. / slices}, F::linangVel, {obj}, ObjectiveType::eq, 1., {}, 2);
  held_[obj] = frame;
}

int DefaultLgpAbstraction::steps(const Komo& komo) const { return komo.slices() / std::max(count_, 1); }

bool DefaultLgpAbstraction::is_last(double time) const { return std::lround(time) >= count_; }

}  // namespace kinegraph
