#include <bzlib.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <turnscan/io/file/clean_name.hpp>
#include <turnscan/io/lz4/lz4.hpp>
#include <turnscan/io/rosbag/chunk_codec.hpp>

namespace turnscan::rosbag {

namespace {

constexpr std::size_t kFirstRoom = std::size_t(16) << 20;

/// Grows by doubling, so that a false size costs little.
void widen(std::string& out, std::size_t size) {
  out.resize(std::min(size, std::max(kFirstRoom, 2 * out.size())));
}

tl::unexpected<Error> damaged(std::string_view why) {
  return fail(ErrorCode::kFormat, "the chunk cannot be unpacked: {}; the file is damaged", why);
}

Result<std::string> unpack_lz4(std::string_view bytes, std::size_t size) {
  auto out = lz4::decode(bytes, size);
  if (!out && out.error().code == ErrorCode::kLibrary) return out;
  if (!out) return damaged(out.error().message);
  if (out->size() != size) return damaged("its length is not that of its header");
  return out;
}

Result<std::string> unpack_bz2(std::string_view bytes, std::size_t size) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK)
    return fail(ErrorCode::kLibrary, "libbz2 cannot begin; there may be too little memory");
  stream.next_in = const_cast<char*>(bytes.data());
  stream.avail_in = static_cast<unsigned>(bytes.size());
  std::string out;
  std::size_t made = 0;
  int state = BZ_OK;
  while (state == BZ_OK) {
    if (made == out.size() && made < size) widen(out, size);
    if (made == out.size()) break;  // reached the size in its header
    const unsigned room = static_cast<unsigned>(out.size() - made);
    stream.next_out = out.data() + made;
    stream.avail_out = room;
    const unsigned before = stream.avail_in;
    state = BZ2_bzDecompress(&stream);
    made += room - stream.avail_out;
    if (state == BZ_OK && stream.avail_out == room && stream.avail_in == before) break;
  }
  BZ2_bzDecompressEnd(&stream);
  if (state != BZ_OK && state != BZ_STREAM_END) return damaged(fmt::format("bzip2 says {}", state));
  if (made != size) return damaged("its length is not that of its header");
  return out;
}

struct FreeZstd {
  void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
};

Result<std::string> unpack_zstd(std::string_view bytes, std::size_t size) {
  const std::unique_ptr<ZSTD_DStream, FreeZstd> stream(ZSTD_createDStream());
  if (stream == nullptr)
    return fail(ErrorCode::kLibrary, "libzstd cannot begin; there may be too little memory");
  // What a frame asks for as window is no more than its content needs.
  constexpr int kWindowLog = 27;
  (void)ZSTD_DCtx_setParameter(stream.get(), ZSTD_d_windowLogMax, kWindowLog);
  std::string out;
  ZSTD_inBuffer from{bytes.data(), bytes.size(), 0};
  std::size_t made = 0;
  while (from.pos < from.size || made < size) {
    if (made == out.size() && made < size) widen(out, size);
    ZSTD_outBuffer to{out.data(), out.size(), made};
    const std::size_t before = from.pos;
    const std::size_t state = ZSTD_decompressStream(stream.get(), &to, &from);
    if (ZSTD_isError(state)) return damaged(ZSTD_getErrorName(state));
    if (to.pos == made && from.pos == before) break;  // cut off, or longer than its header says
    made = to.pos;
  }
  if (made != size || from.pos < from.size) return damaged("its length is not that of its header");
  return out;
}

}  // namespace

Result<Packing> packing_of(std::string_view name) {
  if (name == "none") return Packing::kNone;
  if (name == "bz2") return Packing::kBz2;
  if (name == "lz4") return Packing::kLz4;
  if (name == "zstd") return Packing::kZstd;
  return fail(ErrorCode::kUnsupported,
              "a chunk is packed by '{}'; none, bz2, lz4 and zstd are read", name.substr(0, 40));
}

Result<std::string> unpack(Packing packing, std::string_view bytes, std::size_t size) {
  switch (packing) {
    case Packing::kBz2:
      return unpack_bz2(bytes, size);
    case Packing::kLz4:
      return unpack_lz4(bytes, size);
    case Packing::kZstd:
      return unpack_zstd(bytes, size);
    case Packing::kNone:
      break;
  }
  if (bytes.size() != size) return damaged("its length is not that of its header");
  return std::string(bytes);
}

}  // namespace turnscan::rosbag
