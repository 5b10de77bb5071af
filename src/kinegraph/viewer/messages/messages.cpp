#include "kinegraph/viewer/messages/messages.h"

// Made by tools/generate_messages.py from viewer/messages.json; change that file instead.
// clang-format off

#include "kinegraph/common/json.h"

namespace kinegraph::inline viewer_internal {

using common_internal::jsonOf;

static boost::json::value jsonOf(const ShapeMessage& m) {
  return boost::json::object{
      {"type", jsonOf(m.type)},
      {"size", jsonOf(m.size)},
      {"color", jsonOf(m.color)},
      {"mesh", jsonOf(m.mesh)},
  };
}

static boost::json::value jsonOf(const FrameMessage& m) {
  return boost::json::object{
      {"id", jsonOf(m.id)},
      {"name", jsonOf(m.name)},
      {"parent", jsonOf(m.parent)},
      {"collides", jsonOf(m.collides)},
      {"details", jsonOf(m.details)},
      {"shape", jsonOf(m.shape)},
  };
}

static boost::json::value jsonOf(const JointMessage& m) {
  return boost::json::object{
      {"name", jsonOf(m.name)},
      {"frame", jsonOf(m.frame)},
      {"unit", jsonOf(m.unit)},
      {"lower", jsonOf(m.lower)},
      {"upper", jsonOf(m.upper)},
  };
}

static boost::json::value jsonOf(const MovingMessage& m) {
  return boost::json::object{
      {"frame", jsonOf(m.frame)},
      {"dof", jsonOf(m.dof)},
      {"scale", jsonOf(m.scale)},
      {"steps", jsonOf(m.steps)},
      {"axes", jsonOf(m.axes)},
  };
}

static boost::json::value jsonOf(const LinesMessage& m) {
  return boost::json::object{
      {"points", jsonOf(m.points)},
      {"distances", jsonOf(m.distances)},
      {"names", jsonOf(m.names)},
  };
}

static boost::json::value jsonOf(const WarningMessage& m) {
  return boost::json::object{
      {"text", jsonOf(m.text)},
      {"frames", jsonOf(m.frames)},
      {"ignored", jsonOf(m.ignored)},
  };
}

static boost::json::value jsonOf(const ControlMessage& m) {
  return boost::json::object{
      {"id", jsonOf(m.id)},
      {"type", jsonOf(m.type)},
      {"label", jsonOf(m.label)},
      {"folder", jsonOf(m.folder)},
      {"unit", jsonOf(m.unit)},
      {"key", jsonOf(m.key)},
      {"lower", jsonOf(m.lower)},
      {"upper", jsonOf(m.upper)},
      {"number", jsonOf(m.number)},
      {"text", jsonOf(m.text)},
      {"options", jsonOf(m.options)},
  };
}

static boost::json::value jsonOf(const SeriesMessage& m) {
  return boost::json::object{
      {"id", jsonOf(m.id)},
      {"name", jsonOf(m.name)},
      {"unit", jsonOf(m.unit)},
      {"curves", jsonOf(m.curves)},
  };
}

static boost::json::value jsonOf(const TraceMessage& m) {
  return boost::json::object{
      {"name", jsonOf(m.name)},
      {"type", jsonOf(m.type)},
      {"values", jsonOf(m.values)},
  };
}

static boost::json::value jsonOf(const SceneMessage& m) {
  return boost::json::object{
      {"kind", "scene"},
      {"count", jsonOf(m.count)},
      {"frames", jsonOf(m.frames)},
  };
}

static boost::json::value jsonOf(const JointsMessage& m) {
  return boost::json::object{
      {"kind", "joints"},
      {"structure", jsonOf(m.structure)},
      {"joints", jsonOf(m.joints)},
      {"moving", jsonOf(m.moving)},
  };
}

static boost::json::value jsonOf(const TextMessage& m) {
  return boost::json::object{
      {"kind", "text"},
      {"title", jsonOf(m.title)},
      {"message", jsonOf(m.message)},
      {"error", jsonOf(m.error)},
  };
}

static boost::json::value jsonOf(const CameraMessage& m) {
  return boost::json::object{
      {"kind", "camera"},
      {"pose", jsonOf(m.pose)},
      {"distance", jsonOf(m.distance)},
      {"focal", jsonOf(m.focal)},
      {"ortho", jsonOf(m.ortho)},
      {"aspect", jsonOf(m.aspect)},
      {"near", jsonOf(m.near)},
      {"far", jsonOf(m.far)},
  };
}

static boost::json::value jsonOf(const AppearanceMessage& m) {
  return boost::json::object{
      {"kind", "appearance"},
      {"visualsOnly", jsonOf(m.visualsOnly)},
      {"background", jsonOf(m.background)},
      {"floor", jsonOf(m.floor)},
      {"shadows", jsonOf(m.shadows)},
      {"text", jsonOf(m.text)},
      {"lights", jsonOf(m.lights)},
      {"flat", jsonOf(m.flat)},
      {"wireframe", jsonOf(m.wireframe)},
      {"digits", jsonOf(m.digits)},
      {"events", jsonOf(m.events)},
      {"cursor", jsonOf(m.cursor)},
  };
}

static boost::json::value jsonOf(const NearMessage& m) {
  return boost::json::object{
      {"kind", "near"},
      {"lines", jsonOf(m.lines)},
  };
}

static boost::json::value jsonOf(const WarningsMessage& m) {
  return boost::json::object{
      {"kind", "warnings"},
      {"warnings", jsonOf(m.warnings)},
  };
}

static boost::json::value jsonOf(const SelectMessage& m) {
  return boost::json::object{
      {"kind", "select"},
      {"frame", jsonOf(m.frame)},
  };
}

static boost::json::value jsonOf(const MotionMessage& m) {
  return boost::json::object{
      {"kind", "motion"},
      {"slices", jsonOf(m.slices)},
      {"seconds", jsonOf(m.seconds)},
      {"start", jsonOf(m.start)},
      {"first", jsonOf(m.first)},
      {"prefix", jsonOf(m.prefix)},
      {"texts", jsonOf(m.texts)},
      {"violations", jsonOf(m.violations)},
      {"marked", jsonOf(m.marked)},
      {"touching", jsonOf(m.touching)},
      {"traces", jsonOf(m.traces)},
  };
}

static boost::json::value jsonOf(const ControlsMessage& m) {
  return boost::json::object{
      {"kind", "controls"},
      {"controls", jsonOf(m.controls)},
  };
}

static boost::json::value jsonOf(const DrawMessage& m) {
  return boost::json::object{
      {"kind", "draw"},
      {"name", jsonOf(m.name)},
      {"type", jsonOf(m.type)},
      {"frame", jsonOf(m.frame)},
      {"text", jsonOf(m.text)},
      {"width", jsonOf(m.width)},
      {"size", jsonOf(m.size)},
      {"pose", jsonOf(m.pose)},
      {"focal", jsonOf(m.focal)},
      {"aspect", jsonOf(m.aspect)},
  };
}

static boost::json::value jsonOf(const UndrawMessage& m) {
  return boost::json::object{
      {"kind", "undraw"},
      {"name", jsonOf(m.name)},
  };
}

static boost::json::value jsonOf(const PlotsMessage& m) {
  return boost::json::object{
      {"kind", "plots"},
      {"series", jsonOf(m.series)},
  };
}

static boost::json::value jsonOf(const NotifyMessage& m) {
  return boost::json::object{
      {"kind", "notify"},
      {"text", jsonOf(m.text)},
      {"level", jsonOf(m.level)},
  };
}

static boost::json::value jsonOf(const RunMessage& m) {
  return boost::json::object{
      {"kind", "run"},
      {"shown", jsonOf(m.shown)},
      {"steered", jsonOf(m.steered)},
      {"time", jsonOf(m.time)},
      {"factor", jsonOf(m.factor)},
      {"paused", jsonOf(m.paused)},
      {"contacts", jsonOf(m.contacts)},
      {"perturbation", jsonOf(m.perturbation)},
  };
}

std::string jsonText(const SceneMessage& message) { return boost::json::serialize(jsonOf(message)); }

std::string jsonText(const JointsMessage& message) { return boost::json::serialize(jsonOf(message)); }

std::string jsonText(const TextMessage& message) { return boost::json::serialize(jsonOf(message)); }

std::string jsonText(const CameraMessage& message) { return boost::json::serialize(jsonOf(message)); }

std::string jsonText(const AppearanceMessage& message) { return boost::json::serialize(jsonOf(message)); }

std::string jsonText(const NearMessage& message) { return boost::json::serialize(jsonOf(message)); }

std::string jsonText(const WarningsMessage& message) { return boost::json::serialize(jsonOf(message)); }

std::string jsonText(const SelectMessage& message) { return boost::json::serialize(jsonOf(message)); }

std::string jsonText(const MotionMessage& message) { return boost::json::serialize(jsonOf(message)); }

std::string jsonText(const ControlsMessage& message) { return boost::json::serialize(jsonOf(message)); }

std::string jsonText(const DrawMessage& message) { return boost::json::serialize(jsonOf(message)); }

std::string jsonText(const UndrawMessage& message) { return boost::json::serialize(jsonOf(message)); }

std::string jsonText(const PlotsMessage& message) { return boost::json::serialize(jsonOf(message)); }

std::string jsonText(const NotifyMessage& message) { return boost::json::serialize(jsonOf(message)); }

std::string jsonText(const RunMessage& message) { return boost::json::serialize(jsonOf(message)); }

}  // namespace kinegraph::inline viewer_internal
