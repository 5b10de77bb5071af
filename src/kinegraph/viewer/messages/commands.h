#pragma once

// Made by tools/generate_messages.py from viewer/messages.json; change that file instead.
// clang-format off

#include <optional>
#include <string_view>
#include <variant>

#include "kinegraph/viewer/messages/command_reader.h"

namespace kinegraph::inline viewer_internal {

struct KeyCommand {
  static constexpr int kKind = 1;
  int code = 0;
  int modifiers = 0;
};

struct SetJointCommand {
  static constexpr int kKind = 2;
  int structure = 0;
  int joint = 0;
  double value = 0;
};

struct ResetJointsCommand {
  static constexpr int kKind = 3;
  int structure = 0;
};

struct RandomJointsCommand {
  static constexpr int kKind = 4;
  int structure = 0;
};

struct MoveFrameCommand {
  static constexpr int kKind = 5;
  int structure = 0;
  int frame = 0;
  std::vector<double> pose;
};

struct NearCommand {
  static constexpr int kKind = 6;
  int structure = 0;
  double margin = 0;
};

struct EventCommand {
  static constexpr int kKind = 7;
  int what = 0;
  int code = 0;
  int modifiers = 0;
};

struct CursorCommand {
  static constexpr int kKind = 8;
  int frame = 0;
  std::vector<double> point;
  std::vector<double> normal;
};

struct ViewpointCommand {
  static constexpr int kKind = 9;
  std::vector<double> pose;
  double distance = 0;
  double focal = 0;
  double ortho = 0;
};

struct RunCommand {
  static constexpr int kKind = 10;
  int what = 0;
};

struct PerturbCommand {
  static constexpr int kKind = 11;
  int structure = 0;
  int frame = 0;
  std::vector<double> point;
  std::vector<double> target;
};

struct WarningsCommand {
  static constexpr int kKind = 12;
  int structure = 0;
};

struct ControlCommand {
  static constexpr int kKind = 13;
  int id = 0;
  double number = 0;
  std::string text;
};

struct ClickCommand {
  static constexpr int kKind = 14;
  int frame = 0;
  std::vector<double> point;
  std::vector<double> normal;
};

struct UndoCommand {
  static constexpr int kKind = 15;
  int structure = 0;
};

struct RedoCommand {
  static constexpr int kKind = 16;
  int structure = 0;
};

/// A command of a browser.
using Command = std::variant<KeyCommand, SetJointCommand, ResetJointsCommand, RandomJointsCommand, MoveFrameCommand, NearCommand, EventCommand, CursorCommand, ViewpointCommand, RunCommand, PerturbCommand, WarningsCommand, ControlCommand, ClickCommand, UndoCommand, RedoCommand>;

/// Reads a binary message from a browser; returns nothing unless it is exactly one command.
inline std::optional<Command> readCommand(std::string_view data) {
  CommandReader reader(data);
  int kind;
  if (!reader.read(kind)) return std::nullopt;
  switch (kind) {
    case KeyCommand::kKind: return readFields<KeyCommand>(reader, &KeyCommand::code, &KeyCommand::modifiers);
    case SetJointCommand::kKind: return readFields<SetJointCommand>(reader, &SetJointCommand::structure, &SetJointCommand::joint, &SetJointCommand::value);
    case ResetJointsCommand::kKind: return readFields<ResetJointsCommand>(reader, &ResetJointsCommand::structure);
    case RandomJointsCommand::kKind: return readFields<RandomJointsCommand>(reader, &RandomJointsCommand::structure);
    case MoveFrameCommand::kKind: return readFields<MoveFrameCommand>(reader, &MoveFrameCommand::structure, &MoveFrameCommand::frame, &MoveFrameCommand::pose);
    case NearCommand::kKind: return readFields<NearCommand>(reader, &NearCommand::structure, &NearCommand::margin);
    case EventCommand::kKind: return readFields<EventCommand>(reader, &EventCommand::what, &EventCommand::code, &EventCommand::modifiers);
    case CursorCommand::kKind: return readFields<CursorCommand>(reader, &CursorCommand::frame, &CursorCommand::point, &CursorCommand::normal);
    case ViewpointCommand::kKind: return readFields<ViewpointCommand>(reader, &ViewpointCommand::pose, &ViewpointCommand::distance, &ViewpointCommand::focal, &ViewpointCommand::ortho);
    case RunCommand::kKind: return readFields<RunCommand>(reader, &RunCommand::what);
    case PerturbCommand::kKind: return readFields<PerturbCommand>(reader, &PerturbCommand::structure, &PerturbCommand::frame, &PerturbCommand::point, &PerturbCommand::target);
    case WarningsCommand::kKind: return readFields<WarningsCommand>(reader, &WarningsCommand::structure);
    case ControlCommand::kKind: return readFields<ControlCommand>(reader, &ControlCommand::id, &ControlCommand::number, &ControlCommand::text);
    case ClickCommand::kKind: return readFields<ClickCommand>(reader, &ClickCommand::frame, &ClickCommand::point, &ClickCommand::normal);
    case UndoCommand::kKind: return readFields<UndoCommand>(reader, &UndoCommand::structure);
    case RedoCommand::kKind: return readFields<RedoCommand>(reader, &RedoCommand::structure);
  }
  return std::nullopt;
}

}  // namespace kinegraph::inline viewer_internal
