#pragma once

// Made by tools/generate_messages.py from viewer/messages.json; change that file instead.
// clang-format off

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
  quad = 5,
  image = 6,
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
  int collides = 0;
  std::string details;
  std::optional<ShapeMessage> shape;
};

inline void writeJson(JsonWriter& json, const FrameMessage& m) {
  json.beginObject();
  json.field("id", m.id);
  json.field("name", m.name);
  json.field("parent", m.parent);
  json.field("collides", m.collides);
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

struct TraceMessage {
  std::string name;
  std::string type;
  std::vector<double> values;
};

inline void writeJson(JsonWriter& json, const TraceMessage& m) {
  json.beginObject();
  json.field("name", m.name);
  json.field("type", m.type);
  json.field("values", m.values);
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
  std::vector<double> pose;
  double distance = 0;
  double focal = 0;
  double ortho = 0;
  double aspect = 0;
  double near = 0;
  double far = 0;
};

inline void writeJson(JsonWriter& json, const CameraMessage& m) {
  json.beginObject();
  json.field("kind", std::string("camera"));
  json.field("pose", m.pose);
  json.field("distance", m.distance);
  json.field("focal", m.focal);
  json.field("ortho", m.ortho);
  json.field("aspect", m.aspect);
  json.field("near", m.near);
  json.field("far", m.far);
  json.endObject();
}

struct LookMessage {
  int visualsOnly = 0;
  std::vector<double> background;
  std::vector<double> floor;
  int shadows = 0;
  int text = 0;
  std::vector<double> lights;
  int flat = 0;
  int wireframe = 0;
  int digits = 0;
  int events = 0;
  int cursor = 0;
};

inline void writeJson(JsonWriter& json, const LookMessage& m) {
  json.beginObject();
  json.field("kind", std::string("look"));
  json.field("visualsOnly", m.visualsOnly);
  json.field("background", m.background);
  json.field("floor", m.floor);
  json.field("shadows", m.shadows);
  json.field("text", m.text);
  json.field("lights", m.lights);
  json.field("flat", m.flat);
  json.field("wireframe", m.wireframe);
  json.field("digits", m.digits);
  json.field("events", m.events);
  json.field("cursor", m.cursor);
  json.endObject();
}

struct NearMessage {
  std::vector<double> points;
  std::vector<double> distances;
  std::vector<std::string> names;
};

inline void writeJson(JsonWriter& json, const NearMessage& m) {
  json.beginObject();
  json.field("kind", std::string("near"));
  json.field("points", m.points);
  json.field("distances", m.distances);
  json.field("names", m.names);
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
  int prefix = 0;
  std::vector<std::string> texts;
  std::vector<double> violations;
  std::vector<std::vector<int>> marked;
  std::vector<TraceMessage> traces;
};

inline void writeJson(JsonWriter& json, const MotionMessage& m) {
  json.beginObject();
  json.field("kind", std::string("motion"));
  json.field("slices", m.slices);
  json.field("seconds", m.seconds);
  json.field("start", m.start);
  json.field("first", m.first);
  json.field("prefix", m.prefix);
  json.field("texts", m.texts);
  json.field("violations", m.violations);
  json.field("marked", m.marked);
  json.field("traces", m.traces);
  json.endObject();
}

}  // namespace kinegraph
