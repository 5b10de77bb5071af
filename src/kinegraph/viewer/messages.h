#pragma once

// Made by tools/generate_messages.py from viewer/messages.json; change that file instead.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/viewer/json.h"

namespace kinegraph {

/// First 4 bytes of a binary message to the client.
enum class BinaryKind : std::uint32_t {
  poses = 1,
  mesh = 2,
  joints = 3,
  motion = 4,
};

struct ShapeMessage {
  std::string type;
  std::vector<double> size;
  std::vector<double> color;
  int mesh = 0;
};

inline void writeJson(JsonWriter& json, const ShapeMessage& m) {
  json.beginObject();
  json.field("type", m.type);
  json.field("size", m.size);
  json.field("color", m.color);
  json.field("mesh", m.mesh);
  json.endObject();
}

struct FrameMessage {
  int id = 0;
  std::string name;
  int parent = 0;
  std::string details;
  std::optional<ShapeMessage> shape;
};

inline void writeJson(JsonWriter& json, const FrameMessage& m) {
  json.beginObject();
  json.field("id", m.id);
  json.field("name", m.name);
  json.field("parent", m.parent);
  json.field("details", m.details);
  json.field("shape", m.shape);
  json.endObject();
}

struct JointMessage {
  std::string name;
  int frame = 0;
  std::string unit;
  double lower = 0;
  double upper = 0;
};

inline void writeJson(JsonWriter& json, const JointMessage& m) {
  json.beginObject();
  json.field("name", m.name);
  json.field("frame", m.frame);
  json.field("unit", m.unit);
  json.field("lower", m.lower);
  json.field("upper", m.upper);
  json.endObject();
}

struct SceneMessage {
  int count = 0;
  std::vector<FrameMessage> frames;
};

inline void writeJson(JsonWriter& json, const SceneMessage& m) {
  json.beginObject();
  json.field("kind", std::string("scene"));
  json.field("count", m.count);
  json.field("frames", m.frames);
  json.endObject();
}

struct JointsMessage {
  int structure = 0;
  std::vector<JointMessage> joints;
};

inline void writeJson(JsonWriter& json, const JointsMessage& m) {
  json.beginObject();
  json.field("kind", std::string("joints"));
  json.field("structure", m.structure);
  json.field("joints", m.joints);
  json.endObject();
}

struct TextMessage {
  std::string title;
  std::string message;
  std::string error;
};

inline void writeJson(JsonWriter& json, const TextMessage& m) {
  json.beginObject();
  json.field("kind", std::string("text"));
  json.field("title", m.title);
  json.field("message", m.message);
  json.field("error", m.error);
  json.endObject();
}

struct CameraMessage {
  std::vector<double> position;
  std::vector<double> target;
};

inline void writeJson(JsonWriter& json, const CameraMessage& m) {
  json.beginObject();
  json.field("kind", std::string("camera"));
  json.field("position", m.position);
  json.field("target", m.target);
  json.endObject();
}

struct SelectMessage {
  int frame = 0;
};

inline void writeJson(JsonWriter& json, const SelectMessage& m) {
  json.beginObject();
  json.field("kind", std::string("select"));
  json.field("frame", m.frame);
  json.endObject();
}

struct MotionMessage {
  int slices = 0;
  double seconds = 0;
  std::string start;
  int first = 0;
  std::vector<std::string> texts;
  std::vector<double> violations;
};

inline void writeJson(JsonWriter& json, const MotionMessage& m) {
  json.beginObject();
  json.field("kind", std::string("motion"));
  json.field("slices", m.slices);
  json.field("seconds", m.seconds);
  json.field("start", m.start);
  json.field("first", m.first);
  json.field("texts", m.texts);
  json.field("violations", m.violations);
  json.endObject();
}

}  // namespace kinegraph
