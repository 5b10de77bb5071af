#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/simulation/simulation_options.h"
#include "kinegraph/simulation/simulation_state.h"

namespace kinegraph {

class Config;
class Simulation;

/// A run of a simulation: the scene, where it started, what was asked of it, and where everything was after each step. Of the
/// same version of the library on the same kind of machine, `replay` repeats it bit for bit.
struct Recording {
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
      push,
      clear_pushes,
      pull,
      end_pull
    };
    Kind kind = Kind::step;
    std::vector<double> numbers;
    std::vector<std::string> words;
  };

  std::string scene;  ///< as sceneToBytes
  SimulationEngine engine = SimulationEngine::physx;
  SimulationOptions options;
  SimulationState start, end;
  std::vector<Call> calls;

  std::vector<double> times;      ///< s, after each step
  std::vector<VectorXd> q;        ///< then
  std::vector<MatrixXd> freePos;  ///< F x 7
  std::vector<VectorXd>
      motions;          ///< of all joints, grippers' and followers' too, and of free bodies, as the engine has them
  bool is_cut = false;  ///< the structure of the scene changed: it ends there

  std::string toBytes() const;
  static Recording fromBytes(const std::string& bytes);  ///< throws ValueError
  void save(const std::string& path) const;              ///< throws FileError
  static Recording load(const std::string& path);        ///< throws FileError and ValueError

  /// The scene as it was at the start.
  Config makeConfig() const;

  /// World poses of all frames (by id) after some of the steps. Throws ValueError for steps that are not there.
  std::vector<std::vector<Pose>> framePoses(const std::vector<std::size_t>& steps) const;

  /// A page that plays the run, with a time slider, and needs no program. Throws FileError.
  void saveHtml(const std::string& path) const;

  /// Does it all again on `config`, which makeConfig made. Throws Error if it ends otherwise than it did.
  Simulation replay(const Config& config) const;
};

}  // namespace kinegraph
