#include <turnscan/core/result.hpp>

namespace turnscan {

std::string_view name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kCancelled:
      return "cancelled";
    case ErrorCode::kNotFound:
      return "not-found";
    case ErrorCode::kIo:
      return "io";
    case ErrorCode::kFormat:
      return "format";
    case ErrorCode::kUnsupported:
      return "unsupported";
    case ErrorCode::kInvalidOption:
      return "invalid-option";
    case ErrorCode::kMissingData:
      return "missing-data";
    case ErrorCode::kTooFewPoints:
      return "too-few-points";
    case ErrorCode::kAlreadyExists:
      return "already-exists";
    case ErrorCode::kResourceLimit:
      return "resource-limit";
    case ErrorCode::kLibrary:
      return "library";
    case ErrorCode::kDeviceBusy:
      return "device-busy";
    case ErrorCode::kDeviceLost:
      return "device-lost";
    case ErrorCode::kNoPermission:
      return "no-permission";
  }
  return "unknown";
}

std::string Error::text() const {
  if (path.empty() || message.find(path) != std::string::npos) return message;
  return path + ": " + message;
}

}  // namespace turnscan
