#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace kinegraph {

/// A place in a text: line and column count from 1; `file` may be empty for text given as a string.
struct SourcePosition {
  std::string file;
  int line = 0;
  int column = 0;
  bool known() const { return line > 0; }
  std::string str() const;  ///< "file:line:column", or "line:column" without a file
};

/// A mistake of the caller. The message names the thing, the place, what was expected and what is available.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An argument has the wrong size, range or kind.
class ValueError : public Error {
 public:
  using Error::Error;
};

/// A name that is not there: a frame, a feature, a parameter.
class NameError : public Error {
 public:
  using Error::Error;
};

/// A frame name that is not in the configuration.
class FrameNotFound : public NameError {
 public:
  using NameError::NameError;
};

/// A handle whose frame has been deleted.
class FrameDeleted : public Error {
 public:
  using Error::Error;
};

/// A file that is missing or unreadable.
class FileError : public Error {
 public:
  using Error::Error;
};

/// A text that does not follow its grammar, or a scene text that makes no sense. The message starts with the place.
class ParseError : public Error {
 public:
  ParseError(SourcePosition where, const std::string& message);
  const SourcePosition& where() const { return where_; }
  const std::string& reason() const { return reason_; }  ///< the message without the place

 private:
  SourcePosition where_;
  std::string reason_;
};

}  // namespace kinegraph
