#pragma once

#include <map>
#include <string>

#include "kinegraph/simulation/scene_model.h"

namespace kinegraph {

constexpr int kGroundBody = -1;  ///< ModelShapes::Geom::body of the ground
inline int fixedBody(int frame) { return -2 - frame; }

/// Enters shapes of frames into a model that is being made, and remembers the meshes that they share.
class ModelShapes {
 public:
  ModelShapes(mjSpec* spec, const SimulationOptions& options) : spec_(spec), options_(options) {}

  /// The shape of a frame on a body. `robot` is -1 for things. Several geoms where it has several parts.
  void add(const FrameData& frame, mjsBody* body, const Pose& X_BF, int robot);

  void addGround();

  /// Two bodies never touch: those of robots that overlap at the start with others of their tree.
  void exclude(const std::string& a, const std::string& b);

  /// Where frictions differ the mean counts, as pairs of geoms, or where one is given and may be changed. `excluded` tells
  /// pairs of bodies that never touch.
  void addFrictionPairs(const std::set<std::pair<int, int>>& excluded, bool all_given);

  struct Geom {
    mjsGeom* spec;
    std::string name;
    int frame, body;  ///< body as in SceneBodies; what is fixed to the world has one for each frame, below 0
    int robot;
    bool moves;
    double friction;
    bool is_given;  ///< by the frame's attribute
  };
  std::vector<Geom> geoms;
  int body_number = 0;  ///< of the body that geoms are added to
  bool body_moves = false;

 private:
  mjsGeom* addGeom(mjsBody* body, const FrameData& frame, const Pose& X_BF, int robot);
  void addBody(const CollisionBody& core, const FrameData& frame, mjsBody* body, const Pose& X_BF, int robot);
  void setMesh(mjsGeom* geom, const std::vector<Vector3d>& points, const void* key);

  mjSpec* spec_;
  const SimulationOptions& options_;
  std::map<const void*, std::string> meshes_;
};

}  // namespace kinegraph
