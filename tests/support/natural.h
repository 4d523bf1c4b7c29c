// Whole numbers of any size, as an oracle for rounding: multiply, shift, compare.
#ifndef SWELL_TESTS_SUPPORT_NATURAL_H_
#define SWELL_TESTS_SUPPORT_NATURAL_H_

#include <cstdint>
#include <vector>

namespace swell::test {

class Natural {
 public:
  explicit Natural(unsigned __int128 value) {
    for (; value != 0; value >>= 32) limbs_.push_back(static_cast<uint32_t>(value));
  }

  void Multiply(uint64_t factor) {
    unsigned __int128 carry = 0;
    for (uint32_t& limb : limbs_) {
      carry += static_cast<unsigned __int128>(limb) * factor;
      limb = static_cast<uint32_t>(carry);
      carry >>= 32;
    }
    for (; carry != 0; carry >>= 32) limbs_.push_back(static_cast<uint32_t>(carry));
    Trim();
  }
  void ShiftLeft(unsigned bits) {
    if (limbs_.empty()) return;
    Multiply(uint64_t{1} << bits % 32);
    limbs_.insert(limbs_.begin(), bits / 32, 0u);
  }
  // Negative, 0 or positive as *this is below, equal to or above `other`.
  int Compare(const Natural& other) const {
    if (limbs_.size() != other.limbs_.size()) return limbs_.size() < other.limbs_.size() ? -1 : 1;
    for (size_t i = limbs_.size(); i-- > 0;) {
      if (limbs_[i] != other.limbs_[i]) return limbs_[i] < other.limbs_[i] ? -1 : 1;
    }
    return 0;
  }

 private:
  void Trim() {
    while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
  }
  std::vector<uint32_t> limbs_;  // least significant first, no zeros at the end
};

}  // namespace swell::test

#endif  // SWELL_TESTS_SUPPORT_NATURAL_H_
