#pragma once
// The end of what threads throw.

#include <exception>
#include <new>
#include <system_error>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// body(), whose exceptions become errors: one that left a thread would end the whole program. Too
/// little memory and too few threads or descriptors are kResourceLimit, others kLibrary.
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
