#pragma once

#include <map>
#include <memory>
#include <set>

#include "bindings.h"
#include "kinegraph/robot/bot_op.h"

namespace kinegraph::python {

/// The BotOp of Python. It ends without the interpreter lock, because its thread may wait for that lock.
class PyBotOp {
 public:
  explicit PyBotOp(std::unique_ptr<BotOp> bot) : bot_(std::move(bot)) { open().insert(this); }
  PyBotOp(const PyBotOp&) = delete;
  ~PyBotOp() {
    open().erase(this);
    close();
  }

  void close() {
    const nb::gil_scoped_release unlock;
    bot_.reset();
  }

  /// All open ones, which are closed before the interpreter ends. Needs the interpreter lock.
  static std::set<PyBotOp*>& open() {
    static std::set<PyBotOp*> bots;
    return bots;
  }

  BotOp& operator*() const {
    if (!bot_) throw RobotFault("BotOp: the robot has been closed");
    return *bot_;
  }
  BotOp* operator->() const { return &**this; }

  std::map<long, nb::object> watched;  ///< functions of `watch` by number; Python's garbage collector sees them
  long next_watch = 0;

 private:
  std::unique_ptr<BotOp> bot_;
};

void bindRobotDriver(nb::module_& m);
void bindToolMoves(nb::class_<PyBotOp>& bot);

}  // namespace kinegraph::python
