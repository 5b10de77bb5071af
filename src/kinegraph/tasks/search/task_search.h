#pragma once

#include <chrono>
#include <compare>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "kinegraph/komo/sub_problem.h"
#include "kinegraph/logic/plan_search.h"
#include "kinegraph/tasks/search/plan_task.h"
#include "kinegraph/tasks/search/task_attempts.h"
#include "kinegraph/tasks/search/task_motions.h"
#include "kinegraph/tasks/search/task_proofs.h"
#include "kinegraph/tasks/task_doors.h"

namespace kinegraph {

/// One call of planTasks.
class TaskSearch {
 public:
  TaskSearch(const Config& C, const std::string& goal, const TaskOptions& options);

  /// See TaskPlans.
  std::optional<TaskPlan> next();

 private:
  using Actions = std::vector<TaskAction>;
  using Words = std::vector<std::string>;

  /// In which actions are tried by themselves.
  struct Circumstances {
    Words without;              ///< objects that are not there
    std::vector<double> doors;  ///< where doors are at first; empty: as they are at the start
    auto operator<=>(const Circumstances&) const = default;
  };

  /// A plan in logic whose motions are looked for, from other waypoints each.
  struct Trial {
    Actions actions;
    int seed = 0;                        ///< of the waypoints that come next
    bool found = false;                  ///< was there a plan?
    std::optional<TaskFailure> failure;  ///< of motions
  };

  // --- in logic
  void begin(std::vector<Literal> start);
  void exclude();
  std::optional<Actions> nextActions();
  std::optional<Actions> searchActions();
  void forbid(const TaskAction& action, const std::vector<Literal>& facts);
  void forbidBeginning(const Actions& actions);
  std::vector<std::vector<Literal>> states(const Actions& actions) const;
  bool mayBeginTrial(const Actions& actions);

  // --- in geometry
  std::optional<TaskPlan> nextOf(Trial& trial);
  void conclude(const Trial& trial);
  void giveUp(const Actions& actions, const TaskFailure& failure);
  void forbidFailing(const Actions& actions);
  void forbidLast(const Actions& beginning, const std::optional<std::vector<Literal>>& facts);
  const std::optional<TaskFailure>& failureOf(const Actions& actions, const Circumstances& there = {});
  std::vector<Literal> withoutConstantDoors(std::vector<Literal> facts) const;
  std::string missingOfDoors() const;
  std::vector<Literal> doorsThatMatter(const Actions& actions, const Circumstances& there);
  std::variant<TaskPlan, TaskFailure> motionsOf(const TaskWaypoints& waypoints);
  std::vector<Literal> shutBy(const SubProblem& part, const Actions& actions, std::size_t action);
  TaskPlan planOf(const TaskWaypoints& waypoints, const std::vector<TimedRows>& rows, std::vector<Config> scenes) const;

  // --- answers
  bool isSpent() const { return attempts_.evaluations >= options_.evaluations || isLate(); }
  bool isLate() const { return std::chrono::steady_clock::now() > deadline_; }
  bool hasPlan() const;
  TaskPlan nothing();
  TaskPlan end(TaskStatus status, std::string message) const;
  std::vector<std::pair<std::string, int>> causesByCount() const;
  std::string firstCause() const;
  void addCause(const std::string& why);

  const Config given_;
  const Config C_;  ///< in which what is held may overlap the robot as it does at the start
  const std::vector<TaskDoor> doors_;
  TaskOptions options_;
  LogicDomain domain_;
  std::string goal_text_;
  std::vector<Literal> goal_, start_;
  MatrixXd limits_;
  std::chrono::steady_clock::time_point deadline_;
  TaskAttempts attempts_;
  LogicProblem problem_;
  std::unique_ptr<PlanSearch> search_;
  std::exception_ptr interruption_;  ///< by `options_.between` while logic was searched
  std::vector<ImpossibleAction> proofs_;
  bool proves_ = true;  ///< are there proofs that make actions impossible?
  bool has_begun_ = false, has_ended_ = false;
  bool guessed_ = false;      ///< is anything forbidden that was not proved?
  bool may_regrasp_ = false;  ///< not tried yet: things may be put down to be grasped in another way
  std::optional<Trial> trial_;
  double best_;  ///< s, of the plans so far
  std::vector<TaskBranch> tree_;
  std::vector<std::pair<std::string, int>> causes_;
  std::map<std::pair<Actions, Circumstances>, std::optional<TaskFailure>> known_;  ///< why actions fail
};

}  // namespace kinegraph
