#include "serve/operator_lease.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>

namespace turnscan::serve {

bool OperatorLease::valid(const std::string& key) const {
  return !key_.empty() && same_secret(key, key_);
}

std::optional<std::string> OperatorLease::take(const std::string& key) {
  const std::lock_guard lock(mutex_);
  if (!valid(key)) {
    if (!key_.empty() && Clock::now() < until_) return std::nullopt;
    key_ = random_key();
  }
  until_ = Clock::now() + kKept;
  return key_;
}

bool OperatorLease::holds(const std::string& key) {
  const std::lock_guard lock(mutex_);
  if (!valid(key)) return false;
  until_ = Clock::now() + kKept;
  return true;
}

void OperatorLease::give_up(const std::string& key) {
  const std::lock_guard lock(mutex_);
  if (valid(key)) key_.clear();
}

bool OperatorLease::taken() const {
  const std::lock_guard lock(mutex_);
  return !key_.empty() && Clock::now() < until_;
}

std::string random_key() {
  std::array<std::uint8_t, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != ssize_t(bytes.size()))
    throw std::system_error(errno, std::generic_category(), "getrandom");
  std::string text;
  for (const std::uint8_t byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

bool same_secret(const std::string& a, const std::string& b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= unsigned(a[i] ^ (i < b.size() ? b[i] : '\0'));
  return difference == 0;
}

}  // namespace turnscan::serve
