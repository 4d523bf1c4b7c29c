// Measured figures as text: a table for the README, where swell's time went, and JSON.
#ifndef SWELL_BENCH_PEER_TABLES_H_
#define SWELL_BENCH_PEER_TABLES_H_

#include <string>
#include <vector>

#include "bench/peer/measure.h"

namespace swell::bench {

// Scene, engine, rate and ratio to the peer; a ratio is the median over the repetitions' ratios.
std::string MarkdownTable(const std::vector<SceneFigures>& scenes);

// Scene, engine, mean squared error times seconds and the peer's over it; "" without errors.
std::string ErrorTable(const std::vector<SceneFigures>& scenes);

// Agreement with the peer, shares of swell's stages, lane use of its shading.
std::string Details(const SceneFigures& scene);

std::string ToJson(const std::vector<SceneFigures>& scenes);

}  // namespace swell::bench

#endif  // SWELL_BENCH_PEER_TABLES_H_
