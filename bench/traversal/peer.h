// What another ray tracer is to the comparison: scenes built, rays and hits in swell's columns.
//
// A peer is a module of its own, because two versions of one library share the names of their
// functions and cannot be linked into one program.
#ifndef SWELL_BENCH_TRAVERSAL_PEER_H_
#define SWELL_BENCH_TRAVERSAL_PEER_H_

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kernels/records.h"
#include "src/scene/scene.h"

namespace swell::bench {

struct PeerSceneOptions {
  bool high_quality = false;  // else medium, its default
  bool robust = false;
  uint32_t build_threads = 1;
};

struct PeerBytes {
  int64_t after = 0;  // what the tree takes
  int64_t peak = 0;   // while it was built
};

// Columns hold kRowPadding readable rows more than `count`; those of hits are scratch.
class PeerScene {
 public:
  virtual ~PeerScene() = default;
  virtual void Build() = 0;  // once; everything else comes after it
  virtual PeerBytes bytes() const = 0;

  // `way` is an index of Peer::ways(). A miss has prim == kNoPrim and t = infinity.
  virtual void Intersect(size_t way, const Vec3Fields<In>& org, const Vec3Fields<In>& dir,
                         const HitsOut& hits, size_t count) const = 0;
  // As OccludeRays.
  virtual void Occlude(size_t way, const ShadowRaysIn& rays, const RgbFields<Out>& radiance,
                       size_t count) const = 0;
};

class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;  // with its version
  // The functions rays can go through; the first takes single rays.
  virtual const std::vector<std::string>& ways() const = 0;
  // Takes a copy of the scene's triangles.
  virtual std::unique_ptr<PeerScene> Attach(const Scene& scene,
                                            const PeerSceneOptions& options) const = 0;
};

// The one name a module exports.
using MakePeerFunction = Peer*();
inline constexpr const char* kMakePeerName = "SwellMakePeer";

// The peers this program was built with, in the order of their versions.
std::vector<std::unique_ptr<Peer>> LoadPeers();

}  // namespace swell::bench

#endif  // SWELL_BENCH_TRAVERSAL_PEER_H_
