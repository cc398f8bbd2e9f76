#include <lz4.h>
#include <lz4frame.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <turnscan/io/lz4/lz4.hpp>

namespace turnscan::lz4 {

namespace {

constexpr std::string_view kFrame("\x04\x22\x4d\x18", 4);
constexpr std::size_t kFirstRoom = std::size_t(16) << 20;
constexpr std::size_t kMaxPerByte = 255;  // bytes represented by one byte of a match's length
constexpr std::size_t kWindow = std::size_t(64) << 10;

tl::unexpected<Error> damaged(std::string_view why) {
  return fail(ErrorCode::kFormat, "LZ4: {}", why);
}

tl::unexpected<Error> too_long() {
  return fail(ErrorCode::kResourceLimit, "LZ4: it is longer than its size says");
}

struct FreeContext {
  void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
};

Result<std::string> decode_frame(std::string_view bytes, std::size_t max_bytes) {
  LZ4F_dctx* made_context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made_context, LZ4F_VERSION)))
    return fail(ErrorCode::kLibrary, "liblz4 gives no context; there may be too little memory");
  const std::unique_ptr<LZ4F_dctx, FreeContext> context(made_context);
  std::string out;
  std::size_t made = 0, left = 1;
  LZ4F_decompressOptions_t options{};
  // The output never moves: no need to copy it.
  options.stableDst = max_bytes <= kFirstRoom ? 1 : 0;
  while (left != 0) {
    // Grows by doubling, so that a false size costs little.
    if (made == out.size() && made < max_bytes)
      out.resize(std::min(max_bytes, std::max(kFirstRoom, 2 * out.size())));
    std::size_t room = out.size() - made, taken = bytes.size();
    left = LZ4F_decompress(context.get(), out.data() + made, &room, bytes.data(), &taken, &options);
    if (LZ4F_isError(left)) return damaged(LZ4F_getErrorName(left));
    if (room == 0 && taken == 0 && left != 0) {
      if (bytes.empty()) return damaged("its data end too early");
      return too_long();
    }
    made += room;
    bytes.remove_prefix(taken);
  }
  out.resize(made);
  return out;
}

/// Removes a 32-bit number from the front.
std::size_t take_number(std::string_view& bytes) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::size_t(std::uint8_t(bytes[i])) << (8 * i);
  bytes.remove_prefix(4);
  return value;
}

class BlockReader {
 public:
  BlockReader(std::string_view bytes, std::size_t max_bytes)
      : bytes_(bytes), max_bytes_(max_bytes) {}

  Result<std::string> run() {
    while (true) {
      const std::string_view kind = bytes_.substr(0, 4);
      if (kind == "bv4$") return std::move(out_);
      if (kind != "bv41" && kind != "bv4-")
        return damaged(kind.size() < 4 ? "its data end too early" : "no block begins");
      bytes_.remove_prefix(4);
      TURNSCAN_TRY(kind == "bv41" ? packed() : stored());
    }
  }

 private:
  Result<> stored() {
    if (bytes_.size() < 4) return damaged("its data end too early");
    const std::size_t size = take_number(bytes_);
    if (bytes_.size() < size) return damaged("its data end too early");
    if (size > max_bytes_ - out_.size()) return too_long();
    out_ += bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return {};
  }

  Result<> packed() {
    if (bytes_.size() < 8) return damaged("its data end too early");
    const std::size_t raw = take_number(bytes_), size = take_number(bytes_);
    if (bytes_.size() < size) return damaged("its data end too early");
    if (raw > max_bytes_ - out_.size()) return too_long();
    if (raw > size * kMaxPerByte || size > LZ4_MAX_INPUT_SIZE) return damaged("a block is damaged");
    const std::size_t before = out_.size(), window = std::min(before, kWindow);
    out_.resize(before + raw);
    char* to = out_.data() + before;
    const int made = LZ4_decompress_safe_usingDict(bytes_.data(), to, int(size), int(raw),
                                                   to - window, int(window));
    if (made < 0 || std::size_t(made) != raw) return damaged("a block is damaged");
    bytes_.remove_prefix(size);
    return {};
  }

  std::string_view bytes_;
  std::size_t max_bytes_;
  std::string out_;
};

}  // namespace

bool looks_like_lz4(std::string_view bytes) {
  return bytes.starts_with(kFrame) || bytes.starts_with("bv41") || bytes.starts_with("bv4-") ||
         bytes.starts_with("bv4$");
}

Result<std::string> decode(std::string_view bytes, std::size_t max_bytes) {
  if (bytes.starts_with("bv4")) return BlockReader(bytes, max_bytes).run();
  if (bytes.starts_with(kFrame)) return decode_frame(bytes, max_bytes);
  return damaged("it does not begin as one does");
}

}  // namespace turnscan::lz4
