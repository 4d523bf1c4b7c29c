// One ray and a scene in, its hit out: every primitive is tested, in plain scalar code.
#include "tests/reference/intersect.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "kernels/bvh_node.h"

namespace swell::reference {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

using Float3 = std::array<float, 3>;

float MaxAbs(const Float3& v) {
  return std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
}

float Dot(const Float3& a, const Float3& b) {
  return std::fma(a[0], b[0], std::fma(a[1], b[1], a[2] * b[2]));
}

struct Box {
  Float3 lower, upper;
};

Box Widened(Box box) {
  float most = 0.0f;
  for (int k = 0; k < 3; ++k) most = std::max({most, -box.lower[k], box.upper[k]});
  for (int k = 0; k < 3; ++k) {
    box.lower[k] -= most * kBoxMargin;
    box.upper[k] += most * kBoxMargin;
  }
  return box;
}

// False if the ray misses the box; else t is not below the entry.
bool ClampToBox(const Ray& ray, const Box& box, float reach, float& t) {
  float enter = 0.0f, leave = kInfinity;
  const float limit = 0x1p125f / std::max(MaxAbs(ray.org) + reach, 0x1p29f);
  const float margin = MaxAbs(ray.org) * kBoxMargin;
  for (int k = 0; k < 3; ++k) {
    const float inv = std::copysign(std::min(std::fabs(1.0f / ray.dir[k]), limit), ray.dir[k]);
    const float bias = -(ray.org[k] * inv), widening = margin * std::fabs(inv);
    const float near = inv < 0.0f ? box.upper[k] : box.lower[k];
    const float far = inv < 0.0f ? box.lower[k] : box.upper[k];
    enter = std::max(enter, std::fma(near, inv, bias - widening));
    leave = std::min(leave, std::fma(far, inv, bias + widening));
  }
  t = std::max(t, enter);
  return enter <= leave;
}

const float* Vertex(const Scene& scene, uint32_t prim, int k) {
  return &scene.positions[3 * size_t{scene.indices[3 * size_t{prim} + k]}];
}

Box TriangleBox(const Scene& scene, uint32_t prim) {
  Box box = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (int k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::min(box.lower[axis], Vertex(scene, prim, k)[axis]);
      box.upper[axis] = std::max(box.upper[axis], Vertex(scene, prim, k)[axis]);
    }
  }
  return Widened(box);
}

Box SphereBox(const SphereRecord& sphere) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    const float* row = &sphere.object_to_world[4 * k];
    const double x = row[0], y = row[1], z = row[2], centre = row[3];
    const double extent = std::sqrt(x * x + y * y + z * z);
    box.lower[k] = std::nextafter(static_cast<float>(centre - extent), -kInfinity);
    box.upper[k] = std::nextafter(static_cast<float>(centre + extent), kInfinity);
  }
  return Widened(box);
}

bool HitTriangle(const Scene& scene, uint32_t prim, const Ray& ray, HitFields<Row>& hit) {
  const Float3 d = {std::fabs(ray.dir[0]), std::fabs(ray.dir[1]), std::fabs(ray.dir[2])};
  const int kz = d[0] >= d[1] && d[0] >= d[2] ? 0 : d[1] >= d[2] ? 1 : 2;
  const int kx = (kz + 1) % 3, ky = (kz + 2) % 3;
  const float shear_x = ray.dir[kx] / ray.dir[kz], shear_y = ray.dir[ky] / ray.dir[kz];
  float x[3], y[3], z[3];
  for (int k = 0; k < 3; ++k) {
    const float* v = Vertex(scene, prim, k);
    z[k] = v[kz] - ray.org[kz];
    x[k] = std::fma(-shear_x, z[k], v[kx] - ray.org[kx]);
    y[k] = std::fma(-shear_y, z[k], v[ky] - ray.org[ky]);
  }
  const auto inside = [](float a, float b, float c) {
    const bool mixed = (a < 0 || b < 0 || c < 0) && (a > 0 || b > 0 || c > 0);
    return !mixed && (a + b) + c != 0.0f;
  };
  const auto rough = [&](int p, int q) { return x[p] * y[q] - y[p] * x[q]; };
  const auto edge = [&](int p, int q) {
    const float product = y[p] * x[q];
    return std::fma(x[p], y[q], -product) - std::fma(y[p], x[q], -product);
  };
  const float a = edge(2, 1), b = edge(0, 2), c = edge(1, 0);
  const float det = (a + b) + c;
  if (!inside(rough(2, 1), rough(0, 2), rough(1, 0)) || !inside(a, b, c)) return false;
  const float depth = std::fma(a, z[0], std::fma(b, z[1], c * z[2]));
  const float inv_det = 1.0f / det;
  hit = {depth * (1.0f / ray.dir[kz]) * inv_det, prim, b * inv_det, c * inv_det, kNone};
  return hit.t > 0.0f;
}

struct Twofold {
  float high, low;
};
Twofold TwoSum(float a, float b) {
  const float sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}
Twofold TwoDot(const Float3& a, const Float3& high, const Float3& low) {
  Float3 product, rounding;
  for (int k = 0; k < 3; ++k) {
    product[k] = a[k] * high[k];
    rounding[k] = std::fma(a[k], high[k], -product[k]);
  }
  const Twofold xy = TwoSum(product[0], product[1]), xyz = TwoSum(xy.high, product[2]);
  return {xyz.high,
          (((rounding[0] + rounding[1]) + rounding[2]) + (xy.low + xyz.low)) + Dot(a, low)};
}

// |to_object (org - centre)|^2 - 1 to twice the precision.
float HeightOverSphere(const SphereRecord& sphere, const Float3& org) {
  Float3 high, low, o, twice_low;
  for (int k = 0; k < 3; ++k) {
    const Twofold from = TwoSum(org[k], -sphere.object_to_world[4 * k + 3]);
    high[k] = from.high;
    low[k] = from.low;
  }
  for (int k = 0; k < 3; ++k) {
    const float* row = &sphere.world_to_object[4 * k];
    const Twofold in_object = TwoDot({row[0], row[1], row[2]}, high, low);
    o[k] = in_object.high;
    twice_low[k] = in_object.low + in_object.low;
  }
  const Twofold square = TwoDot(o, o, twice_low), height = TwoSum(square.high, -1.0f);
  return height.high + (height.low + square.low);
}

bool HitSphere(const SphereRecord& sphere, const Ray& ray, float& t) {
  Float3 from_centre, o, d;
  for (int k = 0; k < 3; ++k) from_centre[k] = ray.org[k] - sphere.object_to_world[4 * k + 3];
  for (int k = 0; k < 3; ++k) {
    const float* row = &sphere.world_to_object[4 * k];
    o[k] = Dot({row[0], row[1], row[2]}, from_centre);
    d[k] = Dot({row[0], row[1], row[2]}, ray.dir);
  }
  const float a = Dot(d, d), b = -Dot(o, d);
  float c = std::fma(o[0], o[0], std::fma(o[1], o[1], std::fma(o[2], o[2], -1.0f)));
  Float3 closest;
  for (int k = 0; k < 3; ++k) closest[k] = std::fma(b / a, d[k], o[k]);
  float discriminant = 1.0f - Dot(closest, closest);
  if (std::fabs(c) < 0x1p-5f) {
    c = HeightOverSphere(sphere, ray.org);
    discriminant = std::fma(b / a, b, -c);
  }
  if (!(discriminant >= 0.0f)) return false;
  const float q = b + std::copysign(std::sqrt(a * discriminant), b);
  const float near = std::min(c / q, q / a), far = std::max(c / q, q / a);
  t = near > 0.0f ? near : far;
  return t > 0.0f;
}

}  // namespace

namespace {

// What one tree holds: all primitives of the world, or all of an object.
struct Group {
  std::vector<uint32_t> triangles, spheres;
};

Group WorldGroup(const Scene& scene) {
  Group group;
  const auto claimed = [&](uint32_t i, auto first, auto count) {
    return std::any_of(scene.objects.begin(), scene.objects.end(),
                       [&](const Object& o) { return i >= o.*first && i < o.*first + o.*count; });
  };
  for (uint32_t i = 0; i < scene.triangle_count(); ++i) {
    if (!claimed(i, &Object::first_triangle, &Object::triangle_count)) group.triangles.push_back(i);
  }
  for (uint32_t i = 0; i < scene.spheres.size(); ++i) {
    if (!claimed(i, &Object::first_sphere, &Object::sphere_count)) group.spheres.push_back(i);
  }
  return group;
}

Group ObjectGroup(const Object& object) {
  Group group;
  for (uint32_t i = 0; i < object.triangle_count; ++i)
    group.triangles.push_back(object.first_triangle + i);
  for (uint32_t i = 0; i < object.sphere_count; ++i)
    group.spheres.push_back(object.first_sphere + i);
  return group;
}

void Grow(Box& box, const Box& by) {
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = std::min(box.lower[k], by.lower[k]);
    box.upper[k] = std::max(box.upper[k], by.upper[k]);
  }
}

Box GroupBox(const Scene& scene, const Group& group) {
  Box box = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (uint32_t i : group.triangles) Grow(box, TriangleBox(scene, i));
  for (uint32_t i : group.spheres) Grow(box, SphereBox(scene.spheres[i]));
  return box;
}

Box InstanceBox(const InstanceRecord& instance, const Box& object) {
  Float3 middle, half;
  for (int k = 0; k < 3; ++k) {
    middle[k] = 0.5f * object.lower[k] + 0.5f * object.upper[k];
    half[k] = std::nextafter(std::max(object.upper[k] - middle[k], middle[k] - object.lower[k]),
                             kInfinity);
  }
  Float3 at, extent;
  float reach = 0.0f;
  for (int k = 0; k < 3; ++k) {
    const float* m = &instance.to_world[3 * k];
    const Float3 terms = {m[0] * middle[0], m[1] * middle[1], m[2] * middle[2]};
    const float c = instance.centre[k];
    at[k] = terms[0] + terms[1] + terms[2] + c;
    extent[k] = std::fabs(m[0]) * half[0] + std::fabs(m[1]) * half[1] + std::fabs(m[2]) * half[2];
    const float far = (std::fabs(terms[0]) + std::fabs(terms[1])) +
                      (std::fabs(terms[2]) + std::fabs(c)) + extent[k];
    reach = std::max(reach, far);
  }
  Box box;
  for (int k = 0; k < 3; ++k) {
    const float most = extent[k] + reach * kBoxMargin;
    box.lower[k] = at[k] - most;
    box.upper[k] = at[k] + most;
  }
  return box;
}

Ray ToObject(const InstanceRecord& instance, const Ray& ray) {
  Ray result;
  Float3 from;
  for (int k = 0; k < 3; ++k) from[k] = ray.org[k] - instance.centre[k];
  for (int k = 0; k < 3; ++k) {
    const float* m = &instance.to_object[3 * k];
    result.org[k] = Dot({m[0], m[1], m[2]}, from);
    result.dir[k] = Dot({m[0], m[1], m[2]}, ray.dir);
  }
  return result;
}

bool IsFinite(const Ray& ray) {
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(ray.org[k]) || !std::isfinite(ray.dir[k])) return false;
  }
  return true;
}

// Less in (t, instance, primitive).
bool Less(const HitFields<Row>& a, const HitFields<Row>& b) {
  return std::tie(a.t, a.instance, a.prim) < std::tie(b.t, b.instance, b.prim);
}

// Hits of a group no nearer than `enter`.
void Offer(const Scene& scene, const Group& group, const Ray& ray, float reach, float enter,
           uint32_t instance, HitFields<Row>& best) {
  const uint32_t first_sphere = static_cast<uint32_t>(scene.triangle_count());
  for (uint32_t i : group.triangles) {
    HitFields<Row> hit;
    if (!HitTriangle(scene, i, ray, hit)) continue;
    if (!ClampToBox(ray, TriangleBox(scene, i), reach, hit.t)) continue;
    hit.t = std::max(hit.t, enter);
    hit.instance = instance;
    if (Less(hit, best)) best = hit;
  }
  for (uint32_t i : group.spheres) {
    float t;
    if (!HitSphere(scene.spheres[i], ray, t)) continue;
    if (!ClampToBox(ray, SphereBox(scene.spheres[i]), reach, t)) continue;
    const HitFields<Row> hit = {std::max(t, enter), first_sphere + i, 0.0f, 0.0f, instance};
    if (Less(hit, best)) best = hit;
  }
}

}  // namespace

HitFields<Row> ClosestHit(const Scene& scene, const Ray& ray) {
  const Group world = WorldGroup(scene);
  std::vector<Box> boxes;
  Box all = GroupBox(scene, world), objects = {{0, 0, 0}, {0, 0, 0}};
  for (const InstanceRecord& instance : scene.instances) {
    const Box object = GroupBox(scene, ObjectGroup(scene.objects[instance.object]));
    boxes.push_back(InstanceBox(instance, object));
    Grow(objects, object);
    Grow(all, boxes.back());
  }
  float reach = std::max(MaxAbs(objects.lower), MaxAbs(objects.upper));
  if (all.lower[0] <= all.upper[0]) {
    reach = std::max({reach, MaxAbs(all.lower), MaxAbs(all.upper)});
  }

  HitFields<Row> best = {kInfinity, kNoPrim, 0.0f, 0.0f, kNone};
  Offer(scene, world, ray, reach, 0.0f, kNone, best);
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    float enter = 0.0f;
    if (!ClampToBox(ray, boxes[i], reach, enter)) continue;
    const Ray inside = ToObject(scene.instances[i], ray);
    if (!IsFinite(inside)) continue;
    Offer(scene, ObjectGroup(scene.objects[scene.instances[i].object]), inside, reach, enter, i,
          best);
  }
  return best;
}

namespace {

using Double3 = std::array<double, 3>;

Double3 Sub(const Double3& a, const Double3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Double3 Cross(const Double3& a, const Double3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double Dot(const Double3& a, const Double3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// What counts as close to an edge, a silhouette or another hit: far above float rounding, far below
// what the tests' rays hit by chance.
constexpr double kUncertain = 1e-4;

// Hits of a group, in its own space.
void OfferExact(const Scene& scene, const Group& group, const Double3& org, const Double3& dir,
                uint32_t instance, ExactHit& best) {
  const auto offer = [&](double t, uint32_t prim, double inside) {
    if (inside < -kUncertain || t <= -kUncertain) return;
    if (inside < kUncertain || t < kUncertain || std::fabs(t - best.t) < kUncertain * t) {
      best.certain = false;
    }
    if (inside >= 0 && t > 0 && t < best.t) best = {t, prim, instance, best.certain};
  };
  const uint32_t triangles = static_cast<uint32_t>(scene.triangle_count());
  for (uint32_t i : group.triangles) {
    Double3 p[3];
    for (int k = 0; k < 3; ++k) {
      const float* v = Vertex(scene, i, k);
      p[k] = {v[0], v[1], v[2]};
    }
    const Double3 e1 = Sub(p[1], p[0]), e2 = Sub(p[2], p[0]), s = Sub(org, p[0]);
    const Double3 n = Cross(dir, e2), m = Cross(s, e1);
    const double det = Dot(e1, n);
    if (det == 0) continue;
    const double u = Dot(s, n) / det, v = Dot(dir, m) / det;
    offer(Dot(e2, m) / det, i, std::min({u, v, 1 - u - v}));
  }
  for (uint32_t i : group.spheres) {
    const float* m = scene.spheres[i].world_to_object;
    const float* w = scene.spheres[i].object_to_world;
    const Double3 from_centre = Sub(org, {w[3], w[7], w[11]});
    Double3 o, d;
    for (int k = 0; k < 3; ++k) {
      const Double3 row = {m[4 * k], m[4 * k + 1], m[4 * k + 2]};
      o[k] = Dot(row, from_centre);
      d[k] = Dot(row, dir);
    }
    const double a = Dot(d, d), b = -Dot(o, d) / a;
    const Double3 closest = {o[0] + b * d[0], o[1] + b * d[1], o[2] + b * d[2]};
    const double inside = 1 - Dot(closest, closest);
    const double half = std::sqrt(std::max(inside, 0.0) / a);
    offer(b - half, triangles + i, inside);
    offer(b + half, triangles + i, inside);
  }
}

}  // namespace

ExactHit ExactClosestHit(const Scene& scene, const Ray& ray) {
  ExactHit best = {kInfinity, kNoPrim, kNone, true};
  const Double3 org = {ray.org[0], ray.org[1], ray.org[2]};
  const Double3 dir = {ray.dir[0], ray.dir[1], ray.dir[2]};
  OfferExact(scene, WorldGroup(scene), org, dir, kNone, best);
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    const InstanceRecord& instance = scene.instances[i];
    const Double3 from = Sub(org, {instance.centre[0], instance.centre[1], instance.centre[2]});
    Double3 o, d;
    for (int k = 0; k < 3; ++k) {
      const float* m = &instance.to_object[3 * k];
      o[k] = Dot({m[0], m[1], m[2]}, from);
      d[k] = Dot({m[0], m[1], m[2]}, dir);
    }
    OfferExact(scene, ObjectGroup(scene.objects[instance.object]), o, d, i, best);
  }
  return best;
}

}  // namespace swell::reference
