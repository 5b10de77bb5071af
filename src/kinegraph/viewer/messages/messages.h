#pragma once

// Made by tools/generate_messages.py from viewer/messages.json; change that file instead.
// clang-format off

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace kinegraph::inline viewer_internal {

/// First 4 bytes of a binary message to the client.
enum class BinaryKind : std::uint32_t {
  poses = 1,
  mesh = 2,
  joints = 3,
  motion = 4,
  quad = 5,
  image = 6,
  drawing = 7,
  samples = 8,
  surface = 9,
};

struct ShapeMessage {
  std::string type;
  std::vector<double> size;
  std::vector<double> color;
  int mesh = 0;
};

struct FrameMessage {
  int id = 0;
  std::string name;
  int parent = 0;
  int collides = 0;
  std::string details;
  std::optional<ShapeMessage> shape;
};

struct JointMessage {
  std::string name;
  int frame = 0;
  std::string unit;
  double lower = 0;
  double upper = 0;
};

struct MovingMessage {
  int frame = 0;
  int dof = 0;
  double scale = 0;
  std::vector<std::string> steps;
  std::vector<double> axes;
};

struct LinesMessage {
  std::vector<double> points;
  std::vector<double> distances;
  std::vector<std::string> names;
};

struct WarningMessage {
  std::string text;
  std::vector<int> frames;
  int ignored = 0;
};

struct ControlMessage {
  int id = 0;
  std::string type;
  std::string label;
  std::string folder;
  std::string unit;
  std::string key;
  double lower = 0;
  double upper = 0;
  double number = 0;
  std::string text;
  std::vector<std::string> options;
};

struct SeriesMessage {
  int id = 0;
  std::string name;
  std::string unit;
  int curves = 0;
};

struct TraceMessage {
  std::string name;
  std::string type;
  std::vector<double> values;
};

struct SceneMessage {
  int count = 0;
  std::vector<FrameMessage> frames;
};

struct JointsMessage {
  int structure = 0;
  std::vector<JointMessage> joints;
  std::vector<MovingMessage> moving;
};

struct TextMessage {
  std::string title;
  std::string message;
  std::string error;
};

struct CameraMessage {
  std::vector<double> pose;
  double distance = 0;
  double focal = 0;
  double ortho = 0;
  double aspect = 0;
  double near = 0;
  double far = 0;
};

struct AppearanceMessage {
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

struct NearMessage {
  LinesMessage lines;
};

struct WarningsMessage {
  std::vector<WarningMessage> warnings;
};

struct SelectMessage {
  int frame = 0;
};

struct MotionMessage {
  int slices = 0;
  double seconds = 0;
  std::string start;
  int first = 0;
  int prefix = 0;
  std::vector<std::string> texts;
  std::vector<double> violations;
  std::vector<std::vector<int>> marked;
  std::vector<LinesMessage> touching;
  std::vector<TraceMessage> traces;
};

struct ControlsMessage {
  std::vector<ControlMessage> controls;
};

struct DrawMessage {
  std::string name;
  std::string type;
  std::string frame;
  std::string text;
  double width = 0;
  double size = 0;
  std::vector<double> pose;
  double focal = 0;
  double aspect = 0;
};

struct UndrawMessage {
  std::string name;
};

struct PlotsMessage {
  std::vector<SeriesMessage> series;
};

struct NotifyMessage {
  std::string text;
  std::string level;
};

struct RunMessage {
  int shown = 0;
  int steered = 0;
  double time = 0;
  double factor = 0;
  int paused = 0;
  std::vector<double> contacts;
  std::vector<double> perturbation;
};

/// Encodes messages for the client.
std::string jsonText(const SceneMessage& message);
std::string jsonText(const JointsMessage& message);
std::string jsonText(const TextMessage& message);
std::string jsonText(const CameraMessage& message);
std::string jsonText(const AppearanceMessage& message);
std::string jsonText(const NearMessage& message);
std::string jsonText(const WarningsMessage& message);
std::string jsonText(const SelectMessage& message);
std::string jsonText(const MotionMessage& message);
std::string jsonText(const ControlsMessage& message);
std::string jsonText(const DrawMessage& message);
std::string jsonText(const UndrawMessage& message);
std::string jsonText(const PlotsMessage& message);
std::string jsonText(const NotifyMessage& message);
std::string jsonText(const RunMessage& message);

}  // namespace kinegraph::inline viewer_internal
