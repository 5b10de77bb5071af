#pragma once

#include <chrono>
#include <compare>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/logic/plan_search.h"
#include "kinegraph/task_planning/search/plan_task.h"
#include "kinegraph/task_planning/search/task_proofs.h"
#include "kinegraph/task_planning/search/task_trials.h"
#include "kinegraph/task_planning/task_doors.h"

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
    std::vector<std::vector<Literal>> states;                    ///< along them
    int seed = 0;                                                ///< of the waypoints that come next
    bool found = false;                                          ///< was there a plan?
    std::optional<TaskFailure> failure = {};                     ///< of motions
    std::map<int, Speculative<TaskTrials::Outcome>> later = {};  ///< by seed
  };

  /// What was tried; why it was given up is found out in the end.
  struct Branch {
    Actions actions;
    std::string words;  ///< before the cause
    TaskCause cause;    ///< null: there is nothing to find out
    bool is_given_up = false;
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

  // --- waypoints
  std::shared_ptr<const Config> sceneIn(const Circumstances& there) const;
  void expect(const Actions& actions, const Circumstances& there, Priority first);
  void expectAll(const std::vector<Actions>& all, Priority first);
  std::vector<Actions> unknownBeginnings(const Actions& actions) const;
  void expectNothing();
  TaskAttempt::Found waypointsOf(const Actions& actions, const Circumstances& there);
  bool isKnownToFail(const Actions& actions) const;

  // --- in geometry
  Speculative<TaskTrials::Outcome> outcomeOf(const Trial& trial, int seed, Priority wanted);
  std::optional<TaskPlan> nextOf(Trial& trial);
  void conclude(const Trial& trial);
  TaskCause causeOf(const TaskFailure& failure);
  void giveUp(const Actions& actions, const std::string& words, TaskCause cause);
  void forbidFailing(const Actions& actions);
  void forbidLast(const Actions& beginning, const std::optional<std::vector<Literal>>& facts);
  const TaskCause& failureOf(const Actions& actions, const Circumstances& there = {});
  std::vector<Literal> withoutConstantDoors(std::vector<Literal> facts) const;
  std::string missingOfDoors() const;
  std::vector<Literal> doorsThatMatter(const Actions& actions, const Circumstances& there);

  // --- answers
  std::optional<TaskPlan> nextPlan();
  bool isSpent() const { return evaluations_ >= options_.evaluations || isLate(); }
  bool isLate() const { return std::chrono::steady_clock::now() > deadline_; }
  bool hasPlan() const;
  TaskPlan nothing();
  TaskPlan end(TaskStatus status, std::string message);
  TaskPlan completed(TaskPlan plan);
  void settle();
  std::vector<std::pair<std::string, int>> causesByCount() const;
  std::string firstCause();
  void addCause(const std::string& why);

  const std::shared_ptr<const Config> given_;
  const Config C_;  ///< in which what is held may overlap the robot as it does at the start
  const std::vector<TaskDoor> doors_;
  TaskOptions options_;
  LogicDomain domain_;
  std::string goal_text_;
  std::vector<Literal> goal_, start_;
  MatrixXd limits_;
  std::chrono::steady_clock::time_point deadline_;
  const TaskAttempt::Settings settings_;
  long evaluations_ = 0;  ///< so far
  LogicProblem problem_;
  std::unique_ptr<PlanSearch> search_;
  std::exception_ptr interruption_;  ///< by `options_.between` while logic was searched
  std::vector<ImpossibleAction> proofs_;
  bool proves_ = true;  ///< are there proofs that make actions impossible?
  bool has_begun_ = false, has_ended_ = false;
  bool guessed_ = false;      ///< is anything forbidden that was not proved?
  bool may_regrasp_ = false;  ///< not tried yet: things may be put down to be grasped in another way
  std::optional<Trial> trial_;
  double best_;                   ///< s, of the plans so far
  std::vector<Branch> branches_;  ///< of which the causes are not known yet; they come after those of tree_
  std::vector<TaskBranch> tree_;
  std::vector<std::pair<std::string, int>> causes_;
  std::map<std::pair<Actions, Circumstances>, TaskCause> known_;  ///< why actions fail; null: they do not
  bool needs_seeds_ = false;                                      ///< has a plan with waypoints had no motion?
  const std::shared_ptr<const Config> scene_;                     ///< a copy of C_ that threads share
  std::shared_ptr<const TaskTrials> trials_;
  std::mutex expecting_;
  SpeculativeExecutor ahead_;
  std::map<std::pair<Actions, Circumstances>, TaskAttempt> expected_;  ///< that may be worked at
};

}  // namespace kinegraph
