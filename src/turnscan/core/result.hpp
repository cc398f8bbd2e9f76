#pragma once
// Expected failures (files, devices, too few points, cancelled) are returned, never logged or
// thrown. A broken precondition of a function throws std::invalid_argument instead.

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace turnscan {

enum class ErrorCode {
  kCancelled,      ///< RunContext::cancel() was called; no partial result exists
  kNotFound,       ///< file, folder, frame or device does not exist
  kIo,             ///< the operating system refused a read or a write (disk full, permission)
  kFormat,         ///< the content of a file is damaged or is not what it claims to be
  kUnsupported,    ///< well-formed, but a variant that turnscan does not read or write
  kInvalidOption,  ///< an option is outside its range, or options contradict each other
  kMissingData,    ///< the data lack something the step needs (no angles, no intrinsics, ...)
  kTooFewPoints,   ///< not enough points, triangles or frames to go on
  kAlreadyExists,  ///< the output exists and is never overwritten
  kResourceLimit,  ///< more memory or time than allowed
  kLibrary,        ///< a library that we call failed
  kDeviceBusy,     ///< a device is there, but another program has it
  kDeviceLost,     ///< a device stopped answering: unplugged, or its driver gave up
  kNoPermission    ///< a device is there, but this user may not open it
};

/// Stable lower-case name, e.g. "too-few-points".
std::string_view name_of(ErrorCode code);

struct Error {
  ErrorCode code = ErrorCode::kLibrary;
  std::string message;  ///< one sentence without a final full stop: "<what>: <why>; <what to do>"
  std::string path;     ///< the file or folder concerned; may be empty

  /// One line for people. The path comes first unless the message names it already.
  std::string text() const;
};

template <class T = void>
using Result = tl::expected<T, Error>;

/// Error value to return from a function of type Result<T>: `return fail(ErrorCode::kIo, "...",
/// x);`
template <class... Args>
tl::unexpected<Error> fail(ErrorCode code, fmt::format_string<Args...> format, Args&&... args) {
  return tl::unexpected<Error>(
      Error{code, fmt::format(format, std::forward<Args>(args)...), std::string()});
}

/// As fail(), with the path of the file concerned.
template <class... Args>
tl::unexpected<Error> fail_at(std::string path, ErrorCode code, fmt::format_string<Args...> format,
                              Args&&... args) {
  return tl::unexpected<Error>(
      Error{code, fmt::format(format, std::forward<Args>(args)...), std::move(path)});
}

}  // namespace turnscan

/// Returns the error of `expression` (a Result<>) from the enclosing function, if it is one.
#define TURNSCAN_TRY(expression)                                                   \
  do {                                                                             \
    if (auto turnscan_try = (expression); !turnscan_try)                           \
      return ::tl::unexpected<::turnscan::Error>(std::move(turnscan_try).error()); \
  } while (false)

#define TURNSCAN_CONCAT_(a, b) a##b
#define TURNSCAN_CONCAT(a, b) TURNSCAN_CONCAT_(a, b)
#define TURNSCAN_ASSIGN_(result, target, expression)                                  \
  auto result = (expression);                                                         \
  if (!result) return ::tl::unexpected<::turnscan::Error>(std::move(result).error()); \
  target = std::move(*result)

/// `TURNSCAN_ASSIGN(auto mesh, read_mesh(path));` declares mesh, or returns the error.
#define TURNSCAN_ASSIGN(target, expression) \
  TURNSCAN_ASSIGN_(TURNSCAN_CONCAT(turnscan_result_, __LINE__), target, expression)
