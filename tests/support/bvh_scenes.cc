// Geometry and rays for the tests of building and traversal, and the calls that trace them.
#include "tests/support/bvh_scenes.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <sstream>

#include "src/scene/objects.h"

namespace swell::test {

void AddTriangle(Scene& scene, const Float3& a, const Float3& b, const Float3& c) {
  for (const Float3& p : {a, b, c}) {
    scene.indices.push_back(static_cast<uint32_t>(scene.positions.size() / 3));
    scene.positions.insert(scene.positions.end(), p.begin(), p.end());
  }
}

void AddEllipsoid(Scene& scene, const Affine& m) {
  const double det = double{m[0]} * (double{m[5]} * m[10] - double{m[6]} * m[9]) -
                     double{m[1]} * (double{m[4]} * m[10] - double{m[6]} * m[8]) +
                     double{m[2]} * (double{m[4]} * m[9] - double{m[5]} * m[8]);
  SphereRecord sphere;
  std::copy(m.begin(), m.end(), sphere.object_to_world);
  for (int r = 0; r < 3; ++r) {
    double offset = 0.0;
    for (int c = 0; c < 3; ++c) {
      const int r1 = (c + 1) % 3, r2 = (c + 2) % 3, c1 = (r + 1) % 3, c2 = (r + 2) % 3;
      const double cofactor =
          double{m[4 * r1 + c1]} * m[4 * r2 + c2] - double{m[4 * r1 + c2]} * m[4 * r2 + c1];
      sphere.world_to_object[4 * r + c] = static_cast<float>(cofactor / det);
      offset -= cofactor / det * m[4 * c + 3];
    }
    sphere.world_to_object[4 * r + 3] = static_cast<float>(offset);
  }
  scene.spheres.push_back(sphere);
}

void AddSphere(Scene& scene, const Float3& centre, float radius) {
  AddEllipsoid(scene, {radius, 0, 0, centre[0], 0, radius, 0, centre[1], 0, 0, radius, centre[2]});
}

Scene ClosedMesh(uint32_t levels, float size, const Float3& centre, uint32_t seed) {
  std::vector<Float3> points = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  std::vector<uint32_t> indices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                   2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  for (uint32_t level = 0; level < levels; ++level) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [at, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)},
                                                    static_cast<uint32_t>(points.size()));
      if (is_new) {
        Float3 p;
        for (int k = 0; k < 3; ++k) p[k] = points[a][k] + points[b][k];
        const float length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        for (float& x : p) x /= length;
        points.push_back(p);
      }
      return at->second;
    };
    std::vector<uint32_t> finer;
    for (size_t i = 0; i < indices.size(); i += 3) {
      const uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    indices = finer;
  }
  Random random(seed);
  Scene scene;
  scene.indices = indices;
  for (const Float3& p : points) {
    const float scale = size * random.Uniform(0.8f, 1.0f);
    for (int k = 0; k < 3; ++k) scene.positions.push_back(scale * p[k] + centre[k]);
  }
  return scene;
}

Scene TriangleSoup(uint32_t count, float low, float high, float size, uint32_t seed) {
  Random random(seed);
  Scene scene;
  for (uint32_t i = 0; i < count; ++i) {
    const Float3 at = random.Point(low, high);
    Float3 p[3];
    for (Float3& vertex : p) {
      const Float3 offset = random.Point(-size, size);
      for (int k = 0; k < 3; ++k) vertex[k] = at[k] + offset[k];
    }
    AddTriangle(scene, p[0], p[1], p[2]);
  }
  return scene;
}

namespace {

Scene Slivers(uint32_t count, uint32_t seed) {
  Random random(seed);
  Scene scene;
  for (uint32_t i = 0; i < count; ++i) {
    const Float3 a = random.Point(-1, 1), b = random.Point(-1, 1);
    const Float3 shift = random.Point(-1e-4f, 1e-4f);
    AddTriangle(scene, a, b, {b[0] + shift[0], b[1] + shift[1], b[2] + shift[2]});
  }
  return scene;
}

// A lattice of axis-parallel squares, so that planes, edges and boxes coincide.
Scene Lattice(int cells) {
  Scene scene;
  for (int axis = 0; axis < 3; ++axis) {
    for (int plane = 0; plane <= cells; ++plane) {
      for (int i = 0; i < cells * cells; ++i) {
        const auto point = [&](int x, int y) {
          Float3 p;
          p[axis] = static_cast<float>(plane);
          p[(axis + 1) % 3] = static_cast<float>(x);
          p[(axis + 2) % 3] = static_cast<float>(y);
          return p;
        };
        const int x = i % cells, y = i / cells;
        AddTriangle(scene, point(x, y), point(x + 1, y), point(x + 1, y + 1));
        AddTriangle(scene, point(x, y), point(x + 1, y + 1), point(x, y + 1));
      }
    }
  }
  return scene;
}

Scene Duplicates() {
  const Scene once = TriangleSoup(20, -1, 1, 1, 11);
  Scene scene = once;
  for (int copy = 1; copy < 7; ++copy) {
    scene.indices.insert(scene.indices.end(), once.indices.begin(), once.indices.end());
  }
  return scene;
}

Scene Spheres(uint32_t count, uint32_t seed) {
  Random random(seed);
  Scene scene;
  for (uint32_t i = 0; i < count; ++i) {
    if (i % 3 != 0) {
      AddSphere(scene, random.Point(-1, 1), random.Uniform(0.02f, 0.3f));
      continue;
    }
    Affine m;
    for (float& x : m) x = random.Uniform(-0.2f, 0.2f);
    for (int k = 0; k < 3; ++k) m[4 * k + 3] = random.Uniform(-1, 1);
    for (int k = 0; k < 3; ++k) m[4 * k + k] += 0.3f;
    AddEllipsoid(scene, m);
  }
  return scene;
}

Scene Mixture() {
  Scene scene = TriangleSoup(300, -1, 1, 0.2f, 12);
  scene.spheres = Spheres(40, 13).spheres;
  return scene;
}

Scene AllScales() {
  Scene scene;
  for (int exponent = -6; exponent <= 6; ++exponent) {
    const float size = std::pow(10.0f, static_cast<float>(exponent));
    const Scene part = ClosedMesh(1, size, {0, 0, 0}, 20);
    const uint32_t first = static_cast<uint32_t>(scene.positions.size() / 3);
    scene.positions.insert(scene.positions.end(), part.positions.begin(), part.positions.end());
    for (const uint32_t i : part.indices) scene.indices.push_back(first + i);
  }
  AddSphere(scene, {0.01f, 0, 0}, 1e-3f);
  AddSphere(scene, {0, -1e6f, 0}, 1e6f);
  return scene;
}

Affine RandomMap(Random& random, float at, float stretch) {
  Affine m;
  for (float& x : m) x = random.Uniform(-1, 1);
  for (int k = 0; k < 3; ++k) {
    m[4 * k + 3] = random.Uniform(-at, at);
    m[5 * k] += random.Bits() % 4 == 0 ? -2.0f : 2.0f;  // some of them mirror
  }
  for (int k = 0; k < 3; ++k) {
    m[4 * k] *= stretch;  // one axis
    for (int c = 0; c < 3; ++c) m[4 * k + c] *= 0.2f;
  }
  return m;
}

// Three objects, of triangles, of spheres and of both, placed at random between own primitives of
// the world, and one object that is not used.
Scene Instances(uint32_t count, float at, float stretch, uint32_t seed) {
  Scene scene = TriangleSoup(20, -1, 1, 0.2f, seed);
  const auto add = [&](const Scene& part, uint32_t triangles, uint32_t spheres) {
    AddObject(scene, part, triangles, spheres);
  };
  add(TriangleSoup(60, -0.5f, 0.5f, 0.3f, seed + 1), 60, 0);
  add(ClosedMesh(1, 0.7f, {0.3f, 0, 0}, seed + 2), 32, 0);
  add(Spheres(7, seed + 3), 0, 7);
  Scene both = TriangleSoup(3, -0.5f, 0.5f, 0.5f, seed + 4);
  both.spheres = Spheres(3, seed + 5).spheres;
  add(both, 3, 3);
  scene.spheres.push_back(Spheres(1, seed + 6).spheres[0]);
  Random random(seed + 7);
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t object = random.Bits() % 3;
    AddInstance(scene, RandomMap(random, at, stretch), object == 1 ? 3 : object);
  }
  return scene;
}

// Instances that coincide with each other and with the world's own triangles.
Scene CoincidentInstances() {
  const Scene once = TriangleSoup(20, -1, 1, 1, 31);
  Scene scene = once;
  AddObject(scene, once, 20, 0);
  const Affine same = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  for (int i = 0; i < 5; ++i) AddInstance(scene, same, 0);
  return scene;
}

}  // namespace

void AddObject(Scene& scene, const Scene& part, uint32_t triangles, uint32_t spheres) {
  Object object;
  object.first_triangle = static_cast<uint32_t>(scene.triangle_count());
  object.triangle_count = triangles;
  object.first_sphere = static_cast<uint32_t>(scene.spheres.size());
  object.sphere_count = spheres;
  const auto first = static_cast<uint32_t>(scene.positions.size() / 3);
  scene.positions.insert(scene.positions.end(), part.positions.begin(), part.positions.end());
  for (size_t i = 0; i < 3 * size_t{triangles}; ++i)
    scene.indices.push_back(first + part.indices[i]);
  scene.spheres.insert(scene.spheres.end(), part.spheres.begin(), part.spheres.begin() + spheres);
  scene.objects.push_back(object);
}

void AddInstance(Scene& scene, const Affine& object_to_world, uint32_t object) {
  std::array<double, 12> map;
  std::copy(object_to_world.begin(), object_to_world.end(), map.begin());
  const auto instance = PlaceObject(map, object);
  if (instance) scene.instances.push_back(*instance);
}

std::vector<NamedScene> AllScenes() {
  std::vector<NamedScene> scenes;
  scenes.push_back({"nothing", Scene(), -1, 1});
  scenes.push_back({"one triangle", TriangleSoup(1, -0.1f, 0.1f, 1, 1), -1, 1});
  scenes.push_back({"eight triangles", TriangleSoup(8, -0.5f, 0.5f, 1, 2), -1, 1});
  scenes.push_back({"forty large triangles", TriangleSoup(40, -1, 1, 1, 3), -1, 1});
  scenes.push_back({"soup", TriangleSoup(2000, -1, 1, 0.1f, 4), -1, 1});
  scenes.push_back({"slivers", Slivers(500, 5), -1, 1});
  scenes.push_back({"closed mesh", ClosedMesh(4, 1, {0, 0, 0}, 6), -1.2f, 1.2f});
  scenes.push_back({"closed mesh far away", ClosedMesh(3, 1, {4096, -512, 100}, 7), -1, 4096});
  scenes.push_back({"huge", TriangleSoup(300, -1e12f, 1e12f, 1e11f, 8), -1e12f, 1e12f});
  scenes.push_back({"tiny", TriangleSoup(300, -1e-12f, 1e-12f, 1e-13f, 9), -1e-12f, 1e-12f});
  scenes.push_back({"all scales", AllScales(), -1, 1});
  scenes.push_back({"lattice", Lattice(4), 0, 4});
  scenes.push_back({"duplicates", Duplicates(), -1, 1});
  scenes.push_back({"one sphere", Spheres(1, 10), -1, 1});
  scenes.push_back({"spheres", Spheres(60, 10), -1, 1});
  scenes.push_back({"mixture", Mixture(), -1, 1});
  scenes.push_back({"an instance", Instances(1, 0, 1, 40), -1, 1});
  scenes.push_back({"instances", Instances(60, 1, 1, 41), -1, 1});
  scenes.push_back({"flat instances", Instances(60, 1, 1e-3f, 42), -1, 1});
  scenes.push_back({"instances far away", Instances(60, 4096, 1, 43), -4096, 4096});
  scenes.push_back({"coincident instances", CoincidentInstances(), -1, 1});
  return scenes;
}

std::vector<Ray> RaysFor(const NamedScene& named, size_t count, uint32_t seed) {
  Random random(seed);
  const Scene& scene = named.scene;
  const size_t vertices = scene.positions.size() / 3;
  const auto point = [&] { return random.Point(named.low, named.high); };
  const auto vertex = [&]() -> Float3 {
    if (vertices == 0) return point();
    const float* p = &scene.positions[3 * (random.Bits() % vertices)];
    return {p[0], p[1], p[2]};
  };
  const auto to = [](const Float3& from, const Float3& at) -> Ray {
    return {from, {at[0] - from[0], at[1] - from[1], at[2] - from[2]}};
  };
  std::vector<Ray> rays;
  while (rays.size() < count) {
    Ray ray = to(point(), point());
    switch (random.Bits() % 10) {
      case 0:
        ray.dir[random.Bits() % 3] = 0.0f;
        break;
      case 1: {
        const float along = ray.dir[0];
        ray.dir = {0.0f, -0.0f, 0.0f};
        ray.dir[random.Bits() % 3] = along;
        break;
      }
      case 2:
        ray = to(point(), vertex());
        break;
      case 3:
        ray = to(vertex(), point());
        break;
      case 4:
        ray = to(vertex(), vertex());
        break;
      case 5: {  // from a vertex along an axis: on faces of boxes
        ray = {vertex(), {0, 0, 0}};
        ray.dir[random.Bits() % 3] = random.Bits() % 2 == 0 ? 1.0f : -1.0f;
        break;
      }
      case 6:
        ray = to(point(), point()), ray.dir[random.Bits() % 3] *= 1e-30f;
        break;
      case 7: {
        if (random.Bits() % 8 != 0) break;
        const float bad[] = {NAN, INFINITY, -INFINITY};
        (random.Bits() % 2 == 0 ? ray.org : ray.dir)[random.Bits() % 3] = bad[random.Bits() % 3];
        break;
      }
      default:
        break;
    }
    rays.push_back(ray);
  }
  return rays;
}

RayTable::RayTable(const std::vector<Ray>& rays) : count(rays.size()) {
  for (size_t k = 0; k < 6; ++k) {
    // Scratch rows that would hit: a kernel that counts them is caught.
    columns[k].assign(RoundUpToPadding(count) + kRowPadding, k < 3 ? 0.0f : 1.0f);
    for (size_t i = 0; i < count; ++i) columns[k][i] = k < 3 ? rays[i].org[k] : rays[i].dir[k - 3];
  }
}

std::vector<HitFields<Row>> Intersect(const Bvh& bvh, Width width, Traversal traversal,
                                      const RayTable& rays) {
  const size_t padded = RoundUpToPadding(rays.count) + kRowPadding;
  std::vector<float> t(padded, -7.0f), u(padded), v(padded);
  std::vector<uint32_t> prim(padded), instance(padded);
  const HitsOut hits = {t.data(), prim.data(), u.data(), v.data(), instance.data()};
  IntersectRays(width, bvh.view(), traversal, rays.org(), rays.dir(), hits, rays.count);
  std::vector<HitFields<Row>> result;
  for (size_t i = 0; i < rays.count; ++i) {
    result.push_back({t[i], prim[i], u[i], v[i], instance[i]});
  }
  return result;
}

std::vector<bool> Occluded(const Bvh& bvh, Width width, Traversal traversal, const RayTable& rays,
                           const std::vector<float>& t_max, LaneUse* use) {
  const size_t padded = RoundUpToPadding(rays.count) + kRowPadding;
  std::vector<float> limit(padded, 1e30f), light(padded, 2.0f);
  std::vector<float> red(padded, 1.0f), green(padded, 1.0f), blue(padded, 1.0f);
  std::vector<uint32_t> path(padded, 0);
  std::copy(t_max.begin(), t_max.end(), limit.begin());
  for (size_t i = 0; i < rays.count; ++i) path[i] = static_cast<uint32_t>(rays.count - 1 - i);
  const ShadowRaysIn shadow = {rays.org(),
                               rays.dir(),
                               limit.data(),
                               {light.data(), light.data(), light.data()},
                               path.data()};
  const LaneUse used = OccludeRays(width, bvh.view(), traversal, shadow,
                                   {red.data(), green.data(), blue.data()}, rays.count);
  if (use != nullptr) *use = used;
  std::vector<bool> result;
  for (size_t i = 0; i < rays.count; ++i) {
    const float got = red[path[i]];
    // Anything but "gained nothing" and "gained the light" in all channels is reported as a flag
    // that no expectation can match.
    if (got != green[path[i]] || got != blue[path[i]] || (got != 1.0f && got != 3.0f)) return {};
    result.push_back(got == 1.0f);
  }
  return result;
}

std::string NameRun(const char* target, Width width, Traversal traversal) {
  const char* kNames[] = {"auto", "packet", "single"};
  return std::string(target) + (width == Width::kWide ? " wide " : " one lane ") +
         kNames[static_cast<int>(traversal)];
}

bool SameHit(const HitFields<Row>& a, const HitFields<Row>& b) {
  return std::memcmp(&a, &b, sizeof(a)) == 0;
}

std::string Describe(const HitFields<Row>& hit) {
  std::ostringstream out;
  out << std::hexfloat << "t " << hit.t << " prim " << hit.prim << " u " << hit.u << " v " << hit.v
      << " instance " << hit.instance;
  return out.str();
}

}  // namespace swell::test
