#pragma once

// Made by tools/generate_messages.py from viewer/messages.json; change that file instead.
// clang-format off

#include <optional>
#include <string_view>
#include <variant>

#include "kinegraph/viewer/command_reader.h"

namespace kinegraph {

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

struct PullCommand {
  static constexpr int kKind = 11;
  int structure = 0;
  int frame = 0;
  std::vector<double> point;
  std::vector<double> target;
};

struct NotesCommand {
  static constexpr int kKind = 12;
  int structure = 0;
};

/// What a browser asks for.
using Command = std::variant<KeyCommand, SetJointCommand, ResetJointsCommand, RandomJointsCommand, MoveFrameCommand, NearCommand, EventCommand, CursorCommand, ViewpointCommand, RunCommand, PullCommand, NotesCommand>;

/// Reads a binary message from a browser; nothing if it is not exactly one command.
inline std::optional<Command> readCommand(std::string_view data) {
  CommandReader reader(data);
  int kind;
  if (!reader.read(kind)) return std::nullopt;
  switch (kind) {
    case KeyCommand::kKind: {
      KeyCommand m;
      if (reader.read(m.code) && reader.read(m.modifiers) && reader.atEnd()) return m;
      break;
    }
    case SetJointCommand::kKind: {
      SetJointCommand m;
      if (reader.read(m.structure) && reader.read(m.joint) && reader.read(m.value) && reader.atEnd()) return m;
      break;
    }
    case ResetJointsCommand::kKind: {
      ResetJointsCommand m;
      if (reader.read(m.structure) && reader.atEnd()) return m;
      break;
    }
    case RandomJointsCommand::kKind: {
      RandomJointsCommand m;
      if (reader.read(m.structure) && reader.atEnd()) return m;
      break;
    }
    case MoveFrameCommand::kKind: {
      MoveFrameCommand m;
      if (reader.read(m.structure) && reader.read(m.frame) && reader.read(m.pose) && reader.atEnd()) return m;
      break;
    }
    case NearCommand::kKind: {
      NearCommand m;
      if (reader.read(m.structure) && reader.read(m.margin) && reader.atEnd()) return m;
      break;
    }
    case EventCommand::kKind: {
      EventCommand m;
      if (reader.read(m.what) && reader.read(m.code) && reader.read(m.modifiers) && reader.atEnd()) return m;
      break;
    }
    case CursorCommand::kKind: {
      CursorCommand m;
      if (reader.read(m.frame) && reader.read(m.point) && reader.read(m.normal) && reader.atEnd()) return m;
      break;
    }
    case ViewpointCommand::kKind: {
      ViewpointCommand m;
      if (reader.read(m.pose) && reader.read(m.distance) && reader.read(m.focal) && reader.read(m.ortho) && reader.atEnd()) return m;
      break;
    }
    case RunCommand::kKind: {
      RunCommand m;
      if (reader.read(m.what) && reader.atEnd()) return m;
      break;
    }
    case PullCommand::kKind: {
      PullCommand m;
      if (reader.read(m.structure) && reader.read(m.frame) && reader.read(m.point) && reader.read(m.target) && reader.atEnd()) return m;
      break;
    }
    case NotesCommand::kKind: {
      NotesCommand m;
      if (reader.read(m.structure) && reader.atEnd()) return m;
      break;
    }
  }
  return std::nullopt;
}

}  // namespace kinegraph
