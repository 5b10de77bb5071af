#pragma once

#include <functional>
#include <string_view>

namespace kinegraph {
/// The importance of a message.
enum class LogLevel {
  info,    ///< progress and results of calls with `verbose`
  notice,  ///< for the person at the keyboard: the address of a viewer, a key to press
};

/// Receives the messages of the library: one or several lines, without a final line break. Several threads may call it
/// at once.
using LogSink = std::function<void(LogLevel level, std::string_view message)>;

/// Sets the receiver of all messages. An empty function, the default, discards them. The library itself prints
/// nothing. Python prints messages, or passes them to the logger "kinegraph" of a configured module `logging`.
///
///     setLogSink(printMessage);
void setLogSink(LogSink sink);

/// A sink that prints messages to standard output.
void printMessage(LogLevel level, std::string_view message);

/// Passes a message to the sink.
void logMessage(LogLevel level, std::string_view message);

}  // namespace kinegraph
