// The scenes that benchmarks run on, made in memory, and what a render of them needs.
#ifndef SWELL_BENCH_SCENES_H_
#define SWELL_BENCH_SCENES_H_

#include <memory>
#include <string>
#include <utility>

#include "src/base/result.h"
#include "src/bvh/bvh.h"
#include "src/scene/scene.h"

namespace swell::bench {

// The Cornell box with its published measurements: 36 triangles, diffuse, one area light.
Scene CornellScene();
// A room of 25 spheres of 20,480 triangles each: two diffuse, a mirror, a fuzzy mirror, glass,
// copper and gold; one area light.
Scene SphereRoomScene();
// A height field of a million triangles under a constant sky.
Scene BigMeshScene();
// A closed room of 25,000 thin boxes that lean and overlap, and slivers: 300,000 triangles in all,
// diffuse; one area light.
Scene PillarRoomScene();
// The same with few pillars and slivers, for tests.
Scene SmallPillarRoomScene();
// A sphere over a rough valley, diffuse, one area light; of 1.0 and of 4.0 million triangles.
Scene SphereOverValleyScene(bool large);

// A hall of 300 pillars and a few spheres under 1,000 small triangles of different radiance.
Scene ManyLightsScene();

// The mesh of a PLY file, diffuse, on a floor in a closed room ten times its size; one area light.
Result<Scene> ScanScene(const std::string& ply_file);

// A scene with all that is derived from it. Not to be moved: its parts point at each other.
struct BuiltScene {
  explicit BuiltScene(Scene&& source) : scene(std::move(source)), tables(FinishScene(scene)) {}
  BuiltScene(const BuiltScene&) = delete;

  Scene scene;
  SceneTables tables;
  Bvh bvh;
};

// "cornell", "pillars", "small-pillars", "valley-1m", "valley-4m", "room", "bigmesh",
// "lights-1000", or the path of a scene file or of a PLY file.
Result<Scene> MakeScene(const std::string& name);
// kAuto: as the scene asks.
Result<std::unique_ptr<BuiltScene>> BuildScene(const std::string& name,
                                               LightSampler sampler = LightSampler::kAuto);

}  // namespace swell::bench

#endif  // SWELL_BENCH_SCENES_H_
