#pragma once
// The bytes of one peer, plain or by TLS, each waited for in bounded time.

#include <sys/types.h>

#include <chrono>
#include <memory>
#include <string>
#include <turnscan/core/result.hpp>

struct ssl_ctx_st;
struct ssl_st;

namespace turnscan::serve {

/// What the server shows of itself, and proves with its key.
class TlsContext {
 public:
  /// PEM files: the certificate, followed by those that vouch for it, and its key, which nobody
  /// else may read. Fails with kNotFound, kIo, kNoPermission, and with kInvalidOption for files
  /// that do not fit together.
  static Result<TlsContext> open(const std::string& certificate, const std::string& key);

  ssl_ctx_st* get() const { return context_.get(); }

 private:
  explicit TlsContext(std::shared_ptr<ssl_ctx_st> context) : context_(std::move(context)) {}
  std::shared_ptr<ssl_ctx_st> context_;
};

class Connection {
 public:
  using Deadline = std::chrono::steady_clock::time_point;

  /// tls: nullptr for a plain one. The socket stays the caller's.
  Connection(int socket, const TlsContext* tls);
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Agrees on keys; nothing to do for a plain one.
  bool accept(Deadline deadline);
  /// Number of bytes; 0: the peer has closed; -1: it failed, or the time is over.
  ssize_t read(char* bytes, std::size_t size, Deadline deadline);
  ssize_t write(const char* bytes, std::size_t size, Deadline deadline);
  bool readable(Deadline deadline) const;
  /// Not if the peer has closed its side.
  bool writable(Deadline deadline);
  /// Nothing more will be written. Takes what still comes for a moment: closing with unread bytes
  /// would cost the peer the response.
  void finish(std::chrono::milliseconds linger);

 private:
  template <class Operation>
  int attempt(const Operation& operation, Deadline deadline);
  int socket_;
  std::unique_ptr<ssl_st, void (*)(ssl_st*)> tls_;  // null: plain
};

}  // namespace turnscan::serve
