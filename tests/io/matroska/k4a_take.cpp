#include "tests/io/matroska/k4a_take.hpp"

#include <ebml/EbmlHead.h>
#include <ebml/EbmlSubHead.h>
#include <ebml/StdIOCallback.h>
#include <matroska/KaxAttached.h>
#include <matroska/KaxAttachments.h>
#include <matroska/KaxBlock.h>
#include <matroska/KaxCluster.h>
#include <matroska/KaxClusterData.h>
#include <matroska/KaxCues.h>
#include <matroska/KaxInfoData.h>
#include <matroska/KaxSegment.h>
#include <matroska/KaxTag.h>
#include <matroska/KaxTags.h>
#include <matroska/KaxTracks.h>

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace turnscan::testing {

namespace {

using namespace libebml;
using namespace libmatroska;

constexpr std::uint64_t kMicrosecond = 1000;

template <class Field, class Parent>
void put_number(Parent& parent, std::uint64_t value) {
  static_cast<EbmlUInteger&>(GetChild<Field>(parent)).SetValue(value);
}
template <class Field, class Parent>
void put_text(Parent& parent, const std::string& value) {
  static_cast<EbmlUnicodeString&>(GetChild<Field>(parent)).SetValueUTF8(value);
}
template <class Field, class Parent>
void put_bytes(Parent& parent, const std::string& bytes) {
  static_cast<EbmlBinary&>(GetChild<Field>(parent))
      .CopyBuffer(reinterpret_cast<const binary*>(bytes.data()), std::uint32_t(bytes.size()));
}

std::string bitmap_header(int width, int height, const std::string& codec) {
  std::string out(40, '\0');
  const auto put = [&](std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) out[at + i] = char(value >> (8 * i) & 0xff);
  };
  put(0, 40), put(4, std::uint32_t(width)), put(8, std::uint32_t(height));
  put(12, 1u | 16u << 16);
  out.replace(16, 4, codec);
  return out;
}

KaxTrackEntry& add_track(KaxTracks& tracks, std::uint64_t number, const std::string& name,
                         int width, int height, const std::string& codec,
                         std::uint64_t frame_time_ns) {
  auto& track = AddNewChild<KaxTrackEntry>(tracks);
  track.SetGlobalTimecodeScale(kMicrosecond);
  put_number<KaxTrackNumber>(track, number);
  put_number<KaxTrackUID>(track, 1000 + number);
  put_number<KaxTrackType>(track, track_video);
  put_text<KaxTrackName>(track, name);
  static_cast<EbmlString&>(GetChild<KaxCodecID>(track)).SetValue("V_MS/VFW/FOURCC");
  put_bytes<KaxCodecPrivate>(track, bitmap_header(width, height, codec));
  if (frame_time_ns > 0) put_number<KaxTrackDefaultDuration>(track, frame_time_ns);
  auto& video = GetChild<KaxTrackVideo>(track);
  put_number<KaxVideoPixelWidth>(video, std::uint64_t(width));
  put_number<KaxVideoPixelHeight>(video, std::uint64_t(height));
  return track;
}

void add_tag(KaxTags& tags, const std::string& name, const std::string& value,
             std::uint64_t track_uid) {
  auto& tag = AddNewChild<KaxTag>(tags);
  auto& targets = GetChild<KaxTagTargets>(tag);
  if (track_uid > 0) put_number<KaxTagTrackUID>(targets, track_uid);
  auto& simple = GetChild<KaxTagSimple>(tag);
  put_text<KaxTagName>(simple, name);
  put_text<KaxTagString>(simple, value);
}

DataBuffer* copy_of(const std::string& bytes) {
  auto* copy = new binary[bytes.size()];
  std::copy(bytes.begin(), bytes.end(), copy);
  return new DataBuffer(copy, std::uint32_t(bytes.size()), [](const DataBuffer& buffer) {
    delete[] const_cast<DataBuffer&>(buffer).Buffer();
    return true;
  });
}

struct Written {
  KaxTrackEntry* track;
  const std::string* bytes;
};

}  // namespace

std::string big_endian(const DepthImage& image) {
  std::string out;
  for (const std::uint16_t value : image.pixels) {
    out += char(value >> 8);
    out += char(value & 0xff);
  }
  return out;
}

void K4aTake::add_depth(double time_s, const DepthImage& image) {
  depth.push_back({std::uint64_t(std::llround(time_s * 1e6)), big_endian(image)});
}

void K4aTake::write(const std::filesystem::path& path) const {
  StdIOCallback out(path.c_str(), MODE_CREATE);
  EbmlHead head;
  static_cast<EbmlString&>(GetChild<EDocType>(head)).SetValue("matroska");
  put_number<EDocTypeVersion>(head, 2);
  put_number<EDocTypeReadVersion>(head, 2);
  head.Render(out, true);
  KaxSegment segment;
  segment.WriteHead(out, 8);

  auto& info = GetChild<KaxInfo>(segment);
  put_number<KaxTimecodeScale>(info, kMicrosecond);
  put_text<KaxMuxingApp>(info, "libmatroska");
  put_text<KaxWritingApp>(info, "k4arecord-1.4.1");
  put_text<KaxTitle>(info, "Azure Kinect");
  info.Render(out);

  auto& tracks = GetChild<KaxTracks>(segment);
  KaxTrackEntry* color_entry = nullptr;
  if (!color.empty())
    color_entry =
        &add_track(tracks, 1, "COLOR", color_width, color_height, color_codec, frame_time_ns);
  KaxTrackEntry& depth_entry =
      add_track(tracks, 2, "DEPTH", width, height, depth_codec, frame_time_ns);
  add_track(tracks, 3, "IR", width, height, "b16g", frame_time_ns);
  tracks.Render(out);

  if (!calibration.empty()) {
    auto& attachments = GetChild<KaxAttachments>(segment);
    auto& file = GetChild<KaxAttached>(attachments);
    put_text<KaxFileName>(file, "calibration.json");
    static_cast<EbmlString&>(GetChild<KaxMimeType>(file)).SetValue("application/octet-stream");
    put_bytes<KaxFileData>(file, calibration);
    put_number<KaxFileUID>(file, 77);
    attachments.Render(out);
  }
  auto& all_tags = GetChild<KaxTags>(segment);
  all_tags.EnableChecksum();
  add_tag(all_tags, "K4A_DEPTH_TRACK", "1002", 1002);
  for (const auto& [name, value] : tags) add_tag(all_tags, name, value, 0);
  all_tags.Render(out);

  auto& index = GetChild<KaxCues>(segment);
  index.SetGlobalTimecodeScale(kMicrosecond);
  std::multimap<std::uint64_t, Written> blocks;
  for (const Image& image : depth) blocks.insert({image.time_us, {&depth_entry, &image.bytes}});
  for (const Image& image : color) blocks.insert({image.time_us, {color_entry, &image.bytes}});
  // One cluster for what lies within 30 ms, as the recorder does it.
  for (auto block = blocks.begin(); block != blocks.end();) {
    const std::uint64_t first = block->first;
    KaxCluster cluster;
    cluster.SetParent(segment);
    cluster.InitTimecode(first, std::int64_t(kMicrosecond));
    cluster.EnableChecksum();
    for (; block != blocks.end() && block->first < first + 30000; ++block) {
      const Written& written = block->second;
      const std::uint64_t time_ns = block->first * kMicrosecond;
      if (block_groups) {
        KaxBlockGroup* group = nullptr;
        cluster.AddFrame(*written.track, time_ns, *copy_of(*written.bytes), group, LACING_NONE);
      } else {
        auto* simple = new KaxSimpleBlock;
        simple->SetParent(cluster);
        simple->AddFrame(*written.track, time_ns, *copy_of(*written.bytes), LACING_NONE);
        cluster.PushElement(*simple);
      }
    }
    cluster.Render(out, index);
  }
  if (cues) index.Render(out);
  const std::uint64_t size =
      out.getFilePointer() - segment.GetElementPosition() - segment.HeadSize();
  if (segment.ForceSize(size)) segment.OverwriteHead(out);
  out.close();
}

std::string k4a_calibration(double metric_radius) {
  const std::string radius = fmt::format("{}", metric_radius);
  return R"({"CalibrationInformation": {"Cameras": [
 {"Intrinsics": {"ModelParameterCount": 14, "ModelParameters": [0.51297, 0.516924, 0.492781,
   0.492903, 0.54794, -0.020971, -0.0026522, 0.889679, 0.08613, -0.01391, 0, 0, -7.21E-5, 2.056E-5],
   "ModelType": "CALIBRATION_LensDistortionModelBrownConrady"},
  "Location": "CALIBRATION_CameraLocationD0", "Purpose": "CALIBRATION_CameraPurposeDepth",
  "MetricRadius": )" +
         radius + R"(, "Rt": {"Rotation": [1, 0, 0, 0, 1, 0, 0, 0, 1], "Translation": [0, 0, 0]},
  "SensorHeight": 1024, "SensorWidth": 1024},
 {"Intrinsics": {"ModelParameterCount": 14, "ModelParameters": [0.499847, 0.506618, 0.477965,
   0.637424, 0.330121, -2.489397, 1.453671, 0.208912, -2.302915, 1.375128, 0, 0, -0.000129445,
   -0.000161782], "ModelType": "CALIBRATION_LensDistortionModelBrownConrady"},
  "Location": "CALIBRATION_CameraLocationPV0", "Purpose": "CALIBRATION_CameraPurposePhotoVideo",
  "MetricRadius": 0, "Rt": {"Rotation": [0.99999922513961792, 0.0011817576596513391,
   -0.00044814043212682009, -0.0011387512786313891, 0.99628061056137085, 0.0861603245139122,
   0.0005482942215166986, -0.086159750819206238, 0.9962812066078186],
   "Translation": [-0.032083429396152496, -0.0022053730208426714, 0.0038836926687508821]},
  "SensorHeight": 3072, "SensorWidth": 4096}]}})";
}

}  // namespace turnscan::testing
