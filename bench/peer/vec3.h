// Scalar vectors, colours and frames of the peer.
#ifndef SWELL_BENCH_PEER_VEC3_H_
#define SWELL_BENCH_PEER_VEC3_H_

#include <algorithm>
#include <cmath>

namespace swell::bench {

struct Vec3 {
  float x = 0, y = 0, z = 0;
};
using Rgb = Vec3;

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Vec3 operator*(float s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline float Dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 Normalize(const Vec3& a) { return (1.0f / std::sqrt(Dot(a, a))) * a; }
inline float MaxComponent(const Vec3& a) { return std::max(a.x, std::max(a.y, a.z)); }
inline float MaxAbsComponent(const Vec3& a) {
  return std::max(std::abs(a.x), std::max(std::abs(a.y), std::abs(a.z)));
}
inline Vec3 Load3(const float* v) { return {v[0], v[1], v[2]}; }

// An orthonormal basis around a unit z (Duff et al. 2017, JCGT 6(1)).
struct Frame {
  explicit Frame(const Vec3& normal) : z(normal) {
    const float sign = std::copysign(1.0f, z.z);
    const float a = -1.0f / (sign + z.z);
    const float b = z.x * z.y * a;
    x = {1.0f + sign * z.x * z.x * a, sign * b, -sign * z.x};
    y = {b, sign + z.y * z.y * a, -z.y};
  }
  Vec3 ToLocal(const Vec3& v) const { return {Dot(x, v), Dot(y, v), Dot(z, v)}; }
  Vec3 ToWorld(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }

  Vec3 x, y, z;
};

}  // namespace swell::bench

#endif  // SWELL_BENCH_PEER_VEC3_H_
