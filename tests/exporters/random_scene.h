#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/scene/frame_setters.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

inline int pick(Rng& rng, int count) { return int(rng.uniform(0., count)); }

inline Pose randomPose(Rng& rng) {
  const Vector4d q(rng.normal(), rng.normal(), rng.normal(), rng.normal());
  return {Vector3d(rng.normal(), rng.normal(), rng.normal()), unitQuaternion(q)};
}

inline std::string randomName(Rng& rng, int id) {
  static const std::vector<std::string> odd = {"",   "x y",     "a(b)", "q",    "shape", "n:1",
                                               "#n", "Include", "{n}",  "r\"s", "same"};
  return pick(rng, 6) == 0 ? odd[std::size_t(pick(rng, int(odd.size())))] : "f" + std::to_string(id);
}

inline Value randomValue(Rng& rng, int depth) {
  static const std::vector<std::string> texts = {"word",       "two words", "true", "1.5",     "",   "it's",
                                                 "say \"it\"", "a/b",       "-",    "x: 1, y", "inf"};
  const auto text = [&] { return texts[std::size_t(pick(rng, int(texts.size())))]; };
  Value value;
  switch (pick(rng, depth > 0 ? 8 : 6)) {
    case 0:
      value.data = pick(rng, 2) == 0;
      break;
    case 1:
      value.data = rng.normal() * 1e3;
      break;
    case 2:
      value.data = text();
      break;
    case 3:
      value.data = NumberArray{{rng.normal(), -1e-300, 1e300, 3.}, 1};
      break;
    case 4:
      value.data = StringArray{text(), "b"};
      break;
    case 5:
      value.data = AngleText{"/some/file.png"};
      break;
    case 6:
      value.data = ValueList{Value{text(), {}}, Value{NumberArray{{1., 2.}, 1}, {}}};
      break;
    default: {
      Graph graph;
      for (const char* key : {"k1", "k 2", "k:3"}) {
        Value inner = randomValue(rng, depth - 1);
        if (inner.as<Graph>() && std::string(key) == "k 2") continue;  // tags, not a key
        graph.nodes.push_back({key, {}, {}, std::move(inner), {}});
      }
      value.data = std::move(graph);
    }
  }
  return value;
}

inline void addRandomShape(Frame frame, Rng& rng) {
  static const std::vector<std::pair<ShapeType, std::vector<double>>> shapes = {
      {ShapeType::box, {1., .2, .3}},
      {ShapeType::sphere, {.5}},
      {ShapeType::capsule, {.3, .1}},
      {ShapeType::cylinder, {.3, .1}},
      {ShapeType::marker, {.2}},
      {ShapeType::ssBox, {1., .5, .4, .1}},
      {ShapeType::ssCylinder, {.4, .3, .1}},
      {ShapeType::quad, {1., 2.}},
      {ShapeType::camera, {}},
      {ShapeType::ssBoxElip, {1., 1., 1., .1, .2, .3, .05}}};
  const int kind = pick(rng, int(shapes.size()) + 6);
  const std::vector<Vector3d> points = {{0., 0., 0.}, {1., 0., .1}, {0., 1., .3}, {.1, .2, 1.}};
  if (kind < int(shapes.size())) {
    frame.setShape(shapes[std::size_t(kind)].first, shapes[std::size_t(kind)].second);
  } else if (kind == int(shapes.size())) {
    frame.setMesh({points, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, {{255, 0, 3, 255}}});
  } else if (kind == int(shapes.size()) + 1) {
    frame.setMesh({points, {}, {}});
  } else if (kind == int(shapes.size()) + 2) {
    frame.setMesh({points, {{0, 2, 1}, {1, 2, 3}}, {}, {0, 3}});
  } else if (kind == int(shapes.size()) + 3) {
    setLines(frame, points, {{255, 0, 0, 255}}, true);
  } else if (kind == int(shapes.size()) + 4) {
    setTensor(frame,
              {{2, 3, 2}, {.1f, 1e-9f, -2.f, 3.f, 4.f, 1.f / 3.f, 6.f, 7.f, 8.f, 9.f, 10.f, float(rng.normal())}},
              {1., 2., 3.});
  } else {
    frame.setConvexCore(points, .02);
  }
  if (pick(rng, 4) == 0) frame.data().shape->visual_mesh = "/no/such/mesh.ply";
  if (pick(rng, 4) == 0) frame.data().shape->visual_pose = randomPose(rng);
  if (pick(rng, 2) == 0) frame.setColor({.1, rng.uniform(), .3, pick(rng, 2) == 0 ? 1. : .5});
  if (pick(rng, 2) == 0) frame.setContact(pick(rng, 4) - 2);
}

inline void addRandomJoint(Frame frame, Rng& rng, bool only_one_dof) {
  static const std::vector<std::pair<std::string, JointType>>& types = jointTypeNames();
  JointType type = types[std::size_t(1 + pick(rng, int(types.size()) - 1))].second;
  if (only_one_dof && type == JointType::generic) type = JointType::hinge;
  const int dofs = motionDofs(motionSteps(type, "xZa"));
  std::vector<double> limits;
  if (dofs > 0 && pick(rng, 2) == 0) limits = std::vector<double>(std::size_t(2 * dofs), 1.);
  for (std::size_t i = 0; i < limits.size() / 2; ++i) limits[i] = -2. - rng.uniform();
  const std::vector<double> axis =
      type == JointType::hinge ? std::vector<double>{1., 2., rng.normal()} : std::vector<double>{};
  frame.setJoint(type, limits, axis, pick(rng, 3) == 0 ? -1.5 : 1., std::nullopt,
                 type == JointType::generic ? "xZa" : "");
  Joint& joint = *frame.data().joint;
  for (double& x : joint.q) x += .1 * rng.normal();
  joint.q = motionProject(joint.steps, joint.axis, joint.scale,
                          motionPose(joint.steps, joint.axis, joint.scale, joint.q.data()));  // unit quaternions
  if (pick(rng, 2) == 0) joint.home = joint.q;
  if (pick(rng, 4) == 0) joint.active = false;
  if (pick(rng, 4) == 0) joint.stable = true;
  if (pick(rng, 4) == 0) joint.control_weight = .3;
  if (pick(rng, 4) == 0) joint.sample_uniform = .5;
  if (pick(rng, 4) == 0) joint.sample_deviation = .2;
}

/// A scene with every kind of frame, joint, shape, mass and attribute that can be made, and odd names.
inline Config randomScene(Rng& rng, bool only_one_dof = false) {
  Config config;
  const int count = 1 + pick(rng, 12);
  for (int id = 0; id < count; ++id) {
    SceneTree& scene = *config.scene();
    FrameData* parent = id > 0 && pick(rng, 4) != 0 ? scene.frames()[std::size_t(pick(rng, id))].get() : nullptr;
    Frame frame(config.scene(), scene.add(only_one_dof ? "f" + std::to_string(id) : randomName(rng, id), parent));
    if (pick(rng, 2) == 0) frame.data().pose = randomPose(rng);
    if (parent && pick(rng, 2) == 0) addRandomJoint(frame, rng, only_one_dof);
    if (pick(rng, 2) == 0) addRandomShape(frame, rng);
    if (frame.data().joint && frame.data().joint->dofs() == 1 && pick(rng, 2) == 0) {
      for (const auto& other : scene.frames()) {
        if (other.get() == &frame.data() || !other->joint || other->joint->mimic ||
            other->joint->type != frame.data().joint->type)
          continue;
        frame.data().joint->mimic = other.get();
        break;
      }
    }
    if (id > 0 && pick(rng, 6) == 0)
      frame.data().no_contact.push_back(scene.frames()[std::size_t(pick(rng, id))].get());
    if (id > 0 && pick(rng, 6) == 0) frame.data().shape = scene.frames()[0]->shape;
    if (pick(rng, 3) == 0) {
      frame.setMass(2., {1., .1, .2, 2., .3, 3.});
      frame.data().inertia->com = Vector3d(.1, 0., rng.normal());
    }
    for (const char* key : {"label", "logical", "free 1"}) {
      if (pick(rng, 3) != 0) continue;
      Value value = randomValue(rng, std::string(key) == "free 1" ? 0 : 2);
      frame.editAttributes().nodes.push_back({key, {}, {}, std::move(value), {}});
    }
  }
  config.scene()->structureChanged();
  return config;
}

}  // namespace kinegraph
