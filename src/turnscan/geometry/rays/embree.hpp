#pragma once
// Common interface of Embree 3 and 4: packets of 16 rays against a scene. The build defines
// TURNSCAN_EMBREE_MAJOR as the major version that it found. Always inlined, because kernels are
// compiled once per instruction set and must not share a copy of a function.

#if TURNSCAN_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace turnscan::embree {

#if TURNSCAN_EMBREE_MAJOR >= 4

/// How a series of packets is traced. Coherent: the rays of a packet take similar paths.
class Query {
 public:
  [[gnu::always_inline]] explicit Query(bool coherent) {
    rtcInitIntersectArguments(&intersect_);
    rtcInitOccludedArguments(&occluded_);
    intersect_.flags = occluded_.flags =
        coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  }
  /// The nearest hits of the lanes whose entry in valid (aligned to 64 bytes) is -1.
  [[gnu::always_inline]] void intersect(const int* valid, RTCScene scene, RTCRayHit16& packet) {
    rtcIntersect16(valid, scene, &packet, &intersect_);
  }
  /// Sets tfar of occluded rays to minus infinity.
  [[gnu::always_inline]] void occluded(const int* valid, RTCScene scene, RTCRay16& packet) {
    rtcOccluded16(valid, scene, &packet, &occluded_);
  }

 private:
  RTCIntersectArguments intersect_;
  RTCOccludedArguments occluded_;
};

#else

class Query {
 public:
  [[gnu::always_inline]] explicit Query(bool coherent) {
    rtcInitIntersectContext(&context_);
    context_.flags =
        coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  [[gnu::always_inline]] void intersect(const int* valid, RTCScene scene, RTCRayHit16& packet) {
    rtcIntersect16(valid, scene, &context_, &packet);
  }
  [[gnu::always_inline]] void occluded(const int* valid, RTCScene scene, RTCRay16& packet) {
    rtcOccluded16(valid, scene, &context_, &packet);
  }

 private:
  RTCIntersectContext context_;
};

#endif

}  // namespace turnscan::embree
