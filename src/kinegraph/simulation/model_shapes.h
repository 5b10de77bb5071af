#pragma once

#include <array>
#include <map>
#include <string>

#include "kinegraph/simulation/scene_model.h"

namespace kinegraph::inline simulation_internal {

constexpr int kGroundBody = -1;  ///< ModelShapes::Geom::body of the ground
inline int fixedBody(int frame) { return -2 - frame; }

/// Adds the shapes of frames to a model under construction; frames with the same mesh share it.
class ModelShapes {
 public:
  ModelShapes(mjSpec* spec, const SimulationOptions& options) : spec_(spec), options_(options) {}

  /// Adds the shape of a frame to a body, as several geoms if it has several parts. `robot` is -1 outside robots.
  void add(const FrameData& frame, mjsBody* body, const Pose& X_BF, int robot);

  void addGround();

  /// Disables contacts between two bodies, except those listed by addPairs.
  void exclude(const std::string& a, const std::string& b);

  /// Pairs of bodies, as in Geom::body.
  using BodyPairs = std::set<std::pair<int, int>>;

  /// Lists the pairs of geoms whose contacts the contact bits of robots do not express: pairs within a robot that
  /// collide in plans, unless the robot is `declared`; pairs of bodies of which some shapes collide in plans and some
  /// do not; and pairs with different frictions, so that the mean of both counts (with `all_listed` every pair with a
  /// friction attribute, because it may be changed later). Disables contacts of pairs that never collide in plans.
  /// `overlapping` contains the body pairs without contacts.
  void addPairs(const ContactRules& rules, const std::vector<bool>& declared, const BodyPairs& overlapping,
                bool all_listed);

  struct Geom {
    mjsGeom* spec;
    std::string name;
    std::string body_name;
    int frame, body;  ///< body as in SceneBodies; frames fixed to the world have one negative number each
    int robot;
    bool moves;
    std::array<double, 3> friction;  ///< sliding, and torsional and rolling, m
    bool largest;                    ///< of two such geoms the larger friction counts, else the mean
    bool has_friction;               ///< the frame has the attribute
    double restitution;
  };
  std::vector<Geom> geoms;
  int body_number = 0;  ///< of the body that receives the geoms
  std::string body_name;
  bool body_moves = false;

 private:
  mjsGeom* addGeom(mjsBody* body, const FrameData& frame, const Pose& X_BF, int robot);
  void addBody(const CollisionBody& core, const FrameData& frame, mjsBody* body, const Pose& X_BF, int robot);
  void addPair(const Geom& a, const Geom& b);
  void setMesh(mjsGeom* geom, const std::vector<Vector3d>& points, const void* key);

  mjSpec* spec_;
  const SimulationOptions& options_;
  std::map<const void*, std::string> meshes_;
};

}  // namespace kinegraph::inline simulation_internal
