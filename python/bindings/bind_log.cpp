#include "bindings.h"
#include "kinegraph/common/log.h"

namespace kinegraph::python {

void bindLog() {
  setLogSink([](LogLevel level, std::string_view message) {
    if (!Py_IsInitialized()) return;
    const nb::gil_scoped_acquire gil;
    try {
      const nb::object emit = nb::module_::import_("kinegraph.log_messages").attr("emit");
      emit(level == LogLevel::notice, nb::str(message.data(), message.size()));
    } catch (nb::python_error& error) {  // as an error of a handler: a message never ends a computation
      if (error.matches(PyExc_KeyboardInterrupt)) {
        PyErr_SetInterrupt();  // Ctrl-C while a handler ran is for the computation: it sees it at its next check
      } else {
        error.discard_as_unraisable("kinegraph.log_messages.emit");
      }
    }
  });
  nb::module_::import_("atexit").attr("register")(nb::cpp_function([] { setLogSink({}); }));
}

}  // namespace kinegraph::python
