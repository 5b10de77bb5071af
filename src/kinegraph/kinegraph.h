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

#include "kinegraph/api/batch_queries.h"        // isValid, isMotionFree, getFramePoses, getDistances
#include "kinegraph/api/camera_view.h"          // CameraView: images
#include "kinegraph/api/custom_feature.h"       // functions of frames as features
#include "kinegraph/api/model_path.h"           // modelPath
#include "kinegraph/api/names.h"                // FS, OT, ST, KOMO, NLP_Solver, ...
#include "kinegraph/api/next_view.h"            // nextView: where to hold a camera
#include "kinegraph/api/recorded_motion.h"      // recordedMotion: a simulated run for the page
#include "kinegraph/api/retime_robot.h"         // retime: a path within the limits of a robot
#include "kinegraph/api/servo.h"                // servo: DiffIk along a TargetFile, a Gamepad, or a dragged target
#include "kinegraph/api/solution_parameters.h"  // Sensitivity: derivatives of solutions
#include "kinegraph/api/solve_all.h"            // several problems at once
#include "kinegraph/api/task_execution.h"       // execution of a task plan by a BotOp
#include "kinegraph/collision/edge_check.h"     // EdgeChecker: collision checks of configurations and edges
#include "kinegraph/collision/limit_check.h"    // withinLimits
#include "kinegraph/common/errors.h"            // exceptions
#include "kinegraph/common/log.h"               // setLogSink: messages of the library
#include "kinegraph/common/random.h"            // Rng
#include "kinegraph/control/diff_ik.h"          // DiffIk: joint velocities, one step at a time
#include "kinegraph/control/mpc.h"              // Mpc: model predictive control
#include "kinegraph/exporters/gltf_writer.h"    // scenes written as files
#include "kinegraph/exporters/mesh_export.h"
#include "kinegraph/exporters/mjcf_writer.h"
#include "kinegraph/exporters/scene_writer.h"
#include "kinegraph/exporters/urdf_writer.h"
#include "kinegraph/features/batch.h"      // many configurations at once
#include "kinegraph/features/eval.h"       // value and Jacobian of a feature
#include "kinegraph/ik/solve_ik.h"         // solveIk
#include "kinegraph/komo/komo.h"           // Komo: motion problems
#include "kinegraph/komo/report.h"         // costs and violations of a path
#include "kinegraph/komo/step_limit.h"     // addStepLimit
#include "kinegraph/logic/action_words.h"  // statesAlong
#include "kinegraph/logic/fol_reader.h"    // domains of actions
#include "kinegraph/logic/pddl.h"
#include "kinegraph/logic/plan_search.h"                      // PlanSearch
#include "kinegraph/nlp/callback_nlp.h"                       // custom problems
#include "kinegraph/nlp/test_problems.h"                      // named problems
#include "kinegraph/perception/calibrate_camera.h"            // calibrateCamera: camera to hand or to base
#include "kinegraph/perception/occupancy_map.h"               // OccupancyMap: free, occupied and unseen space
#include "kinegraph/perception/register_scene.h"              // registerScene: poses from depth images
#include "kinegraph/perception/scene_observer.h"              // SceneObserver: cameras in the loop
#include "kinegraph/planning/path_finder.h"                   // paths between two configurations
#include "kinegraph/planning/plan_motion.h"                   // planMotion
#include "kinegraph/planning/plan_motions.h"                  // MotionPlans: ever better plans
#include "kinegraph/planning/refine_path.h"                   // shortcut, smooth
#include "kinegraph/planning/roadmap.h"                       // Roadmap
#include "kinegraph/rendering/camera_renderer.h"              // images from any camera
#include "kinegraph/rendering/depth_image.h"                  // points of a depth image
#include "kinegraph/rendering/framing.h"                      // a camera that sees the whole scene
#include "kinegraph/rendering/picture_renderer.h"             // pictures that look like the viewer's page
#include "kinegraph/robot/bot_op.h"                           // BotOp
#include "kinegraph/robot/kinematic_driver.h"                 // robots that follow commands exactly
#include "kinegraph/robot/recorded_driver.h"                  // robots with known answers
#include "kinegraph/robot/simulated_driver.h"                 // robots in a simulated world
#include "kinegraph/scene/config.h"                           // Config, Frame
#include "kinegraph/scene/config_dynamics.h"                  // rigidBodyDynamics, centroidalMomentumMatrix
#include "kinegraph/scene/frame_attributes.h"                 // setAttributes
#include "kinegraph/scene/frame_cells.h"                      // setCells: cubes as an obstacle
#include "kinegraph/scene/frame_shapes.h"                     // setLines, setMeshFile, setTexture, setSdf
#include "kinegraph/scene/ignored_contacts.h"                 // ignoreCollisionsNow
#include "kinegraph/scene/motor_limits.h"                     // getVelocityLimits, getEffortLimits
#include "kinegraph/scene/self_collisions.h"                  // selfCollisionMatrix
#include "kinegraph/simulation/simulation.h"                  // Simulation
#include "kinegraph/simulation/simulation_batch.h"            // many simulations
#include "kinegraph/solvers/explanation.h"                    // explanations of infeasibility
#include "kinegraph/solvers/methods.h"                        // methods of NlpSolver
#include "kinegraph/solvers/nlp_solver.h"                     // NlpSolver
#include "kinegraph/solvers/sampling/sampler.h"               // NlpSampler
#include "kinegraph/task_planning/lgp/lgp_tool.h"             // LGP_Tool, default_LGP_TAMP_Abstraction
#include "kinegraph/task_planning/manipulation_helper.h"      // grasps, placements, pushes
#include "kinegraph/task_planning/scene_facts.h"              // logical facts of a scene
#include "kinegraph/task_planning/search/check_task_plan.h"   // checkTaskPlan
#include "kinegraph/task_planning/search/plan_task.h"         // planTask, planTasks
#include "kinegraph/tool_paths/free_curve.h"                  // firstContact
#include "kinegraph/tool_paths/nearest_limit.h"               // nearestLimit
#include "kinegraph/tool_paths/plan_tool_path.h"              // ToolPath, planToolPath
#include "kinegraph/trajectories/b_spline.h"                  // BSpline
#include "kinegraph/trajectories/retime.h"                    // retime: the fastest motion along a path
#include "kinegraph/trajectories/sampled_trajectory.h"        // a trajectory through given states
#include "kinegraph/trajectories/spline_trajectory.h"         // a BSpline as a trajectory
#include "kinegraph/trajectories/trajectory.h"                // Trajectory: the interface of timed motions
#include "kinegraph/trajectory_optimization/multi_start.h"    // one problem from many starts
#include "kinegraph/trajectory_optimization/skeleton.h"       // sequences of modes and constraints
#include "kinegraph/trajectory_optimization/spline_motion.h"  // motion problems in control points
#include "kinegraph/viewer/config_viewer.h"                   // the viewer in the browser
#include "kinegraph/viewer/motions.h"                         // motions for the viewer
#include "kinegraph/viewer/watch_file.h"                      // a scene file that is shown after each change
