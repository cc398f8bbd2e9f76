#pragma once
// The samples of one packet of rays against several bodies (private).

#include <turnscan/simulator/samples.hpp>
#include <turnscan/simulator/scene_impl.hpp>

namespace turnscan::sampling {

inline constexpr int kLanes = 16;

/// A body as one pose of the sensor sees it.
struct BodyView {
  const Scene::Impl* scene = nullptr;
  std::uint32_t id = 0;    ///< position in the bodies, shifted to its place in Samples::surface
  PixelRect rect;          ///< outside of it no pixel sees the body
  float rotation[9] = {};  ///< body <- sensor, row by row
  float origin[3] = {};    ///< of the rays, body frame
  float other[3] = {};     ///< the other eye, body frame
  float size = 0.0f;       ///< largest coordinate of the origin
};

/// What all packets of one pose have in common.
struct View {
  std::vector<BodyView> bodies;
  float other[3] = {};  ///< the other eye, sensor frame
  int blocked = 0;      ///< the miss of what it does not see
  bool one_way = true;  ///< there is no other eye
  float near_m = 0.0f, far_m = 0.0f;
  float least_cosine = 0.0f;
  float size = 0.0f;  ///< largest of the bodies'
};

/// In: the rays' directions (x, y, 1), NaN where there is none. Out: the rest.
struct alignas(64) Packet {
  float x[kLanes], y[kLanes];
  float z[kLanes];          ///< 0: nothing is hit
  float normal[3][kLanes];  ///< sensor frame, any length
  std::uint32_t surface[kLanes], triangle[kLanes];
  int miss[kLanes];
};

/// bodies: positions in view.bodies of those that the packet may hit.
void trace(const View& view, std::span<const std::uint32_t> bodies, RTCIntersectContext& context,
           Packet& packet);

}  // namespace turnscan::sampling
