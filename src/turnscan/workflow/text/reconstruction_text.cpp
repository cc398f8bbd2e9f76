#include <turnscan/workflow/text/reconstruction_text.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <turnscan/core/angles.hpp>
#include <turnscan/workflow/text/mesh_text.hpp>
#include <turnscan/workflow/text/text_table.hpp>

namespace turnscan {

namespace {

std::string objects_text(const Reconstruction& r) {
  workflow::TextTable table({});
  table.add({"object", "points", "candidates", "vertices", "triangles", "size", "volume",
             "invented", "watertight"});
  int number = 0;
  for (const ObjectResult& o : r.objects) {
    table.add({std::to_string(++number), std::to_string(o.points), std::to_string(o.candidates),
               std::to_string(o.check.vertices), std::to_string(o.check.triangles),
               size_text(bounds(o.mesh.vertices)),
               o.check.closed ? fmt::format("{:.1f} cm3", o.check.volume_m3 * 1e6) : "open",
               fmt::format("{:.1f} cm2", o.invented_area_m2 * 1e4),
               o.check.watertight() ? "yes" : "no"});
  }
  return table.text();
}

std::string passes_text(const Reconstruction& r) {
  std::map<int, std::vector<std::string>> passes;
  for (const FusedPass& pass : r.passes)
    passes[pass.object].push_back(fmt::format("{} ({} frames)", pass.name, pass.frames));
  std::string text;
  for (const auto& [object, names] : passes)
    text += fmt::format("{}{} passes in one mesh: {}\n",
                        object < 0 ? "" : fmt::format("object {}: ", object + 1), names.size(),
                        fmt::join(names, ", "));
  return text;
}

std::string choices_text(const Reconstruction& r) {
  workflow::TextTable table({0, 1, 2});
  table.add({"option", "value", "why"});
  for (const ResolvedParameter& choice : r.choices) {
    const std::string of = choice.object < 0 || r.objects.size() < 2
                               ? ""
                               : fmt::format(" (object {})", choice.object + 1);
    table.add({choice.option + of, choice.value, choice.reason});
  }
  return table.text();
}

double most_turned(const TextureReport& texture) {
  double most = 0.0;
  for (const double angle : texture.turned_rad) most = std::max(most, std::abs(angle));
  return most;
}

std::string texture_text(const Reconstruction& r) {
  std::string text;
  for (std::size_t i = 0; i < r.objects.size(); ++i) {
    const auto& texture = r.objects[i].texture;
    if (!texture) continue;
    text += fmt::format(
        "Texture{}: {} x {} pixels of {:.2f} mm in {} charts from {} views; {:.1f} % of the "
        "surface was in none of them and is filled from its surroundings\n",
        r.objects.size() < 2 ? "" : fmt::format(" of object {}", i + 1), texture->size_px,
        texture->size_px, texture->texel_m * 1e3, texture->charts, texture->views,
        texture->filled_share * 100.0);
    if (!texture->turned_rad.empty())
      text += fmt::format(
          "Colours are not synchronous with depth: the object had turned by up to {:.2f} deg more "
          "or less; corrected for the texture\n",
          most_turned(*texture) * kDegreesPerRadian);
    if (const auto& highlight = texture->highlight)
      text += fmt::format(
          "Highlight of a lamp {:.0f} deg above the horizontal, at azimuth {:.0f} deg: up to "
          "{:.0f} % of white, removed\n",
          highlight->elevation_rad * kDegreesPerRadian, highlight->azimuth_rad * kDegreesPerRadian,
          highlight->strength * 100.0);
    for (const TextureReport::Camera& camera : texture->cameras)
      text += camera.refined
                  ? fmt::format(
                        "Colour camera of sensor {}: off by {:.1f} pixels (standard deviation "
                        "{:.1f}), {:.1f} mm and {:.2f} deg; corrected for the texture\n",
                        camera.sensor, camera.misplaced_px, camera.deviation_px,
                        camera.moved_m * 1e3, camera.turned_rad * kDegreesPerRadian)
                  : fmt::format(
                        "Colour camera of sensor {}: taken as it is; the images leave {:.1f} "
                        "pixels open\n",
                        camera.sensor, camera.deviation_px);
  }
  return text;
}

std::string times_text(const Reconstruction& r) {
  std::string text;
  double total = 0.0;
  for (const StageTime& stage : r.stages) {
    total += stage.seconds;
    if (stage.seconds >= 0.05)
      text += fmt::format("{}{} {:.1f}", text.empty() ? "" : ", ", stage.stage, stage.seconds);
  }
  return fmt::format("{:.1f} s{}{}{}\n", total, text.empty() ? "" : " (", text,
                     text.empty() ? "" : ")");
}

/// Remarks have no influence on the colour.
bool is_remark(const VerdictSentence& s) { return s.topic == "thin" || s.topic == "help"; }

std::string verdicts_text(const Reconstruction& r) {
  std::string text;
  for (std::size_t i = 0; i < r.objects.size(); ++i) {
    if (!r.objects[i].verdict) continue;
    if (r.objects.size() > 1) text += fmt::format("Object {}. ", i + 1);
    text += verdict_text(*r.objects[i].verdict);
  }
  return text;
}

std::string notes_text(const Reconstruction& r) {
  std::string text;
  for (const std::string& note : r.notes) text += fmt::format("Note: {}\n", note);
  for (std::size_t i = 0; i < r.objects.size(); ++i) {
    for (const std::string& note : r.objects[i].notes)
      text += fmt::format("Note on object {}: {}\n", i + 1, note);
  }
  return text;
}

}  // namespace

std::string verdict_text(const Verdict& verdict) {
  std::string colour(verdict.colour());
  std::transform(colour.begin(), colour.end(), colour.begin(),
                 [](unsigned char c) { return char(std::toupper(c)); });
  workflow::TextTable table({0, 1, 2});
  for (const VerdictSentence& s : verdict.sentences)
    table.add({s.topic, std::string(is_remark(s) ? "note" : name_of(s.level)), s.text});
  const bool good = verdict.level() == Level::kGood;
  return fmt::format("Verdict: {}\n{}{}", colour, table.text(2),
                     good ? "" : "docs/how-to/bad-scan.md lists causes and remedies.\n");
}

std::string reconstruction_text(const Reconstruction& r) {
  std::string text = verdicts_text(r) + notes_text(r);
  text += fmt::format("{}{}\n{} frames, {} returns, {} inside the crop, {} after the filter\n",
                      text.empty() ? "" : "\n", objects_text(r), r.frames, r.returns, r.inside_crop,
                      r.points);
  if (!r.passes.empty()) text += passes_text(r);
  if (r.dropped_frames > 0) text += fmt::format("{} frames were dropped\n", r.dropped_frames);
  if (!r.choices.empty()) text += fmt::format("\n{}", choices_text(r));
  if (const std::string texture = texture_text(r); !texture.empty())
    text += fmt::format("\n{}", texture);
  return text + fmt::format("\n{}", times_text(r));
}

}  // namespace turnscan
