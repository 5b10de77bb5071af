#include "recent_calls.h"

#include <span>

namespace kinegraph::python {

namespace {

/// The names in a list or a tuple, or a single string; empty for other objects.
std::span<PyObject*> items(PyObject*& frames) {
  if (PyUnicode_CheckExact(frames)) return {&frames, 1};
  if (!PyList_CheckExact(frames) && !PyTuple_CheckExact(frames)) return {};
  return {PySequence_Fast_ITEMS(frames), std::size_t(PySequence_Fast_GET_SIZE(frames))};
}

bool isKnown(PyObject* frames) {
  return PyUnicode_CheckExact(frames) || PyList_CheckExact(frames) || PyTuple_CheckExact(frames);
}

}  // namespace

RecentCalls::Call* RecentCalls::find(const State& scene, nb::handle symbol, nb::handle frames, int order) {
  PyObject* given = frames.ptr();
  if (!isKnown(given)) return nullptr;
  const std::span<PyObject*> names = items(given);
  for (Call& call : calls_) {
    if (!call.symbol.is(symbol) || call.model != scene.sharedModel() || call.order != order ||
        call.frames.size() != names.size())
      continue;
    bool same = true;
    for (std::size_t i = 0; i < names.size(); ++i) same &= call.frames[i].ptr() == names[i];
    if (same) return &call;
  }
  return nullptr;
}

RecentCalls::Call* RecentCalls::add(const State& scene, nb::handle symbol, nb::handle frames, int order,
                                    const std::shared_ptr<Residual>& residual) {
  PyObject* given = frames.ptr();
  if (!isKnown(given)) return nullptr;
  Call made{scene.sharedModel(), nb::borrow(symbol), {}, order, residual, {}, {}};
  for (PyObject* name : items(given)) {
    if (!PyUnicode_CheckExact(name)) return nullptr;
    made.frames.push_back(nb::borrow(name));
  }
  constexpr std::size_t kKept = 8;
  if (calls_.size() < kKept) return &calls_.emplace_back(std::move(made));
  Call& place = calls_[oldest_];
  oldest_ = (oldest_ + 1) % kKept;
  place = std::move(made);
  return &place;
}

}  // namespace kinegraph::python
