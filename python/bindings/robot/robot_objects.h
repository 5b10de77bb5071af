#pragma once

#include <map>
#include <memory>
#include <set>
#include <utility>

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
    try {
      close();
    } catch (nb::python_error& error) {
      error.discard_as_unraisable("BotOp.close");
    }
  }

  void close() {
    endRecorder();
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
  nb::object recorder;  ///< of `recordTo` with a file .mcap, if any

  void endRecorder() {
    if (!recorder.is_valid()) return;
    const nb::object ended = std::exchange(recorder, nb::object());
    ended.attr("close")();
  }

  /// A path that ends in .mcap is written by the package's recorder.
  void recordTo(nb::handle self, const std::string& path, double rate, nb::handle cameras, double camera_rate,
                double start) {
    endRecorder();
    const bool is_mcap = path.ends_with(".mcap");
    {
      const nb::gil_scoped_release unlock;
      (**this).recordTo(is_mcap ? std::string() : path);
    }
    if (!is_mcap) return;
    const nb::object record = nb::module_::import_("kinegraph.recording").attr("recordRobot");
    recorder = record(self, path.c_str(), rate, cameras, camera_rate, start);
  }

 private:
  std::unique_ptr<BotOp> bot_;
};

void bindRobotDriver(nb::module_& m);
void bindToolMoves(nb::class_<PyBotOp>& bot);

}  // namespace kinegraph::python
