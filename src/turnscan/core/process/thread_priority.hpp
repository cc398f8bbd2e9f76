#pragma once
// Threads that a person does not wait for, beside those that one does.

namespace turnscan::process {

/// From now on the calling thread has the processor only where threads of usual priority leave it
/// free (niceness 10). It stays so: for threads that end with their work. Does nothing where
/// threads have no priority of their own.
void lower_thread_priority();

/// The same of the threads that help with parallel loops (core/parallel.hpp), now and later; who
/// starts a loop keeps its own. For programs with a window, whose thread must not wait for them.
void lower_worker_priority();

}  // namespace turnscan::process
