// References and a plane in, the references of either side out.
#include "src/bvh/partition.h"

#include <utility>

namespace swell {
namespace {

constexpr size_t kChunk = 8192;  // references of one task

// What goes to which side; empty boxes are nothing.
class Cutter {
 public:
  Cutter(const Scene& scene, const SpatialSplit& split, float price)
      : scene_(scene),
        split_(split),
        price_(price),
        left_area_(split.left.HalfArea()),
        right_area_(split.right.HalfArea()) {}

  CutParts Cut(const Reference& ref) const {
    const Bounds4 none, box = ref.box();
    if (ref.is_sphere()) {
      const bool left = CentreOf(box)[split_.axis] * 0.5f < split_.plane;
      return left ? CutParts{box, none} : CutParts{none, box};
    }
    const CutParts parts = CutReference(scene_, ref, split_.axis, split_.plane);
    if (parts.left.IsEmpty() || parts.right.IsEmpty()) return parts;
    return Whole(box, parts);
  }

 private:
  // Reference unsplitting: Stich, Friedrich and Dietrich 2009, section 4.4, with a price.
  CutParts Whole(const Bounds4& box, const CutParts& parts) const {
    Bounds4 all_left = split_.left, all_right = split_.right;
    all_left.Add(box);
    all_right.Add(box);
    const float left = split_.left_weight, right = split_.right_weight;
    const float cut = left_area_ * left + right_area_ * right + price_;
    const float to_left = all_left.HalfArea() * left + right_area_ * (right - 1);
    const float to_right = left_area_ * (left - 1) + all_right.HalfArea() * right;
    const Bounds4 none;
    if (to_left < cut && to_left <= to_right) return {box, none};
    if (to_right < cut) return {none, box};
    return parts;
  }

  const Scene& scene_;
  const SpatialSplit& split_;
  const float price_;
  const float left_area_, right_area_;
};

// The left ones from the front, the right ones from the back.
CutResult CutInOnePass(const Cutter& cutter, std::span<const Reference> refs) {
  CutResult result = {PageArray<Reference>(2 * refs.size()), {}, {}};
  Reference* const begin = result.refs.data();
  Reference* const end = begin + result.refs.size();
  Reference *left = begin, *right = end;
  for (const Reference& ref : refs) {
    const CutParts parts = cutter.Cut(ref);
    if (!parts.left.IsEmpty()) *left++ = Reference(parts.left, ref.prim(), ref.is_sphere());
    if (!parts.right.IsEmpty()) *--right = Reference(parts.right, ref.prim(), ref.is_sphere());
  }
  result.left = {begin, left};
  result.right = {right, end};
  return result;
}

}  // namespace

CutResult CutReferences(const Scene& scene, std::span<const Reference> refs,
                        const SpatialSplit& split, float price) {
  const Cutter cutter(scene, split, price);
  if (refs.size() <= kChunk) return CutInOnePass(cutter, refs);
  const size_t chunks = (refs.size() + kChunk - 1) / kChunk;
  std::vector<uint32_t> left(chunks + 1, 0), right(chunks + 1, 0);
  const auto for_each = [&](size_t chunk, const auto& visit) {
    const size_t last = std::min(refs.size(), (chunk + 1) * kChunk);
    for (size_t i = chunk * kChunk; i < last; ++i) visit(refs[i], cutter.Cut(refs[i]));
  };
  tbb::parallel_for(size_t{0}, chunks, [&](size_t chunk) {
    for_each(chunk, [&](const Reference&, const CutParts& parts) {
      left[chunk + 1] += !parts.left.IsEmpty();
      right[chunk + 1] += !parts.right.IsEmpty();
    });
  });
  for (size_t i = 0; i < chunks; ++i) {
    left[i + 1] += left[i];
    right[i + 1] += right[i];
  }
  CutResult result = {PageArray<Reference>(size_t{left[chunks]} + right[chunks]), {}, {}};
  result.left = {result.refs.data(), left[chunks]};
  result.right = {result.refs.data() + left[chunks], right[chunks]};
  tbb::parallel_for(size_t{0}, chunks, [&](size_t chunk) {
    Reference* to_left = result.left.data() + left[chunk];
    Reference* to_right = result.right.data() + right[chunk];
    for_each(chunk, [&](const Reference& ref, const CutParts& parts) {
      if (!parts.left.IsEmpty()) *to_left++ = Reference(parts.left, ref.prim(), ref.is_sphere());
      if (!parts.right.IsEmpty()) *to_right++ = Reference(parts.right, ref.prim(), ref.is_sphere());
    });
  });
  return result;
}

}  // namespace swell
