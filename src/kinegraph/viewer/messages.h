#pragma once

// Made by tools/generate_messages.py from viewer/messages.json; change that file instead.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/viewer/json.h"

namespace kinegraph {

/// First 4 bytes of a binary message.
enum class BinaryKind : std::uint32_t {
  poses = 1,
  mesh = 2,
  key = 3,
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
  std::optional<ShapeMessage> shape;
};

inline void writeJson(JsonWriter& json, const FrameMessage& m) {
  json.beginObject();
  json.field("id", m.id);
  json.field("name", m.name);
  json.field("parent", m.parent);
  json.field("shape", m.shape);
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

}  // namespace kinegraph
