#pragma once
// A library call that cannot be cancelled runs in a child process, which can be ended.

#include <cstddef>
#include <functional>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {

using Bytes = std::vector<std::byte>;

/// Forks, runs work() in the child and returns the bytes it gives. The child has this process's
/// memory but none of its other threads; work must not use them (no TBB). Its output to stdout and
/// stderr goes nowhere. Cancelling ends the child within 20 ms. Fails with kCancelled, kLibrary
/// (the child crashed, threw or returned an error, whose text is kept), kIo (no child, no memory).
Result<Bytes> run_in_child(const std::function<Result<Bytes>()>& work, const RunContext& context);

}  // namespace turnscan
