#pragma once
// lib3mf 1.8 (its C interface) with owned handles. For the sources of 3MF only.

#include <Model/COM/NMR_DLLInterfaces.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace turnscan::mesh_io {

/// Metadata entry that names the program which last wrote a model, and for turnscan also the frame.
inline constexpr const char* kApplication = "Application";
inline constexpr std::string_view kByTurnscan = "turnscan, ";

/// Owns an object of lib3mf and releases it.
class Lib3mfHandle {
 public:
  Lib3mfHandle() = default;
  ~Lib3mfHandle() {
    if (object_ != nullptr) (void)NMR::lib3mf_release(object_);
  }
  Lib3mfHandle(Lib3mfHandle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Lib3mfHandle(const Lib3mfHandle&) = delete;
  Lib3mfHandle& operator=(const Lib3mfHandle&) = delete;
  Lib3mfHandle& operator=(Lib3mfHandle&&) = delete;

  NMR::PLib3MFBase* get() const { return object_; }
  /// Output argument for functions that return a new object.
  NMR::PLib3MFBase** out() { return &object_; }

 private:
  NMR::PLib3MFBase* object_ = nullptr;
};

/// Thrown and caught internally; never leaves our functions.
struct Lib3mfFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws the error message that lib3mf has for `object` unless the result is success.
inline void require(LIB3MFRESULT result, const Lib3mfHandle& object) {
  if (result == LIB3MF_OK) return;
  DWORD code = 0;
  LPCSTR words = nullptr;
  if (object.get() != nullptr) (void)NMR::lib3mf_getlasterror(object.get(), &code, &words);
  throw Lib3mfFailure(words != nullptr && *words != '\0' ? words : "unknown error of lib3mf");
}

}  // namespace turnscan::mesh_io
