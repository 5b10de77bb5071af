#pragma once

#include <map>
#include <string>

#include "kinegraph/simulation/scene_model.h"

namespace kinegraph {

constexpr int kGroundBody = -1;  ///< ModelShapes::Geom::body of the ground
inline int fixedBody(int frame) { return -2 - frame; }

/// Adds the shapes of frames to a model under construction; frames with the same mesh share it.
class ModelShapes {
 public:
  ModelShapes(mjSpec* spec, const SimulationOptions& options) : spec_(spec), options_(options) {}

  /// Adds the shape of a frame to a body, as several geoms if it has several parts. `robot` is -1 outside robots.
  void add(const FrameData& frame, mjsBody* body, const Pose& X_BF, int robot);

  void addGround();

  /// Disables contacts between two bodies, for links of a robot that overlap others of their tree at the start.
  void exclude(const std::string& a, const std::string& b);

  /// Lists pairs of geoms with different frictions, so that the mean of both counts. With `all_listed`, lists every
  /// pair with a friction attribute, because it may be changed later. `excluded` contains the body pairs without
  /// contacts.
  void addFrictionPairs(const std::set<std::pair<int, int>>& excluded, bool all_listed);

  struct Geom {
    mjsGeom* spec;
    std::string name;
    int frame, body;  ///< body as in SceneBodies; frames fixed to the world have one negative number each
    int robot;
    bool moves;
    double friction;
    bool has_friction;  ///< the frame has the attribute
  };
  std::vector<Geom> geoms;
  int body_number = 0;  ///< of the body that receives the geoms
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
