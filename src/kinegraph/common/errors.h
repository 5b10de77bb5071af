#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace kinegraph {

/// A position in a text: line and column count from 1; `file` is empty for a text from a string.
struct SourcePosition {
  std::string file;
  int line = 0;
  int column = 0;
  bool known() const { return line > 0; }
  std::string str() const;  ///< "file:line:column", or "line:column" without a file
};

/// A mistake of the caller. The message names the place, the given and the expected values, and alternatives.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An argument has the wrong size, range or kind.
class ValueError : public Error {
 public:
  using Error::Error;
};

/// An unknown name of a frame, a feature or a parameter.
class NameError : public Error {
 public:
  using Error::Error;
};

/// An unknown frame name.
class FrameNotFound : public NameError {
 public:
  using NameError::NameError;
};

/// A handle whose frame has been deleted.
class FrameDeleted : public Error {
 public:
  using Error::Error;
};

/// A missing or unreadable file.
class FileError : public Error {
 public:
  using Error::Error;
};

/// A text with a syntax error, or an invalid scene. The message starts with the position.
class ParseError : public Error {
 public:
  ParseError(SourcePosition where, const std::string& message);
  const SourcePosition& where() const { return where_; }
  const std::string& reason() const { return reason_; }  ///< the message without the position

 private:
  SourcePosition where_;
  std::string reason_;
};

/// The owner of what an object consists of: a std::shared_ptr or std::unique_ptr that throws ValueError if the object
/// was moved from. A moved-from object can be destroyed, and another one can be assigned to it.
template <class Pointer>
class Held {
 public:
  /// `owner` is the name of the object's class.
  Held(const char* owner, Pointer pointer) : owner_(owner), pointer_(std::move(pointer)) {}

  auto* operator->() const { return pointer().get(); }
  auto& operator*() const { return *pointer(); }
  explicit operator bool() const { return bool(pointer_); }

  const Pointer& pointer() const {
    if (!pointer_)
      throw ValueError(std::string(owner_) + ": this object was moved from; assign another one to it before its use");
    return pointer_;
  }
  operator const Pointer&() const { return pointer(); }

 private:
  const char* owner_;
  Pointer pointer_;
};

}  // namespace kinegraph
