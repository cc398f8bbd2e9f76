#include "serve/qr_code.hpp"

#include <arpa/inet.h>
#include <qrencode.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <memory>

namespace turnscan::serve {

namespace {

/// The light border that readers need (ISO/IEC 18004), in modules.
constexpr int kBorder = 4;
constexpr const char* kBlackOnWhite = "\033[38;5;16;48;5;231m";
constexpr const char* kPlain = "\033[0m";

}  // namespace

std::string qr_code(const std::string& text) {
  const std::unique_ptr<QRcode, decltype(&QRcode_free)> code(
      QRcode_encodeString8bit(text.c_str(), 0, QR_ECLEVEL_L), QRcode_free);
  if (!code) return "";
  const auto dark = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < code->width && y < code->width &&
           (code->data[y * code->width + x] & 1) != 0;
  };
  std::string out;
  for (int y = -kBorder; y < code->width + kBorder; y += 2) {
    out += kBlackOnWhite;
    for (int x = -kBorder; x < code->width + kBorder; ++x) {
      const bool upper = dark(x, y), lower = dark(x, y + 1);
      out += upper && lower ? "█" : upper ? "▀" : lower ? "▄" : " ";
    }
    out += kPlain;
    out += '\n';
  }
  return out;
}

std::string network_address() {
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return "";
  // Of the addresses for documentation (RFC 5737): the system only chooses a route.
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(9);
  inet_pton(AF_INET, "192.0.2.1", &address.sin_addr);
  socklen_t size = sizeof address;
  std::array<char, INET_ADDRSTRLEN> text{};
  if (connect(descriptor, reinterpret_cast<const sockaddr*>(&address), size) == 0 &&
      getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) == 0)
    inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size());
  close(descriptor);
  return text.data();
}

}  // namespace turnscan::serve
