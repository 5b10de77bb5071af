#include "kinegraph/task_planning/task_actions.h"

#include <algorithm>
#include <set>

#include "kinegraph/geometry/shapes/shape_kinds.h"

namespace kinegraph {

namespace {

std::string shapeFact(ShapeType type) {
  switch (shapeKind(type).body) {
    case ShapeKind::Body::box:
      return "is_box";
    case ShapeKind::Body::ball:
      return "is_sphere";
    case ShapeKind::Body::capsule:
      return "is_capsule";
    case ShapeKind::Body::cylinder:
      return "is_cylinder";
    case ShapeKind::Body::other:
      return "";
  }
  return "";
}

/// The first frame upwards that has a joint, or the root.
Frame movingRoot(Frame frame) {
  while (frame.getJointType() == JointType::none) {
    const auto parent = frame.getParent();
    if (!parent) break;
    frame = *parent;
  }
  return frame;
}

/// Whether a frame without a shape has colliding parts, and no joints below it.
bool isBodyOfParts(const Frame& frame) {
  const std::vector<Frame> below = frame.getSubtree();
  const auto isDof = [](const Frame& part) { return part.data().joint && part.data().joint->dofs() > 0; };
  const auto isPart = [&](const Frame& part) {
    const auto& shape = part.data().shape;
    return shape && shape->contact && movingRoot(part) == frame;
  };
  return std::ranges::none_of(below, isDof) && std::ranges::any_of(below, isPart);
}

}  // namespace

std::vector<Literal> sceneFacts(const Config& C) {
  std::vector<Literal> facts;
  std::vector<Frame> named;
  std::set<int> ids;
  for (const Frame& frame : C.getFrames()) {
    const Node* logical = frame.attributes().find("logical");
    const Graph* words = logical ? logical->value.as<Graph>() : nullptr;
    if (words) {
      for (const Node& word : words->nodes) facts.push_back({word.key, {frame.getName()}});
    } else if (frame.getJointType() == JointType::rigid &&
               (frame.getShapeType() != ShapeType::none || isBodyOfParts(frame))) {
      facts.push_back({"is_object", {frame.getName()}});
      const bool has_shape = frame.getShapeType() != ShapeType::none;
      if (const std::string shape = has_shape ? shapeFact(frame.getShapeType()) : ""; !shape.empty())
        facts.push_back({shape, {frame.getName()}});
    } else {
      continue;
    }
    named.push_back(frame);
    ids.insert(frame.id());
  }
  for (const Frame& frame : named) {
    const Frame root = movingRoot(frame);
    if (root.id() != frame.id() && ids.contains(root.id()))
      facts.push_back({"partOf", {root.getName(), frame.getName()}});
    const auto parent = root.getParent();
    if (parent && ids.contains(parent->id())) facts.push_back({"on", {parent->getName(), frame.getName()}});
  }
  return facts;
}

}  // namespace kinegraph
