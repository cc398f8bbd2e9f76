#pragma once
// What reading a file may cost, in proportion to its length: a few kilobytes must not take minutes
// or gigabytes.

#include <atomic>
#include <cstdint>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan::file {

/// Charged before the cost arises; may be used from several threads. Once it is exceeded, it stays
/// so.
class ReadBudget {
 public:
  /// Bytes that any file may have unpacked, and that its content may take in memory, ...
  static constexpr std::uint64_t kUnpacked = std::uint64_t(64) << 20;
  static constexpr std::uint64_t kHeld = std::uint64_t(32) << 20;
  /// ... and for each byte of the file. Black images pack at about 50 : 1, instances of a mesh and
  /// packed text hold up to 16 times their file.
  static constexpr std::uint64_t kUnpackedPerByte = 64;
  static constexpr std::uint64_t kHeldPerByte = 16;
  /// Charged for a frame of a recording: with what is known of it, it holds less than a kilobyte,
  /// and no camera's takes less of its file.
  static constexpr std::uint64_t kFrame = kHeldPerByte << 10;

  explicit ReadBudget(std::uint64_t file_bytes, RunContext context = RunContext());

  /// Bytes that are unpacked, copied or searched. Fails with kResourceLimit, and with kCancelled.
  Result<> unpack(std::uint64_t bytes) const;
  /// Bytes that what was read holds. Fails in the same ways.
  Result<> hold(std::uint64_t bytes) const;
  /// Succeeds unless one of these failed, or the context is cancelled.
  Result<> state() const { return unpack(0); }

 private:
  Result<> charge(std::atomic<std::uint64_t>& used, std::uint64_t bytes, std::uint64_t most) const;

  RunContext context_;
  std::uint64_t file_bytes_;
  mutable std::atomic<std::uint64_t> unpacked_{0}, held_{0};
  mutable std::atomic<bool> exceeded_{false};
};

}  // namespace turnscan::file
