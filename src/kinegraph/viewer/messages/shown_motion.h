#pragma once

#include <string>
#include <vector>

#include "kinegraph/math/pose.h"
#include "kinegraph/viewer/messages/near_lines.h"

namespace kinegraph {

/// A motion that is sent as a whole, and played in the browser.
struct ShownMotion {
  enum class Start { all, play, pause };  ///< all slices at once, playing, or at `first`

  double seconds = 0.;  ///< duration of all slices together
  Start start = Start::all;
  int first = 0;                         ///< slice that is shown first
  std::vector<std::vector<Pose>> poses;  ///< per slice: of all frames, in the world
  MatrixXd q;                            ///< slices x dofs; may be empty
  std::vector<std::string> texts;        ///< per slice, or none
  std::vector<double> violations;        ///< per slice: how much of the constraints is violated; or none
  int prefix = 0;                        ///< so many slices lie before the one that is called 0
  std::vector<std::vector<int>> marked;  ///< per slice: frames whose constraints are violated; or none

  /// Per slice: pairs of shapes that are nearer, or farther apart, than a constraint allows; or none.
  std::vector<std::vector<NearLine>> touching;

  /// An error, or whatever else there is a number of per slice.
  struct Trace {
    std::string name;
    std::string type;            ///< of the objective: sos, eq ...
    std::vector<double> values;  ///< per slice
  };
  std::vector<Trace> traces;
};

}  // namespace kinegraph
