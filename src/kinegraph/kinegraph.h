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
/// One header for all that Python's `import kinegraph as ry` has, under the same names; docs/cpp.md says how to build
/// with it. Lengths are in m, angles in rad, quaternions (w, x, y, z), poses (x, y, z, qw, qx, qy, qz).

#include "kinegraph/base/errors.h"          // what is thrown
#include "kinegraph/base/random.h"          // Rng
#include "kinegraph/control/diff_ik.h"      // DiffIk: joint velocities, a step at a time
#include "kinegraph/control/mpc.h"          // Mpc: a motion problem, solved while time goes on
#include "kinegraph/features/batch.h"       // many configurations at once
#include "kinegraph/features/eval.h"        // a feature's value and Jacobian
#include "kinegraph/formats/gltf_writer.h"  // scenes written as files
#include "kinegraph/formats/mesh_export.h"
#include "kinegraph/formats/mjcf_writer.h"
#include "kinegraph/formats/scene_writer.h"
#include "kinegraph/formats/urdf_writer.h"
#include "kinegraph/front/camera_view.h"          // CameraView: images
#include "kinegraph/front/drive.h"                // drive: DiffIk along TargetFile, Gamepad, or by hand
#include "kinegraph/front/model_path.h"           // modelPath
#include "kinegraph/front/names.h"                // FS, OT, ST, KOMO, NLP_Solver, ...
#include "kinegraph/front/own_feature.h"          // functions of frames as features
#include "kinegraph/front/recorded_motion.h"      // recordedMotion: a simulated run as a page plays it
#include "kinegraph/front/retime_robot.h"         // retime: a robot's path, by its limits
#include "kinegraph/front/solution_parameters.h"  // Sensitivity: how solutions move with targets, poses, scales
#include "kinegraph/front/solve_all.h"            // several problems at once
#include "kinegraph/front/task_execution.h"       // a plan of a task carried out by a BotOp
#include "kinegraph/ik/solve_ik.h"                // solveIk
#include "kinegraph/kinematics/edge_check.h"      // EdgeChecker: is a q, is an edge free?
#include "kinegraph/kinematics/limit_check.h"     // withinLimits
#include "kinegraph/komo/komo.h"                  // Komo: motion problems
#include "kinegraph/komo/report.h"                // how well a path does
#include "kinegraph/komo/step_limit.h"            // addStepLimit
#include "kinegraph/logic/action_words.h"         // statesAlong
#include "kinegraph/logic/fol_reader.h"           // domains of actions
#include "kinegraph/logic/pddl.h"
#include "kinegraph/logic/plan_search.h"             // PlanSearch
#include "kinegraph/motion/path_finder.h"            // paths between two postures
#include "kinegraph/motion/plan_motion.h"            // planMotion
#include "kinegraph/motion/plan_motions.h"           // MotionPlans: better and better ones
#include "kinegraph/motion/refine_path.h"            // shortcut, smooth
#include "kinegraph/motion/roadmap.h"                // Roadmap
#include "kinegraph/nlp/callback_nlp.h"              // problems of your own
#include "kinegraph/nlp/test_problems.h"             // named problems
#include "kinegraph/operation/bot_op.h"              // BotOp
#include "kinegraph/operation/kinematic_driver.h"    // robots that go exactly where they are told
#include "kinegraph/operation/recorded_driver.h"     // robots whose answers are known
#include "kinegraph/operation/simulated_driver.h"    // robots in a simulated world
#include "kinegraph/planning/multi_start.h"          // one problem from many starts
#include "kinegraph/planning/skeleton.h"             // what shall hold when, in words
#include "kinegraph/planning/spline_motion.h"        // motion problems in control points
#include "kinegraph/rendering/camera_renderer.h"     // images from any camera
#include "kinegraph/rendering/depth_image.h"         // points of a depth image
#include "kinegraph/rendering/framing.h"             // a camera that sees all
#include "kinegraph/scene/config.h"                  // Config, Frame
#include "kinegraph/scene/config_dynamics.h"         // rigidBodyDynamics, centroidalMomentumMatrix
#include "kinegraph/scene/ignored_contacts.h"        // ignoreCollisionsNow
#include "kinegraph/scene/motor_limits.h"            // getVelocityLimits, getEffortLimits
#include "kinegraph/scene/self_collisions.h"         // selfCollisionMatrix
#include "kinegraph/simulation/simulation.h"         // Simulation
#include "kinegraph/simulation/simulation_batch.h"   // many of them
#include "kinegraph/solvers/explanation.h"           // why constraints do not hold
#include "kinegraph/solvers/methods.h"               // the methods of NlpSolver
#include "kinegraph/solvers/nlp_solver.h"            // NlpSolver
#include "kinegraph/solvers/sampling/sampler.h"      // NlpSampler
#include "kinegraph/spline/b_spline.h"               // BSpline
#include "kinegraph/spline/retime.h"                 // retime: the fastest motion along a path
#include "kinegraph/tasks/lgp/lgp_tool.h"            // LGP_Tool, default_LGP_TAMP_Abstraction
#include "kinegraph/tasks/manipulation_helper.h"     // grasps, placements, pushes
#include "kinegraph/tasks/scene_facts.h"             // what a scene says in logic
#include "kinegraph/tasks/search/check_task_plan.h"  // checkTaskPlan
#include "kinegraph/tasks/search/plan_task.h"        // planTask, planTasks
#include "kinegraph/viewer/config_viewer.h"          // the viewer in the browser
#include "kinegraph/viewer/motions.h"                // motions to show there
#include "kinegraph/viewer/watch_file.h"             // a scene file shown whenever it changes
