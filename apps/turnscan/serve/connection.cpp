#include "serve/connection.hpp"

#include <fcntl.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <turnscan/io/file/atomic_file.hpp>

#include "serve/access.hpp"

namespace turnscan::serve {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kMaxPemBytes = std::uint64_t(1) << 20;

bool ready(int socket, short what, Clock::time_point deadline) {
  const auto left =
      std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
  pollfd wait{socket, what, 0};
  return left > 0 && poll(&wait, 1, static_cast<int>(left)) == 1;
}

/// A key with a password: nobody is there to be asked.
int no_password(char*, int, int, void*) { return 0; }

tl::unexpected<Error> tls_failure(const std::string& file, const char* what) {
  const char* why = ERR_reason_error_string(ERR_peek_last_error());
  return fail_at(file, ErrorCode::kInvalidOption, "{} ({})", what, why ? why : "unknown");
}

}  // namespace

Result<TlsContext> TlsContext::open(const std::string& certificate, const std::string& key) {
  TURNSCAN_TRY(read_file(certificate, kMaxPemBytes));
  TURNSCAN_TRY(Access::check_secret(key, "key"));
  TURNSCAN_TRY(read_file(key, kMaxPemBytes));
  ERR_clear_error();
  std::shared_ptr<ssl_ctx_st> context(SSL_CTX_new(TLS_server_method()), SSL_CTX_free);
  if (!context) throw std::bad_alloc();
  SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION);
  SSL_CTX_set_mode(context.get(), SSL_MODE_ENABLE_PARTIAL_WRITE |
                                      SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER |
                                      SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_set_default_passwd_cb(context.get(), no_password);
  if (SSL_CTX_use_certificate_chain_file(context.get(), certificate.c_str()) != 1)
    return tls_failure(certificate, "is no certificate in PEM form; make one with openssl");
  if (SSL_CTX_use_PrivateKey_file(context.get(), key.c_str(), SSL_FILETYPE_PEM) != 1)
    return tls_failure(key,
                       "is not the key of that certificate, in PEM form without a password; "
                       "give the one that was made with it");
  return TlsContext(std::move(context));
}

Connection::Connection(int socket, const TlsContext* tls)
    : socket_(socket), tls_(tls ? SSL_new(tls->get()) : nullptr, SSL_free) {
  if (!tls) return;
  if (!tls_ || SSL_set_fd(tls_.get(), socket) != 1) throw std::bad_alloc();
  fcntl(socket, F_SETFL, fcntl(socket, F_GETFL) | O_NONBLOCK);
}

template <class Operation>
int Connection::attempt(const Operation& operation, Deadline deadline) {
  for (;;) {
    ERR_clear_error();
    const int result = operation(tls_.get());
    if (result > 0) return result;
    switch (SSL_get_error(tls_.get(), result)) {
      case SSL_ERROR_WANT_READ:
        if (!ready(socket_, POLLIN, deadline)) return -1;
        break;
      case SSL_ERROR_WANT_WRITE:
        if (!ready(socket_, POLLOUT, deadline)) return -1;
        break;
      case SSL_ERROR_ZERO_RETURN:
        return 0;
      default:
        return -1;
    }
  }
}

bool Connection::accept(Deadline deadline) { return !tls_ || attempt(SSL_accept, deadline) > 0; }

ssize_t Connection::read(char* bytes, std::size_t size, Deadline deadline) {
  if (tls_)
    return attempt([&](ssl_st* tls) { return SSL_read(tls, bytes, static_cast<int>(size)); },
                   deadline);
  return ready(socket_, POLLIN, deadline) ? recv(socket_, bytes, size, 0) : -1;
}

ssize_t Connection::write(const char* bytes, std::size_t size, Deadline deadline) {
  if (!writable(deadline)) return -1;
  if (!tls_) return send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
  const int most = static_cast<int>(std::min(size, std::size_t(1) << 20));
  return attempt([&](ssl_st* tls) { return SSL_write(tls, bytes, most); }, deadline);
}

bool Connection::readable(Deadline deadline) const {
  return (tls_ && SSL_pending(tls_.get()) > 0) || ready(socket_, POLLIN, deadline);
}

bool Connection::writable(Deadline deadline) {
  char next = 0;
  if (tls_) {
    ERR_clear_error();
    const int got = SSL_peek(tls_.get(), &next, 1);
    if (got <= 0 && SSL_get_error(tls_.get(), got) != SSL_ERROR_WANT_READ) return false;
  } else if (recv(socket_, &next, 1, MSG_PEEK | MSG_DONTWAIT) == 0) {
    return false;
  }
  return ready(socket_, POLLOUT, deadline);
}

void Connection::finish(std::chrono::milliseconds linger) {
  if (tls_) SSL_shutdown(tls_.get());
  shutdown(socket_, SHUT_WR);
  std::array<char, 4096> rest{};
  const auto deadline = Clock::now() + linger;
  while (ready(socket_, POLLIN, deadline) && recv(socket_, rest.data(), rest.size(), 0) > 0) {
  }
}

}  // namespace turnscan::serve
