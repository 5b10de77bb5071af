#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>

#include "kinegraph/task_planning/lgp/lgp_tool.h"

namespace kinegraph {

/// A problem of tests/data/lgp: its scene, and what its files say.
struct LgpProblem {
  static std::string path(const std::string& file);

  explicit LgpProblem(const std::string& scene, const std::string& problem = {}) {
    C.addFile(path(scene + ".g"));
    tamp = std::make_shared<DefaultLgpAbstraction>(C, path((problem.empty() ? scene : problem) + ".lgp"));
  }

  Config C;
  std::shared_ptr<DefaultLgpAbstraction> tamp;
};

/// A file of a test, in a folder of its own.
inline std::string writtenFile(const std::string& name, const std::string& text) {
  const std::string path = testing::TempDir() + name;
  std::ofstream(path) << text;
  return path;
}

/// Plans of one action each: the hand goes to a height.
class Reaches : public LgpAbstraction {
 public:
  Reaches(const Config& C, std::vector<double> heights) : LgpAbstraction(C), heights_(std::move(heights)) {}

  std::optional<std::vector<TaskAction>> getNewActionSequence() override {
    if (next_ == heights_.size()) return std::nullopt;
    return std::vector<TaskAction>{{"reach", std::to_string(heights_[next_++])}};
  }
  void add_action_constraints(const std::shared_ptr<Komo>& komo, double time, const TaskAction&,
                              const TaskAction& action) override {
    const Eigen::RowVector3d up(0., 0., 10.);
    komo->addObjective({time}, FeatureSymbol::position, {"hand"}, ObjectiveType::eq, MatrixXd(up),
                       {0., 0., std::stod(action[1])});
  }
  void forbidBeginning(const std::vector<TaskAction>& plan) override { forbidden.push_back(plan); }

  std::vector<std::vector<TaskAction>> forbidden;

 private:
  std::vector<double> heights_;
  std::size_t next_ = 0;
};

inline std::vector<std::string> namesOf(const LgpTool& lgp) {
  std::vector<std::string> names;
  for (const TaskAction& action : lgp.getSolvedPlan()) names.push_back(action[0]);
  return names;
}

}  // namespace kinegraph
