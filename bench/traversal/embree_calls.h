// Embree's functions for rays under one name each, whatever its version and the width of a packet.
#ifndef SWELL_BENCH_TRAVERSAL_EMBREE_CALLS_H_
#define SWELL_BENCH_TRAVERSAL_EMBREE_CALLS_H_

#include "bench/embree_geometry.h"

namespace swell::bench {

#if SWELL_EMBREE_MAJOR == 4
struct Query {
  explicit Query(bool coherent) {
    rtcInitIntersectArguments(&closest);
    rtcInitOccludedArguments(&any);
    closest.flags = any.flags =
        coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
  }
  RTCIntersectArguments closest;
  RTCOccludedArguments any;
};
#else
struct Query {
  explicit Query(bool coherent) {
    rtcInitIntersectContext(&context);
    context.flags =
        coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  RTCIntersectContext context;
};
#endif

template <int N> struct Packet;

template <> struct Packet<1> {
  using Ray = RTCRay;
  using RayHit = RTCRayHit;
  static void Intersect(const int* /*valid*/, RTCScene scene, Query& query, RayHit* rays) {
#if SWELL_EMBREE_MAJOR == 4
    rtcIntersect1(scene, rays, &query.closest);
#else
    rtcIntersect1(scene, &query.context, rays);
#endif
  }
  static void Occlude(const int* /*valid*/, RTCScene scene, Query& query, Ray* rays) {
#if SWELL_EMBREE_MAJOR == 4
    rtcOccluded1(scene, rays, &query.any);
#else
    rtcOccluded1(scene, &query.context, rays);
#endif
  }
};

template <> struct Packet<4> {
  using Ray = RTCRay4;
  using RayHit = RTCRayHit4;
  static void Intersect(const int* valid, RTCScene scene, Query& query, RayHit* rays) {
#if SWELL_EMBREE_MAJOR == 4
    rtcIntersect4(valid, scene, rays, &query.closest);
#else
    rtcIntersect4(valid, scene, &query.context, rays);
#endif
  }
  static void Occlude(const int* valid, RTCScene scene, Query& query, Ray* rays) {
#if SWELL_EMBREE_MAJOR == 4
    rtcOccluded4(valid, scene, rays, &query.any);
#else
    rtcOccluded4(valid, scene, &query.context, rays);
#endif
  }
};

template <> struct Packet<8> {
  using Ray = RTCRay8;
  using RayHit = RTCRayHit8;
  static void Intersect(const int* valid, RTCScene scene, Query& query, RayHit* rays) {
#if SWELL_EMBREE_MAJOR == 4
    rtcIntersect8(valid, scene, rays, &query.closest);
#else
    rtcIntersect8(valid, scene, &query.context, rays);
#endif
  }
  static void Occlude(const int* valid, RTCScene scene, Query& query, Ray* rays) {
#if SWELL_EMBREE_MAJOR == 4
    rtcOccluded8(valid, scene, rays, &query.any);
#else
    rtcOccluded8(valid, scene, &query.context, rays);
#endif
  }
};

template <> struct Packet<16> {
  using Ray = RTCRay16;
  using RayHit = RTCRayHit16;
  static void Intersect(const int* valid, RTCScene scene, Query& query, RayHit* rays) {
#if SWELL_EMBREE_MAJOR == 4
    rtcIntersect16(valid, scene, rays, &query.closest);
#else
    rtcIntersect16(valid, scene, &query.context, rays);
#endif
  }
  static void Occlude(const int* valid, RTCScene scene, Query& query, Ray* rays) {
#if SWELL_EMBREE_MAJOR == 4
    rtcOccluded16(valid, scene, rays, &query.any);
#else
    rtcOccluded16(valid, scene, &query.context, rays);
#endif
  }
};

}  // namespace swell::bench

#endif  // SWELL_BENCH_TRAVERSAL_EMBREE_CALLS_H_
