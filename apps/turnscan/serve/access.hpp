#pragma once
// Who may ask: only pages of this server and programs that have the token. A page of another site
// must not reach it through the browser of a person beside the turntable, neither by a request of
// its own (Origin, Sec-Fetch-Site) nor by a name that it lets point here (Host; DNS rebinding).

#include <httplib.h>

#include <optional>
#include <string>
#include <turnscan/core/result.hpp>

namespace turnscan::serve {

struct Access {
  bool loopback = true;  ///< nothing else is listened to
  bool tls = false;
  std::string token;  ///< empty: not asked for

  /// Whether an address is one of this machine alone.
  static bool is_loopback(const std::string& address);
  /// The first line of a file that nobody else may read. Fails with kNotFound, kNoPermission and
  /// kInvalidOption (shorter than 16 characters, or others than letters, digits, - and _).
  static Result<std::string> read_token(const std::string& file);
  /// Fails with kNoPermission if everybody can read a file of that kind ("token", "key").
  static Result<> check_secret(const std::string& file, const char* kind);
  const char* scheme() const { return tls ? "https://" : "http://"; }
};

struct Refusal {
  int status;
  const char* code;
  std::string message;
};

/// Why a request is refused, before its body is read.
std::optional<Refusal> refusal(const Access& access, const httplib::Request& request);

/// The name of the cookie that holds the token: one for each port, since browsers send the cookies
/// of a host to all of them.
std::string token_cookie(const httplib::Request& request);

}  // namespace turnscan::serve
