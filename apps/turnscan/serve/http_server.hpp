#pragma once
// HTTP for a few people beside a turntable. cpp-httplib reads requests and writes responses; what a
// peer may cost is bounded here: connections, bytes and time.

#include <httplib.h>

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <turnscan/core/result.hpp>

#include "serve/connection.hpp"

namespace turnscan::serve {

inline constexpr std::size_t kMaxConnections = 48;
/// Of one request: its line, headers and body.
inline constexpr std::size_t kMaxRequestBytes = std::size_t(64) * 1024;
inline constexpr std::size_t kMaxPathLength = 200;
/// Until all of a request has come.
inline constexpr std::chrono::seconds kRequestTime{10};
/// Until a peer takes the next bytes of a response.
inline constexpr std::chrono::seconds kStallTime{5};

/// One request a connection. When all connections are in use, a new one takes the place of the one
/// that has been longest without a whole request; if there is none, it is closed at once.
class HttpServer : private httplib::Server {
 public:
  using Handler = std::function<void(const httplib::Request&, httplib::Response&)>;
  /// Called before a body is read. False: the response says why the request is refused.
  using Admission = std::function<bool(const httplib::Request&, httplib::Response&)>;

  /// tls: nullopt for HTTP without it.
  HttpServer(Admission admit, Handler answer, std::optional<TlsContext> tls = {});

  /// port 0: any that is free. Returns the port. Fails with kIo.
  Result<int> bind(const std::string& address, int port);
  /// Serves until stop(), which may be called from any thread and ends all connections.
  void run();
  using httplib::Server::is_running;
  void stop();

 private:
  class Queue;
  struct Accepted {
    std::chrono::steady_clock::time_point since;
    bool evictable = true, evicted = false;
  };

  bool process_and_close_socket(socket_t socket) override;
  bool serve_peer(socket_t socket);
  bool make_room();
  void set_evictable(socket_t socket, bool evictable);
  void finish(socket_t socket);

  Admission admit_;
  std::optional<TlsContext> tls_;
  std::mutex mutex_;
  std::map<socket_t, Accepted> connections_;
  std::size_t accepted_ = 0;  // and not closed
};

}  // namespace turnscan::serve
