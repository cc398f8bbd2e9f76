#pragma once
// Turns exceptions into errors at thread boundaries.

#include <exception>
#include <new>
#include <system_error>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// Runs body() and turns its exceptions into errors: one that left a thread would terminate the
/// whole program. Lack of memory, threads or descriptors becomes kResourceLimit, anything else
/// kLibrary.
template <class Body>
Result<> guarded(const Body& body) {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kResourceLimit, "there is not enough memory; end other programs");
  } catch (const std::system_error& error) {
    return fail(ErrorCode::kResourceLimit, "the system refuses: {}; check its limits",
                error.what());
  } catch (const std::exception& error) {
    return fail(ErrorCode::kLibrary, "{}", error.what());
  }
}

}  // namespace turnscan
