#pragma once

/// Kinegraph: robot scenes, differentiable features, inverse kinematics and k-order motion optimization.
///
///     #include <kinegraph/kinegraph.h>
///     using namespace kinegraph;
///
///     Config C;
///     C.addFile(modelPath("scenarios/pandaSingle.g"));
///     C.view();
///
/// This header declares everything that `import kinegraph as ry` has in Python, under the same names. docs/cpp.md
/// explains how to build with it. Lengths are in m, angles in rad, quaternions (w, x, y, z), poses
/// (x, y, z, qw, qx, qy, qz).

#include "kinegraph/common/compiler_check.h"

#include "kinegraph/api/batch_queries.h"             // isValid, isMotionFree, getFramePoses, getDistances
#include "kinegraph/api/camera_view.h"               // CameraView: images
#include "kinegraph/api/custom_feature.h"            // functions of frames as features
#include "kinegraph/api/execution/task_execution.h"  // execution of a task plan by a BotOp
#include "kinegraph/api/names.h"                     // modelPath; FS, OT, ST, KOMO, NLP_Solver, ...
#include "kinegraph/api/next_view.h"                 // nextView: where to hold a camera
#include "kinegraph/api/recorded_motion.h"           // recordedMotion: a simulated run for the page
#include "kinegraph/api/robot_motion.h"  // retime of a robot's path; servo: DiffIk along a target that moves
#include "kinegraph/api/solutions.h"     // Sensitivity: derivatives of solutions; solveAll: several problems at once
#include "kinegraph/collision/edge_check.h"  // EdgeChecker: collision checks of configurations and edges; withinLimits
#include "kinegraph/common/errors.h"         // exceptions
#include "kinegraph/common/log.h"            // setLogSink: messages of the library
#include "kinegraph/common/random.h"         // Rng
#include "kinegraph/control/diff_ik.h"       // DiffIk: joint velocities, one step at a time
#include "kinegraph/control/mpc.h"           // Mpc: model predictive control
#include "kinegraph/exporters/writers.h"     // scenes written as files
#include "kinegraph/features/eval.h"         // value and Jacobian of a feature; many configurations at once
#include "kinegraph/ik/solve_ik.h"           // solveIk
#include "kinegraph/komo/komo.h"             // Komo: motion problems, their report, and addStepLimit
#include "kinegraph/logic/domain.h"          // domains of actions, from .fol files and PDDL
#include "kinegraph/logic/grounding.h"       // grounded actions, statesAlong
#include "kinegraph/logic/plan_search.h"     // PlanSearch
#include "kinegraph/nlp/problems.h"          // custom problems and named ones
#include "kinegraph/perception/calibrate_camera.h"  // calibrateCamera: camera to hand or to base
#include "kinegraph/perception/occupancy_map.h"     // OccupancyMap: free, occupied and unseen space
#include "kinegraph/perception/register_scene.h"    // registerScene: poses from depth images
#include "kinegraph/perception/scene_observer.h"    // SceneObserver: cameras in the loop
#include "kinegraph/planning/path_finder.h"         // PathFinder; shortcut, smooth
#include "kinegraph/planning/plan_motion.h"         // planMotion; planMotions: ever better plans
#include "kinegraph/planning/roadmap.h"             // Roadmap
#include "kinegraph/rendering/camera_renderer.h"    // images from any camera, points of a depth image
#include "kinegraph/rendering/picture_renderer.h"   // pictures that look like the viewer's page
#include "kinegraph/robot/bot_op.h"                 // BotOp
#include "kinegraph/robot/drivers.h"                // simulated robots, and robots with exact or known answers
#include "kinegraph/scene/collisions.h"             // selfCollisionMatrix, ignoreCollisionsNow, setCells
#include "kinegraph/scene/config.h"                 // Config, Frame
#include "kinegraph/scene/dynamics.h"               // rigidBodyDynamics, getVelocityLimits, getEffortLimits
#include "kinegraph/scene/frame_setters.h"          // setAttributes, setMeshFile, setLines, setSdf
#include "kinegraph/simulation/simulation.h"        // Simulation; SimulationBatch
#include "kinegraph/solvers/nlp_solver.h"        // NlpSolver and its methods, solveMany, explanations of infeasibility
#include "kinegraph/solvers/sampling/sampler.h"  // NlpSampler
#include "kinegraph/task_planning/lgp/lgp_tool.h"               // LGP_Tool, default_LGP_TAMP_Abstraction
#include "kinegraph/task_planning/manipulation_helper.h"        // grasps, placements, pushes
#include "kinegraph/task_planning/search/plan_task.h"           // planTask, planTasks, checkTaskPlan
#include "kinegraph/task_planning/task_actions.h"               // sceneFacts, doorStates; actions and their rules
#include "kinegraph/tool_paths/plan_tool_path.h"                // ToolPath, planToolPath, firstContact, nearestLimit
#include "kinegraph/trajectories/retime.h"                      // retime: the fastest motion along a path
#include "kinegraph/trajectories/trajectory.h"                  // Trajectory, BSpline and trajectories through samples
#include "kinegraph/trajectory_optimization/motion_problems.h"  // many starts, skeletons, motions as splines
#include "kinegraph/viewer/config_viewer.h"                     // the viewer in the browser, motions, watched files
