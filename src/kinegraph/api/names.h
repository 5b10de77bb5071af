#pragma once

#include <string>

#include "kinegraph/features/feature_source.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "kinegraph/solvers/sampling/sampler.h"
#include "kinegraph/task_planning/lgp/lgp_tool.h"
#include "kinegraph/task_planning/manipulation_helper.h"

#ifndef KINEGRAPH_MODELS  // set by the package of a static library, which cannot know its own location
#define KINEGRAPH_MODELS ""
#endif

namespace kinegraph {

/// Returns the absolute path of a shipped model, as in modelPath("scenarios/pandaSingle.g"), or the folder of all
/// models: modelPath(""). Searches the folder in the environment variable RAI_PATH, the (relocatable) installation
/// prefix of this library (share/kinegraph/models), and `shipped`. Throws FileError with similar names.
std::string modelPath(const std::string& path, const std::string& shipped = KINEGRAPH_MODELS);

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
