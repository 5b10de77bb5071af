#pragma once

#include <string>
#include <vector>

#include "kinegraph/tool_paths/joint_curve.h"
#include "kinegraph/tool_paths/plan_tool_path.h"
#include "kinegraph/tool_paths/strands.h"

namespace kinegraph::inline tool_paths_internal {

/// Why a path has no solution.
struct PathFailure {
  ToolPathStatus status = ToolPathStatus::no_branch;
  double place = 0.;  ///< s of the curve, m
  std::string text;
  std::vector<std::string> frames;
  std::string joint;
  std::vector<VectorXd> reached;
};

/// The solutions of one path: collision-free joint curves, the best first, or the reason why there is none.
struct PathSolutions {
  std::vector<JointCurve> curves;
  PathFailure failure;
};

struct PathSearchSettings {
  StrandLimits limits;
  ToolTolerance tolerance;
  std::uint64_t seed = 0;
  int wanted = 1;                    ///< number of solutions
  std::vector<VectorXd> first = {};  ///< configurations from which solutions at the start are searched first
  bool only_first = false;           ///< no others
  CancellationToken cancellation = {};
};

/// Searches joint curves along a tool curve. `checker` has the margin.
PathSolutions searchPath(ToolKinematics& tool, const ToolCurve& curve, EdgeChecker& checker,
                         const PathSearchSettings& settings);

}  // namespace kinegraph::inline tool_paths_internal
