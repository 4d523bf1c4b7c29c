// Keeps the live rows of any record.
#ifndef SWELL_KERNELS_COMPACT_COLUMNS_H_
#define SWELL_KERNELS_COMPACT_COLUMNS_H_

#include "kernels/kernel.h"
#include "kernels/records.h"

namespace swell {

struct CompactArgs {
  const uint32_t* const* from;  // `columns` columns of `count` rows
  uint32_t* const* to;          // likewise; none of them is one of `from`
  size_t columns;
  size_t count;
  const uint32_t* flags;  // a row is dropped if flags & drop
  uint32_t drop;
  const uint32_t* ids;  // of the dropped rows are written to dropped_ids
  uint32_t* dropped_ids;
};

// Copies the rows that stay to rows [0, n) in their order and returns n; the ids of the others go
// to dropped_ids [0, count - n) in their order.
SWELL_KERNEL(size_t, CompactColumns, const CompactArgs& args);

}  // namespace swell

#endif  // SWELL_KERNELS_COMPACT_COLUMNS_H_
