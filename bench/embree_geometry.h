// A scene's triangles in, an Embree scene of one geometry out. Embree 3, or 4 if
// SWELL_EMBREE_MAJOR says so.
#ifndef SWELL_BENCH_EMBREE_GEOMETRY_H_
#define SWELL_BENCH_EMBREE_GEOMETRY_H_

#if defined(SWELL_EMBREE_MAJOR) && SWELL_EMBREE_MAJOR == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstring>

#include "src/scene/scene.h"

namespace swell::bench {

// One geometry of all triangles, so that Embree's primitive is the scene's. Not committed. The
// caller releases it.
inline RTCScene AttachTriangles(RTCDevice device, const Scene& scene) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           3 * sizeof(float), scene.positions.size() / 3);
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          3 * sizeof(uint32_t), scene.triangle_count());
  std::memcpy(vertices, scene.positions.data(), scene.positions.size() * sizeof(float));
  std::memcpy(indices, scene.indices.data(), scene.indices.size() * sizeof(uint32_t));
  rtcCommitGeometry(geometry);
  const RTCScene attached = rtcNewScene(device);
  rtcAttachGeometry(attached, geometry);
  rtcReleaseGeometry(geometry);
  return attached;
}

inline RTCScene MakeEmbreeScene(RTCDevice device, const Scene& scene) {
  const RTCScene built = AttachTriangles(device, scene);
  rtcCommitScene(built);
  return built;
}

}  // namespace swell::bench

#endif  // SWELL_BENCH_EMBREE_GEOMETRY_H_
