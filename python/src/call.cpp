#include "call.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace turnscan::python {

namespace {

constexpr auto kSignalPause = std::chrono::milliseconds(50);

/// What the callback raised, to be raised again by the caller.
class Raised {
 public:
  /// With the GIL, in an except block.
  void keep(py::error_already_set& error) {
    if (!error_) error_.emplace(error);
  }
  void rethrow() {
    if (error_) throw py::error_already_set(*error_);
  }

 private:
  std::optional<py::error_already_set> error_;
};

void listen(RunContext& context, const py::object& progress, Raised& raised) {
  if (progress.is_none()) return;
  // The handle is borrowed: the caller keeps the object, and the listener must not own the context.
  context.set_listener([borrowed = progress.ptr(), &raised, &context](const Progress& state) {
    const py::gil_scoped_acquire gil;
    try {
      const py::handle function(borrowed);
      function(state.phase, state.fraction);
    } catch (py::error_already_set& error) {
      raised.keep(error);
      context.cancel();
    }
  });
}

}  // namespace

void call_without_gil(const py::object& progress,
                      const std::function<void(const RunContext&)>& work) {
  RunContext context;
  Raised raised;
  listen(context, progress, raised);
  std::mutex mutex;
  std::condition_variable ended;
  bool done = false;
  std::exception_ptr thrown;
  {
    const py::gil_scoped_release free;
    std::thread worker([&] {
      try {
        work(context);
      } catch (...) {
        thrown = std::current_exception();
      }
      const std::lock_guard lock(mutex);
      done = true;
      ended.notify_all();
    });
    for (std::unique_lock lock(mutex); !done;) {
      ended.wait_for(lock, kSignalPause);
      if (done) break;
      lock.unlock();
      {
        const py::gil_scoped_acquire gil;
        if (PyErr_CheckSignals() != 0) {
          py::error_already_set error;
          raised.keep(error);
          context.cancel();
        }
      }
      lock.lock();
    }
    worker.join();
  }
  context.set_listener({});
  raised.rethrow();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace turnscan::python
