// Tables of samplers, computed while compiling: primes, and the orders of four digits.
#ifndef SWELL_KERNELS_SAMPLERS_TABLES_H_
#define SWELL_KERNELS_SAMPLERS_TABLES_H_

#include <cstdint>

namespace swell {

inline constexpr uint32_t kPrimeCount = 256;
struct PrimeTable {
  uint32_t prime[kPrimeCount];
};
constexpr PrimeTable MakePrimeTable() {
  PrimeTable table{};
  uint32_t count = 0;
  for (uint32_t candidate = 2; count < kPrimeCount; ++candidate) {
    bool is_prime = true;
    for (uint32_t i = 0; i < count && table.prime[i] * table.prime[i] <= candidate; ++i) {
      if (candidate % table.prime[i] == 0) is_prime = false;
    }
    if (is_prime) table.prime[count++] = candidate;
  }
  return table;
}
inline constexpr PrimeTable kPrimeTable = MakePrimeTable();

// Bits 2 d and 2 d + 1 of an order say where digit d goes.
inline constexpr uint32_t kDigitOrders = 24;
struct DigitOrderTable {
  uint32_t order[kDigitOrders];
};
constexpr DigitOrderTable MakeDigitOrderTable() {
  DigitOrderTable table{};
  uint32_t count = 0;
  for (uint32_t order = 0; order < 256; ++order) {
    uint32_t seen = 0;
    for (uint32_t d = 0; d < 4; ++d) seen |= 1u << (order >> (2 * d) & 3u);
    if (seen == 15u) table.order[count++] = order;
  }
  return table;
}
inline constexpr DigitOrderTable kDigitOrderTable = MakeDigitOrderTable();

}  // namespace swell

#endif  // SWELL_KERNELS_SAMPLERS_TABLES_H_
