// The shapes a record's fields can take: one value, a column that is read, a column that is
// written.
#ifndef SWELL_KERNELS_COLUMNS_H_
#define SWELL_KERNELS_COLUMNS_H_

#include <cstddef>
#include <cstdint>

namespace swell {

// Rows that every column is padded to and every kernel may write beyond `count`: the widest float
// vector of any target.
inline constexpr size_t kRowPadding = 16;

#if defined(__GNUC__) || defined(__clang__)
#define SWELL_RESTRICT __restrict__
#else
#define SWELL_RESTRICT
#endif

template <class T> using Row = T;                       // one record, by value
template <class T> using In = const T* SWELL_RESTRICT;  // columns a kernel reads
template <class T> using Out = T* SWELL_RESTRICT;       // columns a kernel writes

inline constexpr size_t RoundUpToPadding(size_t rows) {
  return (rows + kRowPadding - 1) / kRowPadding * kRowPadding;
}

}  // namespace swell

#endif  // SWELL_KERNELS_COLUMNS_H_
