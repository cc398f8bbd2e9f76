#include "serve/access.hpp"

#include <arpa/inet.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <turnscan/core/process/host_name.hpp>
#include <turnscan/io/file/atomic_file.hpp>

#include "serve/http_server.hpp"
#include "serve/operator_lease.hpp"

namespace turnscan::serve {

namespace {

constexpr std::size_t kMinToken = 16;
constexpr std::string_view kTokenCharacters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

/// The host of "host:port", in lower case, an IPv6 address without its brackets.
std::string host_of(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return c < 128 ? static_cast<char>(std::tolower(c)) : '?';
  });
  if (text.starts_with('[')) {
    const auto end = text.find(']');
    return end == std::string::npos ? "" : text.substr(1, end - 1);
  }
  return text.substr(0, text.rfind(':'));
}

bool is_address(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  return inet_pton(AF_INET, host.c_str(), address.data()) == 1 ||
         inet_pton(AF_INET6, host.c_str(), address.data()) == 1;
}

/// A name that only we could have let point here; to an address nothing can be made to point.
bool is_own_host(const Access& access, const std::string& host) {
  // With TLS whoever asks has compared the name with the certificate.
  if (access.tls || Access::is_loopback(host)) return true;
  if (access.loopback) return false;
  static const std::string name = host_of(process::host_name() + ":");
  return is_address(host) || (!name.empty() && (host == name || host == name + ".local"));
}

std::string cookie(const httplib::Request& request) {
  const std::string all = "; " + request.get_header_value("Cookie");
  const std::string key = "; " + token_cookie(request) + "=";
  const auto at = all.find(key);
  if (at == std::string::npos) return "";
  const std::string rest = all.substr(at + key.size());
  return rest.substr(0, rest.find(';'));
}

bool has_token(const Access& access, const httplib::Request& request) {
  const std::string given = request.get_header_value("Authorization");
  if (!given.empty()) return same_secret(given, "Bearer " + access.token);
  // The address that was printed; the page then keeps the token as a cookie.
  if (request.path == "/" && request.has_param("token"))
    return same_secret(request.get_param_value("token"), access.token);
  return same_secret(cookie(request), access.token);
}

}  // namespace

std::string token_cookie(const httplib::Request& request) {
  const std::string host = request.get_header_value("Host");
  const std::string port = host.substr(host.rfind(':') + 1);
  const bool number = port.find_first_not_of("0123456789") == std::string::npos;
  return "turnscan_token_" + (number && host.find(':') != std::string::npos ? port : "80");
}

bool Access::is_loopback(const std::string& address) {
  in_addr ip{};
  if (inet_pton(AF_INET, address.c_str(), &ip) == 1) return ntohl(ip.s_addr) >> 24 == 127;
  return address == "localhost" || address == "::1";
}

Result<> Access::check_secret(const std::string& file, const char* kind) {
  struct stat status {};
  if (stat(file.c_str(), &status) == 0 && (status.st_mode & S_IRWXO) != 0)
    return fail_at(file, ErrorCode::kNoPermission,
                   "everybody can read this {}; take that right away (chmod o-rwx)", kind);
  return {};
}

Result<std::string> Access::read_token(const std::string& file) {
  TURNSCAN_TRY(check_secret(file, "token"));
  TURNSCAN_ASSIGN(std::string token, read_file(file, kMaxRequestBytes));
  token = token.substr(0, token.find_first_of("\r\n"));
  if (token.size() < kMinToken || token.find_first_not_of(kTokenCharacters) != std::string::npos)
    return fail_at(file, ErrorCode::kInvalidOption,
                   "its first line is no token; write at least {} letters, digits, - and _ there, "
                   "or use --token auto",
                   kMinToken);
  return token;
}

std::optional<Refusal> refusal(const Access& access, const httplib::Request& request) {
  const std::string host = request.get_header_value("Host");
  if (request.get_header_value_count("Host") != 1 || !is_own_host(access, host_of(host)))
    return Refusal{421, "host", "this server does not have that name; use its address"};
  const std::string origin = request.get_header_value("Origin");
  const std::string site = request.get_header_value("Sec-Fetch-Site");
  // A link on another page may lead here, but no other page may ask.
  const bool visit =
      request.path == "/" && request.get_header_value("Sec-Fetch-Mode") == "navigate";
  if ((!origin.empty() && origin != access.scheme() + host) ||
      (!visit && (site == "cross-site" || site == "same-site")))
    return Refusal{403, "origin", "pages of other sites may not ask; open the page of this server"};
  if (!access.token.empty() && !has_token(access, request))
    return Refusal{401, "token",
                   "the token is missing or wrong; open the address that turnscan "
                   "serve printed, or send 'Authorization: Bearer TOKEN'"};
  if (request.path.size() > kMaxPathLength) return Refusal{414, "path", "the path is too long"};
  if (request.method != "GET" && request.method != "HEAD" && request.method != "POST" &&
      request.method != "DELETE")
    return Refusal{405, "method", "use GET, POST or DELETE"};
  // What it unpacks to has no bound.
  if (request.has_header("Content-Encoding"))
    return Refusal{415, "encoding", "a body must not be packed"};
  const std::string type = request.get_header_value("Content-Type");
  if (!type.empty() && type.rfind("application/json", 0) != 0)
    return Refusal{415, "type", "a body has to be application/json"};
  return std::nullopt;
}

}  // namespace turnscan::serve
