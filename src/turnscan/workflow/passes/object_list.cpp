#include <algorithm>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/workflow/passes/object_list.hpp>

namespace turnscan {

namespace {

void add_times(const std::vector<StageTime>& times, std::vector<StageTime>& all) {
  for (const StageTime& time : times) {
    const auto same = std::find_if(
        all.begin(), all.end(), [&](const StageTime& other) { return other.stage == time.stage; });
    if (same == all.end())
      all.push_back(time);
    else
      same->seconds += time.seconds;
  }
}

template <class Value>
void append_attribute(const std::vector<Value>& values, std::size_t count, std::size_t before,
                      std::vector<Value>& all) {
  if (values.size() != count || all.size() != before)
    all.clear();
  else
    all.insert(all.end(), values.begin(), values.end());
}

}  // namespace

Reconstruction list_objects(std::vector<Reconstruction> made) {
  std::stable_sort(made.begin(), made.end(), [](const Reconstruction& x, const Reconstruction& y) {
    return surface_area(x.objects.at(0).mesh) > surface_area(y.objects.at(0).mesh);
  });
  Reconstruction out;
  out.sensor_noise_m = made.at(0).sensor_noise_m;
  out.merged_noise_m = made[0].merged_noise_m;
  out.frame_spacing_m = made[0].frame_spacing_m;
  for (std::size_t k = 0; k < made.size(); ++k) {
    Reconstruction& one = made[k];
    out.objects.push_back(std::move(one.objects[0]));
    for (ResolvedParameter& choice : one.choices) {
      choice.object = int(k);
      out.choices.push_back(std::move(choice));
    }
    for (FusedPass& pass : one.passes) {
      pass.object = int(k);
      out.passes.push_back(std::move(pass));
    }
    for (const std::string& note : one.notes)
      out.notes.push_back(fmt::format("object {}: {}", k + 1, note));
    add_times(one.stages, out.stages);
    // A frame of a pass shows several objects.
    out.frames = std::max(out.frames, one.frames);
    out.dropped_frames = std::max(out.dropped_frames, one.dropped_frames);
    out.returns = std::max(out.returns, one.returns);
    out.inside_crop += one.inside_crop;
    out.points += one.points;
  }
  return out;
}

void append_cloud(const PointCloud& cloud, PointCloud& all) {
  const std::size_t before = all.size(), count = cloud.size();
  append_attribute(cloud.normals, count, before, all.normals);
  append_attribute(cloud.colors, count, before, all.colors);
  append_attribute(cloud.weights, count, before, all.weights);
  append_attribute(cloud.frame, count, before, all.frame);
  all.points.insert(all.points.end(), cloud.points.begin(), cloud.points.end());
}

}  // namespace turnscan
