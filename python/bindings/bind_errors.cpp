#include <nanobind/stl/string.h>
#include <algorithm>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <utility>

#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/utf8.h"
#include "kinegraph/robot/robot_driver.h"
#include "kinegraph/scene/tree/contact_warnings.h"
#include "kinegraph/simulation/simulation_data.h"
#include "python_names.h"

namespace kinegraph::python {

namespace {

/// The exception class of that name in kinegraph.errors.
nb::object errorClass(const char* name) { return nb::module_::import_("kinegraph.errors").attr(name); }

void raise(const char* class_name, const std::exception& error) {
  PyErr_SetString(errorClass(class_name).ptr(), validUtf8(inPython(error.what())).c_str());
}

void raiseParseError(const ParseError& error) {
  nb::object instance = errorClass("ParseError")(validUtf8(error.what()));
  instance.attr("file") = error.where().file;
  instance.attr("line") = error.where().line;
  instance.attr("column") = error.where().column;
  PyErr_SetObject(errorClass("ParseError").ptr(), instance.ptr());
}

void raiseOutOfMemory() {
  PyErr_SetString(PyExc_MemoryError, "not enough memory for this call; is one of the arguments too large?");
}

void translate(const std::exception_ptr& pointer, void*) {
  try {
    std::rethrow_exception(pointer);
  } catch (const ParseError& error) {
    raiseParseError(error);
  } catch (const FrameNotFound& error) {
    raise("FrameNotFound", error);
  } catch (const NameError& error) {
    raise("NotFound", error);
  } catch (const FrameDeleted& error) {
    raise("FrameDeleted", error);
  } catch (const ValueError& error) {
    raise("ArgumentError", error);
  } catch (const FileError& error) {
    raise("FileError", error);
  } catch (const RobotFault& error) {
    raise("RobotFault", error);
  } catch (const DivergenceError& error) {
    raise("DivergenceError", error);
  } catch (const Error& error) {
    raise("Error", error);
  } catch (const std::filesystem::filesystem_error& error) {
    raise("FileError", error);
  } catch (const std::length_error&) {
    raiseOutOfMemory();
  } catch (const std::bad_alloc&) {
    raiseOutOfMemory();
  }
}

}  // namespace

void bindErrors(nb::module_&) { nb::register_exception_translator(translate); }

void emitWarning(const std::string& message) {
  if (PyErr_WarnEx(errorClass("KinegraphWarning").ptr(), validUtf8(inPython(message)).c_str(), 1) != 0)
    throw nb::python_error();
}

void emitWarnings(Config& config) {
  for (const std::string& warning : config.takeWarnings()) emitWarning(warning);
}

namespace {

void giveOnce(const PyConfig& config, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    if (std::find(config.given_warnings.begin(), config.given_warnings.end(), note) != config.given_warnings.end())
      continue;
    config.given_warnings.push_back(note);
    emitWarning(note);
  }
}

}  // namespace

void warnOfContacts(const PyConfig& config) {
  const std::uint64_t revision = config.scene()->structureRevision();
  if (std::exchange(config.warned_revision, revision) == revision) return;
  config.noted_revision = revision;
  giveOnce(config, config.contactWarnings());
}

void warnOfMissingContacts(const PyConfig& config) {
  const std::uint64_t revision = config.scene()->structureRevision();
  if (std::exchange(config.noted_revision, revision) == revision) return;
  ContactWarnings warnings = contactWarnings(*config.scene());
  warnings.resting.clear();
  giveOnce(config, describe(warnings, *config.scene()));
}

void checkInterrupt() {
  const nb::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
}

bool CheckInterrupts::checkIfDue() {
  const auto now = std::chrono::steady_clock::now();
  if (now - checked_ < std::chrono::milliseconds(20)) return false;
  checked_ = now;
  checkInterrupt();
  return true;
}

}  // namespace kinegraph::python
