// A point and a triangle that shines in, directions uniform in its solid angle or points uniform on
// it out: the same choice, from the same bounds, as swell's.
#ifndef SWELL_BENCH_PEER_TRIANGLE_LIGHT_H_
#define SWELL_BENCH_PEER_TRIANGLE_LIGHT_H_

#include "bench/peer/sampling.h"
#include "kernels/scene_view.h"

namespace swell::bench {

inline constexpr float kTanOfHalfLeast = 0.0500417f;  // 0.1 sr: sampled by area below
inline constexpr float kMostSolidAngle = 6.28f;       // and above this

inline Vec3 Cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// The triangle of a light as a point sees it.
class TriangleView {
 public:
  TriangleView(const LightRecord& light, const Vec3& from)
      : e1_(Load3(light.e1)), e2_(Load3(light.e2)), to_a_(Load3(light.p) - from) {
    a_ = Normalize(to_a_);
    b_ = Normalize(to_a_ + e1_);
    c_ = Normalize(to_a_ + e2_);
    ab_ = Dot(a_, b_);
    bc_ = Dot(b_, c_);
    ca_ = Dot(c_, a_);
    volume_ = std::abs(Dot(a_, Cross(b_, c_)));
    const float sum = 1.0f + ab_ + bc_ + ca_;
    if (sum > 0.0f && volume_ <= kTanOfHalfLeast * sum) return;
    const float angle = 2.0f * std::atan2(volume_, sum);  // Van Oosterom and Strackee 1983
    if (angle < kMostSolidAngle) solid_angle_ = angle;
  }

  // 0: sampled by area.
  float solid_angle() const { return solid_angle_; }

  // To a point on the triangle (Arvo 1995, "Stratified sampling of spherical triangles").
  Vec3 Sample(float u0, float u1) const {
    if (solid_angle_ == 0.0f) {
      const float root = std::sqrt(u0);
      return to_a_ + (root * (1.0f - u1)) * e1_ + (root * u1) * e2_;
    }
    // w on the arc from a to c cuts off u0 of the area; it is a mirrored about o.
    const float half = 0.5f * u0 * solid_angle_;
    const float sin = std::sin(half), cos = std::cos(half);
    const Vec3 o = (volume_ * cos - (ca_ + bc_) * sin) * a_ + ((1.0f + ab_) * sin) * c_;
    const Vec3 w = (2.0f * Dot(a_, o) / Dot(o, o)) * o - a_;
    const Vec3 chord = w - b_;
    const float one_minus_cos = 0.5f * Dot(chord, chord);
    const Vec3 across = Normalize(chord + one_minus_cos * b_);
    const float x = u1 * one_minus_cos;
    const Vec3 dir = std::sqrt(std::max(0.0f, x * (2.0f - x))) * across + (1.0f - x) * b_;
    const Vec3 n = Cross(e1_, e2_);
    return (Dot(n, to_a_) / Dot(n, dir)) * dir;
  }

 private:
  Vec3 e1_, e2_, to_a_;
  Vec3 a_, b_, c_;  // unit vectors to the vertices
  float ab_, bc_, ca_, volume_;
  float solid_angle_ = 0.0f;
};

}  // namespace swell::bench

#endif  // SWELL_BENCH_PEER_TRIANGLE_LIGHT_H_
