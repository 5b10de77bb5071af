#pragma once

#include "kinegraph/api/model_path.h"
#include "kinegraph/features/registry.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/sampling/sampler.h"
#include "kinegraph/solvers/solve_many.h"
#include "kinegraph/task_planning/lgp/lgp_tool.h"
#include "kinegraph/task_planning/manipulation_helper.h"

namespace kinegraph {

class PathFinder;

// The names of Python scripts. With `namespace ry = kinegraph;` a line of Python is nearly a line of C++.

using FS = FeatureSymbol;
using OT = ObjectiveType;
using ST = ShapeType;
using JT = JointType;
using SY = SwitchMode;
using KOMO = Komo;
using KOMO_ManipulationHelper = ManipulationHelper;
using ManipulationModelling = ManipulationHelper;
using LGP_Tool = LgpTool;
using LGP_TAMP_Abstraction = LgpAbstraction;
using default_LGP_TAMP_Abstraction = DefaultLgpAbstraction;
using RRT_PathFinder = PathFinder;
using NLP = Nlp;
using NLP_Solver = NlpSolver;
using NLP_Sampler = NlpSampler;
using NLP_SolverOptions = SolverOptions;
using SolverReturn = SolverResult;
using SolverReturns = SolveManyResult;

/// Indices of a BotOp's grippers.
inline constexpr int _left = 0, _right = 1;

/// Same as modelPath; also accepts the older spellings '../rai-robotModels/...' and 'rai-robotModels/...'.
std::string raiPath(const std::string& path);

}  // namespace kinegraph
