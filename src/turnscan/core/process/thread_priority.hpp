#pragma once
// Threads that a person does not wait for, beside those that one does.

namespace turnscan::process {

/// From now on the calling thread steps back behind threads of usual priority, which have three
/// times its share of a processor (niceness 5: a live preview still grows on a busy machine, where
/// 10 starved it). It stays so: for threads that end with their work. Does nothing where threads
/// have no priority of their own.
void lower_thread_priority();

/// The same of the threads that help with parallel loops (core/parallel.hpp), now and later; who
/// starts a loop keeps its own. For programs with a window, whose thread must not wait for them.
void lower_worker_priority();

}  // namespace turnscan::process
