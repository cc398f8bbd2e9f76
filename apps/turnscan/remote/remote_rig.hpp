#pragma once
// A rig elsewhere: what `turnscan serve` offers, by its interface /api/v1.

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>

namespace httplib {
class Client;
}

namespace turnscan::remote {

using Json = nlohmann::ordered_json;

/// Environment variable with the token: arguments can be read by everybody on this machine.
inline constexpr const char* kTokenVariable = "TURNSCAN_TOKEN";

/// The code that name_of() gives this name; others are of the server itself: kNoPermission.
ErrorCode code_named(const std::string& name);

/// Paths are relative to /api/v1/. All fail as the server says, with kIo if it does not answer, and
/// with kFormat if it is no turnscan serve.
class RemoteRig {
 public:
  /// address: "http://rig:8470". Fails with kInvalidOption.
  static Result<RemoteRig> open(const std::string& address, const RunContext& context);
  RemoteRig(RemoteRig&&) noexcept;
  RemoteRig& operator=(RemoteRig&&) noexcept;
  ~RemoteRig();  ///< lets the next one operate the rig at once

  Result<Json> get(const std::string& path);
  /// POSTs as the operator, which it becomes first. body: null if there is none.
  Result<Json> operate(const std::string& path, const Json& body = {});
  /// Writes a file, whole or not at all; also fails with kCancelled and as write_file_atomically().
  Result<> download(const std::string& path, const std::string& file);

  const std::string& address() const { return address_; }
  /// The error for an answer of another form.
  Error not_understood() const;

 private:
  RemoteRig(std::string address, const RunContext& context);
  /// Takes a piece of an answer; false: no more of it.
  using Take = std::function<bool(std::string_view)>;
  Result<> receive(const std::string& path, const Take& take);
  Result<Json> post(const std::string& path, const Json& body);
  Error refused(int status, const std::string& body) const;
  Error silent(const std::string& why) const;

  std::string address_, key_;
  RunContext context_;
  std::unique_ptr<httplib::Client> client_;
};

}  // namespace turnscan::remote
