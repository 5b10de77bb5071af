#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/simulation/simulation_options.h"
#include "kinegraph/simulation/simulation_state.h"

namespace kinegraph {

class Config;
class Simulation;

/// A recorded run of a simulation: the scene, the start state, all calls, and the poses after each step. With the same
/// version of the library on the same kind of machine, `replay` repeats it bit for bit.
struct Recording {
  /// A call of the simulation, with its arguments as numbers and names.
  struct Call {
    enum class Kind : int {
      step,
      gripper,
      attach,
      detach,
      spline,
      reset_spline,
      reset_time,
      set_state,
      apply_force,
      clear_forces,
      perturb,
      end_perturbation
    };
    Kind kind = Kind::step;
    std::vector<double> numbers;
    std::vector<std::string> names;
  };

  std::string scene;  ///< as written by sceneToBytes
  SimulationEngine engine = SimulationEngine::physx;
  SimulationOptions options;
  SimulationState start, end;
  std::vector<Call> calls;

  std::vector<double> times;      ///< s, after each step
  std::vector<VectorXd> q;        ///< at these times
  std::vector<MatrixXd> freePos;  ///< F x 7
  std::vector<VectorXd>
      motions;          ///< positions of the engine: all joints, including grippers and followers, and free bodies
  bool is_cut = false;  ///< a change of the scene's structure ended the recording

  std::string toBytes() const;
  static Recording fromBytes(const std::string& bytes);  ///< throws ValueError
  void save(const std::string& path) const;              ///< throws FileError
  static Recording load(const std::string& path);        ///< throws FileError and ValueError

  /// Returns the scene at the start of the run.
  Config makeConfig() const;

  /// Computes the world poses of all frames (by id) after the given steps. Throws ValueError for unknown steps.
  std::vector<std::vector<Pose>> framePoses(const std::vector<std::size_t>& steps) const;

  /// Writes a self-contained HTML page that plays the run, with a time slider. Throws FileError.
  void saveHtml(const std::string& path) const;

  /// Repeats the run on `config`, which makeConfig made. Throws Error if the final state differs from the recorded one.
  Simulation replay(Config& config) const;
};

}  // namespace kinegraph
