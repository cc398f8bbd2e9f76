#pragma once
// An address that a phone's camera reads from a terminal.

#include <string>

namespace turnscan::serve {

/// The text as a QR code of characters that are two modules high each, dark on light whatever the
/// terminal's colours are; empty: the text is too long for one.
std::string qr_code(const std::string& text);

/// The IPv4 address by which the network that leads elsewhere reaches this machine; empty: none
/// does. Nothing is sent.
std::string network_address();

}  // namespace turnscan::serve
