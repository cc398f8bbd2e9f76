#include <optional>
#include <turnscan/io/lzfse/entropy_block.hpp>
#include <turnscan/io/lzfse/lzfse.hpp>
#include <turnscan/io/lzfse/lzvn.hpp>

namespace turnscan::lzfse {

namespace {

constexpr std::size_t kMaxPerLzvnByte = 272;  // an instruction of two bytes repeats 271

class StreamReader {
 public:
  StreamReader(std::string_view stream, std::size_t max_bytes)
      : stream_(stream), max_bytes_(max_bytes) {}

  Result<std::string> run() {
    while (true) {
      const std::string_view kind = stream_.substr(at_, 4);
      if (kind == "bvx$") return std::move(out_);
      if (kind == "bvx-") {
        TURNSCAN_TRY(stored());
      } else if (kind == "bvxn") {
        TURNSCAN_TRY(lzvn());
      } else if (kind == "bvx1" || kind == "bvx2") {
        TURNSCAN_TRY(entropy(kind == "bvx1"));
      } else if (kind.size() < 4) {
        return damaged("the stream is cut off");
      } else {
        return damaged("no block begins");
      }
    }
  }

 private:
  std::string_view rest() const { return stream_.substr(at_); }

  tl::unexpected<Error> damaged(std::string_view what) const {
    return fail(ErrorCode::kFormat, "LZFSE: {} at byte {} of {}", what, at_, stream_.size());
  }

  Result<> check_room(std::uint64_t raw_bytes) const {
    if (raw_bytes <= max_bytes_ - out_.size()) return {};
    return fail(ErrorCode::kResourceLimit, "LZFSE: there are more than {} bytes", max_bytes_);
  }

  Result<> stored() {
    if (rest().size() < 8) return damaged("a block is cut off");
    const std::size_t size = number_at(stream_, at_ + 4, 4);
    if (rest().size() - 8 < size) return damaged("a block is cut off");
    TURNSCAN_TRY(check_room(size));
    out_ += rest().substr(8, size);
    at_ += 8 + size;
    return {};
  }

  Result<> lzvn() {
    if (rest().size() < 12) return damaged("a block is cut off");
    const std::uint64_t raw_bytes = number_at(stream_, at_ + 4, 4);
    const std::size_t size = number_at(stream_, at_ + 8, 4);
    if (rest().size() - 12 < size) return damaged("a block is cut off");
    if (raw_bytes > size * kMaxPerLzvnByte) return damaged("a block is damaged");
    TURNSCAN_TRY(check_room(raw_bytes));
    BlockOutput output(out_, raw_bytes);
    if (!unpack_lzvn(rest().substr(12, size), output)) return damaged("a block is damaged");
    at_ += 12 + size;
    return {};
  }

  Result<> entropy(bool first_version) {
    const std::optional<EntropyHeader> header =
        first_version ? parse_header_v1(rest()) : parse_header_v2(rest());
    if (!header) return damaged("the header of a block is damaged or cut off");
    if (rest().size() - header->size < header->payload()) return damaged("a block is cut off");
    if (header->raw_bytes > header->most_bytes()) return damaged("a block is damaged");
    TURNSCAN_TRY(check_room(header->raw_bytes));
    BlockOutput output(out_, header->raw_bytes);
    if (!unpack_entropy(*header, rest().substr(header->size, header->payload()), output))
      return damaged("a block is damaged");
    at_ += header->size + header->payload();
    return {};
  }

  std::string_view stream_;
  std::size_t max_bytes_;
  std::size_t at_ = 0;
  std::string out_;
};

}  // namespace

bool looks_like_lzfse(std::string_view bytes) {
  return bytes.size() >= 4 && bytes.starts_with("bvx") &&
         std::string_view("-12n$").find(bytes[3]) != std::string_view::npos;
}

Result<std::string> decode(std::string_view stream, std::size_t max_bytes) {
  return StreamReader(stream, max_bytes).run();
}

}  // namespace turnscan::lzfse
