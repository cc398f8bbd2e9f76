#include <turnscan/io/file/read_budget.hpp>

#include <utility>

namespace turnscan::file {

ReadBudget::ReadBudget(std::uint64_t file_bytes, RunContext context)
    : context_(std::move(context)), file_bytes_(file_bytes) {}

Result<> ReadBudget::unpack(std::uint64_t bytes) const {
  return charge(unpacked_, bytes, kUnpacked + kUnpackedPerByte * file_bytes_);
}

Result<> ReadBudget::hold(std::uint64_t bytes) const {
  return charge(held_, bytes, kHeld + kHeldPerByte * file_bytes_);
}

Result<> ReadBudget::charge(std::atomic<std::uint64_t>& used, std::uint64_t bytes,
                            std::uint64_t most) const {
  TURNSCAN_TRY(context_.check());
  // Compared before they are added, so that no sum wraps around.
  if (!exceeded_ && bytes <= most && used.fetch_add(bytes) + bytes <= most) return {};
  exceeded_ = true;
  return fail(ErrorCode::kResourceLimit,
              "its content is out of all proportion to its {} bytes; the file is damaged or made "
              "to do harm",
              file_bytes_);
}

}  // namespace turnscan::file
