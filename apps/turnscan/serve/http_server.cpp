#include "serve/http_server.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace turnscan::serve {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLinger{500};
constexpr std::chrono::milliseconds kVanished{15'000};  // a peer that acknowledges nothing

// Which connection a thread serves, for the callbacks of the library, and whether it is one too
// many.
thread_local socket_t served = INVALID_SOCKET;
thread_local bool refused = false;

/// A connection from which one request of bounded size is read in bounded time.
class PeerStream : public httplib::Stream {
 public:
  PeerStream(socket_t socket, Connection& connection) : socket_(socket), connection_(connection) {}

  bool is_readable() const override { return used_ < filled_ || connection_.readable(deadline_); }
  bool is_writable() const override { return connection_.writable(Clock::now() + kStallTime); }

  ssize_t read(char* bytes, size_t size) override {
    if (used_ == filled_) {
      const std::size_t most = std::min(buffer_.size(), budget_);
      if (most == 0) return -1;
      const ssize_t got = connection_.read(buffer_.data(), most, deadline_);
      if (got <= 0) return got;
      budget_ -= std::size_t(got);
      used_ = 0;
      filled_ = std::size_t(got);
    }
    const std::size_t taken = std::min(size, filled_ - used_);
    std::memcpy(bytes, buffer_.data() + used_, taken);
    used_ += taken;
    return ssize_t(taken);
  }

  ssize_t write(const char* bytes, size_t size) override {
    return connection_.write(bytes, size, Clock::now() + kStallTime);
  }

  // Nobody asks who it is: rights come from the token and the operator's key alone.
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return socket_; }

 private:
  socket_t socket_;
  Connection& connection_;
  Clock::time_point deadline_ = Clock::now() + kRequestTime;
  std::size_t budget_ = kMaxRequestBytes;
  std::array<char, 4096> buffer_{};
  std::size_t used_ = 0, filled_ = 0;
};

}  // namespace

/// The pool of threads, with room made for a connection before it is taken.
class HttpServer::Queue : public httplib::TaskQueue {
 public:
  explicit Queue(HttpServer& server) : server_(server), pool_(kMaxConnections) {}
  // Newer versions of the library want to know whether it was taken.
  using Taken = decltype(std::declval<httplib::TaskQueue&>().enqueue(std::function<void()>()));
  Taken enqueue(std::function<void()> connection) override {
    if (server_.make_room()) {
      pool_.enqueue(std::move(connection));
    } else {
      refused = true;
      connection();
      refused = false;
    }
    return Taken(true);
  }
  void shutdown() override { pool_.shutdown(); }

 private:
  HttpServer& server_;
  httplib::ThreadPool pool_;
};

HttpServer::HttpServer(Admission admit, Handler answer, std::optional<TlsContext> tls)
    : admit_(std::move(admit)), tls_(std::move(tls)) {
  new_task_queue = [this] { return new Queue(*this); };
  set_payload_max_length(kMaxRequestBytes);
  // Two servers must not share a port.
  set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  set_exception_handler([](const httplib::Request&, httplib::Response& response, const auto&...) {
    response.status = 500;
    response.set_content(R"({"error":{"code":"internal","message":"the server has a fault"}})",
                         "application/json");
  });
  set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    return admit_(request, response) ? HandlerResponse::Unhandled : HandlerResponse::Handled;
  });
  const auto answered = [this, answer = std::move(answer)](const httplib::Request& request,
                                                           httplib::Response& response) {
    set_evictable(served, false);
    answer(request, response);
  };
  constexpr const char* kEverything = R"([\s\S]*)";
  Get(kEverything, answered);
  Post(kEverything, answered);
  Delete(kEverything, answered);
}

Result<int> HttpServer::bind(const std::string& address, int port) {
  errno = 0;
  const int bound = port == 0 ? bind_to_any_port(address) : bind_to_port(address, port) ? port : -1;
  if (bound < 0)
    return fail(ErrorCode::kIo, "cannot listen at {}, port {}{}; choose another --port or --listen",
                address, port, errno != 0 ? fmt::format(" ({})", std::strerror(errno)) : "");
  // The library lets five wait, and those beyond try again after a second.
  ::listen(svr_sock_, kMaxConnections);
  return bound;
}

void HttpServer::run() { listen_after_bind(); }

void HttpServer::stop() {
  Server::stop();
  const std::lock_guard lock(mutex_);
  for (const auto& [socket, connection] : connections_) shutdown(socket, SHUT_RDWR);
}

bool HttpServer::make_room() {
  const std::lock_guard lock(mutex_);
  if (accepted_ >= kMaxConnections) {
    auto oldest = connections_.end();
    for (auto it = connections_.begin(); it != connections_.end(); ++it)
      if (it->second.evictable && !it->second.evicted &&
          (oldest == connections_.end() || it->second.since < oldest->second.since))
        oldest = it;
    if (oldest == connections_.end()) return false;
    oldest->second.evicted = true;  // its place is given only once
    shutdown(oldest->first, SHUT_RDWR);
  }
  ++accepted_;
  return true;
}

void HttpServer::set_evictable(socket_t socket, bool evictable) {
  const std::lock_guard lock(mutex_);
  if (const auto found = connections_.find(socket); found != connections_.end())
    found->second.evictable = evictable;
}

void HttpServer::finish(socket_t socket) {
  const std::lock_guard lock(mutex_);
  connections_.erase(socket);
  --accepted_;
  close(socket);
}

bool HttpServer::process_and_close_socket(socket_t socket) {
  if (refused) {
    close(socket);
    return false;
  }
  {
    const std::lock_guard lock(mutex_);
    connections_[socket].since = Clock::now();
  }
  if (!is_running()) shutdown(socket, SHUT_RDWR);  // stop() did not see it
  served = socket;
  const int vanished_ms = int(kVanished.count());
  setsockopt(socket, IPPROTO_TCP, TCP_USER_TIMEOUT, &vanished_ms, sizeof vanished_ms);
  const bool done = serve_peer(socket);
  served = INVALID_SOCKET;
  finish(socket);
  return done;
}

bool HttpServer::serve_peer(socket_t socket) {
  Connection connection(socket, tls_ ? &*tls_ : nullptr);
  if (!connection.accept(Clock::now() + kRequestTime)) return false;
  PeerStream stream(socket, connection);
  bool closed = false;
  // Packing would cost seconds of a small processor, and parts of files are not asked for.
  const auto simplify = [](httplib::Request& request) {
    request.ranges.clear();
    request.headers.erase("Range");
    request.headers.erase("Accept-Encoding");
    // The library would read a body that nobody announced until the peer closes.
    if (!request.has_header("Content-Length") && !request.has_header("Transfer-Encoding"))
      request.headers.emplace("Content-Length", "0");
  };
  // From 0.18 on the library is told both addresses, which nobody asks for.
  const bool done = [&](auto& self) {
    if constexpr (requires { self.process_request(stream, true, closed, simplify); })
      return self.process_request(stream, true, closed, simplify);
    else
      return self.process_request(stream, "", 0, "", 0, true, closed, simplify);
  }(*this);
  set_evictable(socket, true);
  if (done) connection.finish(kLinger);
  return done;
}

}  // namespace turnscan::serve
