// Owns the columns of a record.
#ifndef SWELL_WAVE_TABLE_H_
#define SWELL_WAVE_TABLE_H_

#include <hwy/aligned_allocator.h>

#include <array>
#include <bit>
#include <cstring>

#include "kernels/columns.h"

namespace swell {

// `capacity` rows of a record and the padding, one aligned column per field.
template <template <template <class> class> class Fields> class Table {
 public:
  static constexpr size_t kColumns = sizeof(Fields<Out>) / sizeof(void*);
  static_assert(sizeof(Fields<Row>) == kColumns * sizeof(uint32_t), "every field is 32 bits wide");

  explicit Table(size_t capacity)
      : capacity_(RoundUpToPadding(capacity)),
        stride_(capacity_ +
                kRowPadding),  // room for a last vector; spreads columns over cache sets
        cells_(hwy::AllocateAligned<uint32_t>(stride_ * kColumns)) {
    if (cells_) std::memset(cells_.get(), 0, stride_ * kColumns * sizeof(uint32_t));
  }

  // Columns from row `first` on.
  Fields<Out> Columns(size_t first = 0) { return View<Out>(first); }
  Fields<In> ReadColumns(size_t first = 0) const { return View<In>(first); }

  // The same as plain words, for code that treats all columns alike.
  std::array<uint32_t*, kColumns> Words(size_t first = 0) const {
    std::array<uint32_t*, kColumns> column;
    for (size_t c = 0; c < kColumns; ++c) column[c] = cells_.get() + c * stride_ + first;
    return column;
  }

  bool ok() const { return cells_ != nullptr; }
  size_t capacity() const { return capacity_; }
  size_t bytes() const { return stride_ * kColumns * sizeof(uint32_t); }
  static constexpr size_t kRowBytes = kColumns * sizeof(uint32_t);

 private:
  template <template <class> class C> Fields<C> View(size_t first) const {
    return std::bit_cast<Fields<C>>(Words(first));  // a struct of N pointers is N pointers
  }

  size_t capacity_;
  size_t stride_;
  hwy::AlignedFreeUniquePtr<uint32_t[]> cells_;
};

}  // namespace swell

#endif  // SWELL_WAVE_TABLE_H_
