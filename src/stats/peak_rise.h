// A function in, how much more memory was resident while it ran out.
#ifndef SWELL_STATS_PEAK_RISE_H_
#define SWELL_STATS_PEAK_RISE_H_

#include <cstdint>
#include <functional>
#include <optional>

namespace swell {

// Bytes of the most that was resident while `run` ran, above what was before. What freed memory the
// C library holds is given back first. Null where the system does not tell, or the high-water mark
// of an earlier peak stays.
std::optional<int64_t> PeakRise(const std::function<void()>& run);

}  // namespace swell

#endif  // SWELL_STATS_PEAK_RISE_H_
