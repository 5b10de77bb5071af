#pragma once

#include <chrono>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/endpoints.h"
#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/planning/plan_options.h"
#include "kinegraph/planning/smoothing/improve_path.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline planning_internal {

/// planMotion from a start at rest among static obstacles: its stages in turn, and the search for better motions.
///
/// Better paths are searched in rounds. Each round has its own random numbers and samples only the part of the space
/// that can contain a shorter path: for start s, goal g and the cost c of the best path, the bounding box of the
/// ellipsoid |q - s| + |q - g| < c. Each path is shortened and tightened. Searches are independent, and each finds a
/// path close to any given one with positive probability, so that the best path converges to the optimum. Sources:
/// Gammell, Srinivasa, Barfoot, Informed RRT*, 2014; Wilson, Thomason, Kingston, Kavraki, AORRTC, 2025.
class Planner {
 public:
  /// All arguments must outlive the planner.
  Planner(const Config& config, const PlanOptions& options, const CancellationToken& cancellation);

  MotionPlan run(const MotionGoal& goal, const VectorXd& start);

  /// Returns the next motion that is better than those before by a share of at least 1e-4. None if
  /// options.improvement_evaluations are spent, if the time is up, or if no motion can be better.
  std::optional<MotionPlan> better();

 private:
  using Clock = std::chrono::steady_clock;

  /// A start or goal as the search sees it. If it is in slight contact, the search uses a free configuration close by.
  struct SearchEndpoint {
    Endpoint end;
    VectorXd inside;        ///< where the search begins or ends
    bool retreats = false;  ///< `inside` is not the endpoint
    double deepest = 0.;    ///< distance of the deepest pair in contact, m
  };

  bool isCancelled();
  bool isLate() const;
  void endStage(const char* name, long evaluations, std::string note = {});
  bool fail(PlanStatus status, std::string message);
  bool failStopped(const std::string& message);

  SearchEndpoint searchEndpoint(Steering& steering, Endpoint end, const std::string& what);
  bool checkEndpoints(const MotionGoal& goal, const VectorXd& start);
  Clearance clearance(double margin) const;

  PathQuery query();
  bool findPath();
  PathSearchResult searchWithClearance();
  Clearance clearanceOfEndpoints(double margin);
  bool failSearch(const PathSearchResult& found);
  VectorXd weight() const;
  void improve(const PathSearchResult& first);
  void improveFurther();
  void restrictSamples();

  MatrixXd waypoints(const std::vector<VectorXd>& points, const PathSearchResult& found) const;
  Steering& withoutGuard();
  bool verify(const MatrixXd& path, const PathSearchResult& found, long& evaluations);
  double verifiedMargin() const;
  void warnOfMargins(const SearchEndpoint& goal);
  void finish();
  void smooth();

  const Config& config_;
  const PlanOptions& options_;
  const MotionLimits limits_;
  SteeringContexts contexts_;
  const CancellationToken& user_cancellation_;
  const CancellationToken cancellation_;  ///< also true if the time is up
  const Clock::time_point began_ = Clock::now();
  Clock::time_point stage_began_ = began_;
  bool cancelled_ = false;
  MotionPlan plan_;
  JointSpace samples_;  ///< from which configurations are sampled
  PlanningConstraints constraints_;
  SearchEndpoint start_;
  std::vector<SearchEndpoint> goals_;
  std::vector<int> goal_numbers_;
  std::size_t warnings_of_endpoints_ = 0;  ///< number of warnings before those of margins
  ShortcutResult best_;
  int paths_ = 0;     ///< number of paths that were searched so far
  long further_ = 0;  ///< evaluations of further paths
};

/// Plans with a Planner until options.improvement_evaluations are spent.
MotionPlan planFromRest(const Config& config, const MotionGoal& goal, const PlanOptions& options, const VectorXd& start,
                        const CancellationToken& cancellation);

}  // namespace kinegraph::inline planning_internal
