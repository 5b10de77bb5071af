#pragma once

#include <chrono>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/planning/plan_options.h"
#include "kinegraph/planning/smoothing/improve_path.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// planMotion from a start at rest among obstacles that stand still: its stages, one after the other, and what is done to
/// find better motions.
///
/// Further ways are searched in rounds: always with other random numbers, and in the part of the space through which a
/// shorter way could go: of start s and goal g, the box around the ellipsoid |q - s| + |q - g| < c, with the cost c of the
/// best way so far. Each is shortened and pulled taut. Each search is independent of the others, and finds a way next to
/// any given one with a chance that is not zero; so the best one comes as near to the best of all as is wished, if effort
/// is spent long enough. Sources: Gammell, Srinivasa, Barfoot, Informed RRT*, 2014; Wilson, Thomason, Kingston, Kavraki,
/// AORRTC, 2025.
class Planner {
 public:
  /// All of them must stay.
  Planner(const Config& config, const PlanOptions& options, const CancellationToken& cancellation);

  MotionPlan run(const MotionGoal& goal, const VectorXd& start);

  /// The next motion that is better than those before, by a share of 1e-4 at least; none once options.improvement_evaluations evaluations
  /// are spent, or the time is up, or where none can be better.
  std::optional<MotionPlan> better();

 private:
  using Clock = std::chrono::steady_clock;

  /// A start or goal as the search sees it: where it is blocked by a slight contact, the posture behind it.
  struct SearchEndpoint {
    Endpoint end;
    VectorXd inside;  ///< from where the search begins
    bool leaves = false;
    double deepest = 0.;  ///< of the contact that is left, m
  };

  bool isCancelled();
  bool isLate() const;
  void endStage(const char* name, long evaluations, std::string note = {});
  bool fail(PlanStatus status, std::string message);
  bool failStopped(const std::string& message);

  SearchEndpoint searchEndpoint(Steering& steering, Endpoint end, const std::string& what);
  bool checkEndpoints(const MotionGoal& goal, const VectorXd& start);
  Clearance clearance(double margin) const;

  PathQuery request();
  bool findPath();
  Way searchWithRoom();
  Clearance withEndsAt(double margin);
  bool failSearch(const Way& way);
  VectorXd weight() const;
  void improve(const Way& first);
  void improveFurther();
  void drawWhereShorter();

  MatrixXd rows(const std::vector<VectorXd>& points, const Way& way) const;
  Steering& exactly();
  bool verify(const MatrixXd& path, const Way& way, long& evaluations);
  double verified_margin() const;
  void finish();
  void bend();

  const Config& config_;
  const PlanOptions& options_;
  const MotionLimits limits_;
  SteeringContexts contexts_;
  const CancellationToken& user_cancellation_;  ///< of the caller
  const CancellationToken cancellation_;
  const Clock::time_point began_ = Clock::now();
  Clock::time_point stage_began_ = began_;
  bool cancelled_ = false;
  MotionPlan plan_;
  JointSpace draws_;  ///< from which postures are drawn
  PlanningConstraints planning_constraints_;
  SearchEndpoint start_;
  std::vector<SearchEndpoint> goals_;
  std::vector<int> goal_numbers_;
  ShortcutResult best_;
  int tries_ = 0;     ///< ways that were searched so far
  long further_ = 0;  ///< evaluations that further ones took
};

/// What a Planner finds with all of options.improvement_evaluations.
MotionPlan planFromRest(const Config& config, const MotionGoal& goal, const PlanOptions& options, const VectorXd& start,
                        const CancellationToken& cancellation);

}  // namespace kinegraph
