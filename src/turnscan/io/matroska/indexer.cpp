#include <algorithm>
#include <turnscan/io/matroska/indexer.hpp>

namespace turnscan::matroska {

namespace {

// Identifiers, RFC 9559 section 5.1.
constexpr std::uint32_t kEbml = 0x1a45dfa3, kDocType = 0x4282, kSegment = 0x18538067,
                        kCluster = 0x1f43b675, kBlockGroup = 0xa0, kBlock = 0xa1,
                        kSimpleBlock = 0xa3, kTimestamp = 0xe7, kInfo = 0x1549a966,
                        kTimestampScale = 0x2ad7b1, kTracks = 0x1654ae6b, kTags = 0x1254c367,
                        kAttachments = 0x1941a469;
constexpr std::uint32_t kTrackEntry = 0xae, kTrackNumber = 0xd7, kTrackUid = 0x73c5,
                        kTrackType = 0x83, kName = 0x536e, kCodecId = 0x86, kCodecPrivate = 0x63a2,
                        kDefaultDuration = 0x23e383, kVideo = 0xe0, kPixelWidth = 0xb0,
                        kPixelHeight = 0xba, kContentEncodings = 0x6d80;
constexpr std::uint32_t kTag = 0x7373, kTargets = 0x63c0, kTagTrackUid = 0x63c5,
                        kTagAttachmentUid = 0x63c6, kSimpleTag = 0x67c8, kTagName = 0x45a3,
                        kTagString = 0x4487;
constexpr std::uint32_t kAttachedFile = 0x61a7, kFileName = 0x466e, kFileData = 0x465c,
                        kFileUid = 0x46ae;

constexpr std::size_t kWindow = 4096;
constexpr std::size_t kMaxTracks = 64;
constexpr std::size_t kMaxTags = 10000;
constexpr std::size_t kMaxAttachments = 1000;
constexpr std::uint64_t kMaxTime_ns = std::uint64_t(1) << 62;
constexpr std::uint64_t kVideoTrack = 1;

int pixels_of(std::string_view payload) {
  return static_cast<int>(std::min<std::uint64_t>(unsigned_number(payload).value_or(0), 1 << 20));
}

}  // namespace

Result<> Indexer::run() {
  TURNSCAN_TRY(read_ebml_header());
  TURNSCAN_TRY(walk());
  if (out_.tracks_.empty() && !stopped_)
    return fail_at(file_.path().string(), ErrorCode::kFormat, "the file describes no tracks");
  return {};
}

Result<std::string_view> Indexer::peek(std::uint64_t at) {
  const std::uint64_t wanted =
      std::min<std::uint64_t>(kMaxElementHeader, file_.size() - std::min(at, file_.size()));
  if (at < window_at_ || at + wanted > window_at_ + window_.size()) {
    TURNSCAN_ASSIGN(window_, file_.read(at, kWindow));
    window_at_ = at;
  }
  return std::string_view(window_).substr(static_cast<std::size_t>(at - window_at_));
}

Result<> Indexer::stop(std::uint64_t at, std::string_view reason) {
  if (frames_ == 0)
    return fail_at(file_.path().string(), ErrorCode::kFormat, "byte {}: {}, before the first frame",
                   at, reason);
  stopped_ = true;
  out_.ended_early_ = fmt::format("at byte {} {}", at, reason);
  return {};
}

Result<std::string> Indexer::whole(const Element& element) const {
  if (element.size > kMaxHeaderBytes)
    return fail_at(file_.path().string(), ErrorCode::kResourceLimit,
                   "byte {}: a header has {} bytes; at most {} are read", element.at, element.size,
                   kMaxHeaderBytes);
  return file_.read(element.begin, element.size);
}

Result<> Indexer::read_ebml_header() {
  TURNSCAN_ASSIGN(const std::string_view bytes, peek(0));
  const auto header = parse_element(bytes, 0);
  if (!header || header->id != kEbml || !header->known_size)
    return fail_at(file_.path().string(), ErrorCode::kFormat, "this is no Matroska file");
  if (header->size > file_.size() - header->begin)
    return fail_at(file_.path().string(), ErrorCode::kFormat,
                   "byte 0: the file ends within its header");
  TURNSCAN_ASSIGN(const std::string payload, whole(*header));
  ChildElements children(payload);
  std::string type = "matroska";
  while (const auto child = children.next()) {
    if (child->id == kDocType) type = text_of(child->payload);
  }
  if (type != "matroska" && type != "webm")
    return fail_at(file_.path().string(), ErrorCode::kFormat,
                   "this is no Matroska file: its type is '{}'", type);
  TURNSCAN_ASSIGN(const std::string_view after, peek(header->begin + header->size));
  const auto segment = parse_element(after, header->begin + header->size);
  if (!segment || segment->id != kSegment)
    return fail_at(file_.path().string(), ErrorCode::kFormat,
                   "byte {}: there is no segment behind the header", header->begin + header->size);
  // The length that a killed recorder left for the segment is not reliable: its elements are
  // followed to the end of the file.
  window_at_ = segment->begin;
  window_.clear();
  if (segment->known_size && segment->size > file_.size() - segment->begin)
    out_.ended_early_ = fmt::format("at byte {} the file is cut off", file_.size());
  return {};
}

/// Enters segment, clusters and block groups, and skips everything else: a single loop thus covers
/// all levels, and a cluster of unknown length needs no special handling.
Result<> Indexer::walk() {
  std::uint64_t at = window_at_;
  while (at < file_.size() && !stopped_) {
    TURNSCAN_TRY(budget_.state());
    TURNSCAN_ASSIGN(const std::string_view bytes, peek(at));
    const auto element = parse_element(bytes, at);
    if (!element)
      return stop(at,
                  bytes.size() < kMaxElementHeader ? "the file is cut off" : "the file is damaged");
    if (element->id == kEbml) return stop(at, "another file follows");
    if (element->id == kCluster || element->id == kBlockGroup) {
      if (element->id == kCluster) cluster_time_ = 0;
      at = element->begin;
      continue;
    }
    if (!element->known_size) return stop(at, "the file is damaged");
    if (element->begin > file_.size() || element->size > file_.size() - element->begin)
      return stop(at, "the file is cut off");
    TURNSCAN_TRY(enter(*element));
    at = element->begin + element->size;
  }
  return {};
}

Result<> Indexer::enter(const Element& element) {
  switch (element.id) {
    case kBlock:
    case kSimpleBlock:
      return read_block(element);
    case kTimestamp: {
      if (element.size > 8) return stop(element.at, "the file is damaged");
      TURNSCAN_ASSIGN(const std::string payload, whole(element));
      cluster_time_ = unsigned_number(payload).value_or(0);
      if (cluster_time_ > kMaxTime_ns / time_scale_ns_)
        return stop(element.at, "a time is beyond all bounds");
      return {};
    }
    case kAttachments:
      return read_attachments(element);
    case kInfo:
    case kTracks:
    case kTags: {
      TURNSCAN_ASSIGN(const std::string payload, whole(element));
      if (element.id == kInfo) return read_info(payload);
      if (element.id == kTracks) return read_tracks(payload);
      read_tags(payload);
      return {};
    }
    default:
      return {};
  }
}

Result<> Indexer::read_info(std::string_view payload) {
  ChildElements children(payload);
  while (const auto child = children.next()) {
    if (child->id != kTimestampScale || frames_ > 0) continue;
    cluster_time_ = 0;  // it was limited by another time scale
    time_scale_ns_ = unsigned_number(child->payload).value_or(0);
    if (time_scale_ns_ < 1 || time_scale_ns_ > 1000000000)
      return fail_at(file_.path().string(), ErrorCode::kFormat,
                     "its times have steps of {} ns, which is outside 1 ns to 1 s", time_scale_ns_);
  }
  return {};
}

Result<> Indexer::read_tracks(std::string_view payload) {
  if (!out_.tracks_.empty()) return {};  // a copy of the first
  ChildElements children(payload);
  while (const auto child = children.next()) {
    if (child->id == kTrackEntry && out_.tracks_.size() < kMaxTracks) read_track(child->payload);
  }
  if (children.damaged())
    return fail_at(file_.path().string(), ErrorCode::kFormat,
                   "the description of its tracks is damaged");
  return {};
}

void Indexer::read_track(std::string_view payload) {
  Track track;
  ChildElements children(payload);
  while (const auto child = children.next()) {
    const auto number = [&] { return unsigned_number(child->payload).value_or(0); };
    switch (child->id) {
      case kTrackNumber:
        track.number = number();
        break;
      case kTrackUid:
        track.uid = number();
        break;
      case kTrackType:
        track.video = number() == kVideoTrack;
        break;
      case kName:
        track.name = text_of(child->payload);
        break;
      case kCodecId:
        track.codec = text_of(child->payload);
        break;
      case kCodecPrivate:
        track.codec_private = std::string(child->payload.substr(0, 4096));
        break;
      case kDefaultDuration:
        track.frame_time_ns = number();
        break;
      case kContentEncodings:
        track.encoded = true;
        break;
      case kVideo: {
        ChildElements video(child->payload);
        while (const auto field = video.next()) {
          if (field->id == kPixelWidth) track.width = pixels_of(field->payload);
          if (field->id == kPixelHeight) track.height = pixels_of(field->payload);
        }
        break;
      }
      default:
        break;
    }
  }
  out_.tracks_.push_back(std::move(track));
}

void Indexer::read_tags(std::string_view payload) {
  ChildElements tags(payload);
  while (const auto tag = tags.next()) {
    if (tag->id != kTag) continue;
    Tag out;
    std::vector<std::string_view> simple;
    ChildElements parts(tag->payload);
    while (const auto part = parts.next()) {
      if (part->id == kSimpleTag) simple.push_back(part->payload);
      if (part->id != kTargets) continue;
      ChildElements targets(part->payload);
      while (const auto target = targets.next()) {
        if (target->id == kTagTrackUid) out.track = unsigned_number(target->payload).value_or(0);
        if (target->id == kTagAttachmentUid)
          out.attachment = unsigned_number(target->payload).value_or(0);
      }
    }
    for (const std::string_view text : simple) {
      out.name.clear(), out.value.clear();
      ChildElements fields(text);
      while (const auto field = fields.next()) {
        if (field->id == kTagName) out.name = text_of(field->payload);
        if (field->id == kTagString) out.value = text_of(field->payload);
      }
      if (out_.tags_.size() < kMaxTags) out_.tags_.push_back(out);
    }
  }
}

/// Only records the positions of the attachments' contents.
Result<> Indexer::read_attachments(const Element& element) {
  const std::uint64_t end = element.begin + element.size;
  std::uint64_t at = element.begin;
  while (at < end) {
    TURNSCAN_ASSIGN(const std::string_view bytes, peek(at));
    const auto child = parse_element(bytes, at);
    if (!child || !child->known_size || child->begin > end || child->size > end - child->begin)
      return stop(at, "an attachment is damaged");
    at = child->begin;
    if (child->id == kAttachedFile) {
      if (out_.attachments_.size() == kMaxAttachments) return {};
      out_.attachments_.emplace_back();
      continue;
    }
    at += child->size;
    if (out_.attachments_.empty()) continue;
    Attachment& file = out_.attachments_.back();
    if (child->id == kFileData) file.at = child->begin, file.size = child->size;
    if (child->id != kFileName && child->id != kFileUid) continue;
    TURNSCAN_ASSIGN(const std::string payload, whole(*child));
    if (child->id == kFileName) file.name = text_of(payload);
    if (child->id == kFileUid) file.uid = unsigned_number(payload).value_or(0);
  }
  return {};
}

Track* Indexer::track_of(std::uint64_t number) {
  for (Track& track : out_.tracks_)
    if (track.number == number) return &track;
  return nullptr;
}

/// A block: track number, time relative to its cluster (16 bits), flags, payload.
Result<> Indexer::read_block(const Element& element) {
  TURNSCAN_ASSIGN(const std::string_view bytes, peek(element.begin));
  const auto number = parse_variable_number(bytes);
  const std::size_t header = number ? number->length + 3 : 0;
  if (!number || element.size < header || bytes.size() < header)
    return stop(element.at, "a block is damaged");
  Track* track = track_of(number->value);
  if (track == nullptr || !track->video) return {};
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const auto after = static_cast<std::int16_t>(byte(header - 3) << 8 | byte(header - 2));
  constexpr unsigned kLacing = 0x06;
  if ((byte(header - 1) & kLacing) != 0)
    return fail_at(file_.path().string(), ErrorCode::kUnsupported,
                   "byte {}: several frames share a block (lacing); recordings of depth sensors do "
                   "not",
                   element.at);
  TURNSCAN_TRY(budget_.hold(file::ReadBudget::kFrame));
  if (element.size - header > 0xffffffffu) return stop(element.at, "a block is damaged");
  ++frames_;
  track->blocks.push_back({(static_cast<std::int64_t>(cluster_time_) + after) *
                               static_cast<std::int64_t>(time_scale_ns_),
                           element.begin + header,
                           static_cast<std::uint32_t>(element.size - header)});
  return {};
}

}  // namespace turnscan::matroska
