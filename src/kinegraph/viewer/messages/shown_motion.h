#pragma once

#include <string>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// The shortest line between two shapes of a collision pair.
struct NearLine {
  Vector3d a, b;      ///< endpoints on the surfaces, world, m
  double distance;    ///< m, negative: penetration depth
  std::string names;  ///< of the frames
};

/// A motion that is sent completely and played in the browser.
struct ShownMotion {
  enum class Start { all, play, pause };  ///< all slices at once, playing, or paused at `first`

  double seconds = 0.;  ///< duration of all slices together
  Start start = Start::all;
  int first = 0;                         ///< first slice shown
  std::vector<std::vector<Pose>> poses;  ///< per slice: world poses of all frames
  MatrixXd q;                            ///< slices x dofs; may be empty
  std::vector<std::string> texts;        ///< per slice, or none
  std::vector<double> violations;        ///< per slice: violation of the constraints; may be empty
  int prefix = 0;                        ///< number of slices before slice 0
  std::vector<std::vector<int>> marked;  ///< per slice: frames of violated constraints; may be empty

  /// Per slice: pairs of shapes that violate a distance constraint; may be empty.
  std::vector<std::vector<NearLine>> touching;

  /// Values per slice, such as an error.
  struct Trace {
    std::string name;
    std::string type;            ///< of the objective: sos, eq ...
    std::vector<double> values;  ///< per slice
  };
  std::vector<Trace> traces;
};

}  // namespace kinegraph
