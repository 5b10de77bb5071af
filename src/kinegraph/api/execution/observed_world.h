#pragma once

#include <map>
#include <string>
#include <vector>

#include "kinegraph/api/execution/task_execution.h"

namespace kinegraph::inline api_internal {

/// Throws ValueError if an object that actions move has no mass or is a part of a door in a simulated world, or if a
/// motor moves a door there.
void requireMovable(const TaskPlan& plan, const Config& world);

/// Returns the numbers of a robot's grippers by the names of the scene's hands, in whose order a driver lists them; by
/// their own names if their numbers differ.
std::map<std::string, int> grippersOf(const BotOp& bot, const Config& scene);

/// Throws ValueError if a plan closes a hand that is none of these. In a `simulated` world (else null) only hands whose
/// fingers are joints of q are refused: nothing closes those, and hands without fingers hold objects by touch.
void requireGrippers(const TaskPlan& plan, const std::map<std::string, int>& grippers, const Config* simulated);

/// Returns the width to which a plan opens a hand, the gripper of a number, m: `most`, unless wide fingers have no
/// room.
double plannedOpening(const TaskPlan& plan, int number, double most);

/// The world during an execution as it is observed, the objects in hands, and its deviations from a plan.
class ObservedWorld {
 public:
  ObservedWorld(BotOp& bot, Config& seen, std::function<ObservedPoses(Config&)> observe);

  /// Takes over the hands, objects, places and doors of a plan, and the objects that its hands hold at the start.
  void setPlan(const TaskPlan& plan);

  void advance(double seconds);  ///< of control time
  void comeToRest();             ///< lets time pass until no object moves, 3 s at most
  void look();                   ///< observes all objects

  const Config& seen() const { return seen_; }
  bool isSimulated() const { return is_simulated_; }

  // --- hands
  void take(const std::string& obj, const std::string& hand);
  void release(const std::string& obj);
  const std::map<std::string, std::string>& held() const { return held_; }  ///< hands by objects
  bool touches(const std::string& hand, const std::string& obj) const;

  /// The sum of the forces between an object and the links of a hand, N; infinite in a world without contacts.
  double gripForce(const std::string& hand, const std::string& obj) const;
  std::string slipped() const;  ///< the first held object that has moved in its hand since it was taken, or ""

  /// Notes in the scene that objects whose weight has turned them in the hand are to be held closer to their centers of
  /// mass: the attribute `lever` of their frames. Returns these objects.
  std::vector<std::string> shortenLevers();

  // --- the plan
  const std::map<std::string, Eigen::Index>& doors() const { return doors_; }  ///< indices in q
  VectorXd jointErrors(const VectorXd& q) const;                               ///< |q - robot|, without doors

  /// Returns the first deviation from the scene of an action at q, or "". `near` lists the frames that have to be at
  /// their places exactly enough to be grasped or stood on.
  std::string deviation(Config planned, const VectorXd& q, const std::vector<std::string>& near) const;

  /// Returns the first place at which a path in the scene of an action enters observed cells by more than half of a
  /// cell, or "".
  std::string blockedByCells(Config planned, const MatrixXd& path) const;

  /// Returns the literals of a goal about places and doors that do not hold in `C`, which `scene` returned.
  std::vector<std::string> missedGoals(const std::vector<Literal>& goal, const Config& C) const;

  /// The observed world, with held objects attached to hands, and standing objects to their places.
  Config scene() const;

 private:
  void placeBelieved();
  void takeCells(const Config& scene);
  double slipOf(const std::string& obj) const;
  std::string objectDeviation(const std::string& obj, const Config& planned) const;

  BotOp& bot_;
  Config& seen_;
  const std::function<ObservedPoses(Config&)> observe_;
  const bool is_simulated_;
  std::vector<std::string> hands_, objects_, places_;
  std::map<std::string, std::string> held_;
  std::map<std::string, Pose> grips_;     ///< of held objects in the axes of the hand, when they were taken
  std::map<std::string, Pose> believed_;  ///< world poses of objects, or poses in the hand, that cameras observe
  std::map<std::string, Eigen::Index> doors_;
  std::vector<Eigen::Index> driven_;  ///< indices of the other joints in q
};

}  // namespace kinegraph::inline api_internal
