// The paths of modules that the build wrote down in, the peers they make out.
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>

#include "bench/traversal/peer.h"

namespace swell::bench {
namespace {

constexpr const char* kModules[] = {
#ifdef SWELL_PEER_EMBREE3
    SWELL_PEER_EMBREE3,
#endif
#ifdef SWELL_PEER_EMBREE4
    SWELL_PEER_EMBREE4,
#endif
};

}  // namespace

std::vector<std::unique_ptr<Peer>> LoadPeers() {
  std::vector<std::unique_ptr<Peer>> peers;
  for (const char* path : kModules) {
    // Kept for good. Local, so that the versions do not see each other's functions.
    void* module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    void* make = module == nullptr ? nullptr : dlsym(module, kMakePeerName);
    if (make == nullptr) {
      std::fprintf(stderr, "swell_bench_traversal: %s\n", dlerror());
      std::exit(1);
    }
    peers.emplace_back(reinterpret_cast<MakePeerFunction*>(make)());
  }
  return peers;
}

}  // namespace swell::bench
