#pragma once
// Priorities of background threads relative to interactive ones.

namespace turnscan::process {

/// Lowers the calling thread below threads of usual priority, which get three times its share of a
/// processor (niceness 5: a live preview still grows on a busy machine, where 10 starved it). This
/// is permanent: for threads that end with their work. Does nothing where threads have no priority
/// of their own.
void lower_thread_priority();

/// The same for current and future worker threads of parallel loops (core/parallel.hpp); the thread
/// that starts a loop keeps its own priority. For programs with a window, whose thread must not
/// wait for them.
void lower_worker_priority();

}  // namespace turnscan::process
