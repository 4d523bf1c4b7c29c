// Puts a Scene together in memory: materials by name, meshes, a camera.
#ifndef SWELL_BENCH_SCENE_BUILDER_H_
#define SWELL_BENCH_SCENE_BUILDER_H_

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "src/scene/scene.h"

namespace swell::bench {

using Point = std::array<float, 3>;

// A material's parameter by the name that scene files use; the rest keep their defaults.
struct Parameter {
  std::string name;
  std::vector<float> values;
};

struct Mesh {
  std::vector<Point> positions;
  std::vector<Point> normals;  // unit; none, or one for each position
  std::vector<uint32_t> indices;
};

class SceneBuilder {
 public:
  // Returns the material's index. Unknown names are bugs.
  uint32_t AddMaterial(const std::string& kind, const std::vector<Parameter>& parameters);

  // The parameter's value for a name such as "Cu".
  static std::vector<float> Named(const std::string& kind, const std::string& parameter,
                                  const std::string& name);

  void AddMesh(const Mesh& mesh, uint32_t material, const Point& radiance = {0, 0, 0});
  // Quads of four corners each, as two triangles.
  void AddQuads(const std::vector<Point>& corners, uint32_t material,
                const Point& radiance = {0, 0, 0});
  void AddInfiniteLight(const Point& radiance);
  void LookAt(const Point& eye, const Point& target, const Point& up, float fov_degrees);

  // A square frame with a box filter, as the published rates of other renderers have.
  Scene Finish(uint32_t resolution, uint32_t max_depth);

 private:
  Scene scene_;
};

// The unit sphere as an icosahedron divided `levels` times: 20 * 4^levels triangles, with normals.
Mesh MakeIcosphere(uint32_t levels);
Mesh Placed(const Mesh& mesh, const Point& centre, float scale);

}  // namespace swell::bench

#endif  // SWELL_BENCH_SCENE_BUILDER_H_
