// The leaves of wide nodes in, the blocks that they share out.
#include "src/bvh/share_blocks.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "kernels/records.h"

namespace swell {
namespace {

bool IsTriangleLeaf(uint32_t child) {
  return (child & kLeafBit) != 0 && (child & kSphereLeafBit) == 0;
}

float HalfAreaOf(const BvhNode& node, uint32_t i) {
  const float x = node.bounds[3][i] - node.bounds[0][i], y = node.bounds[4][i] - node.bounds[1][i],
              z = node.bounds[5][i] - node.bounds[2][i];
  return x * y + y * z + z * x;
}

// A few; equal ones keep their order.
template <class Item, class Before> void SortFew(std::span<Item> items, const Before& before) {
  for (size_t i = 1; i < items.size(); ++i) {
    for (size_t k = i; k > 0 && before(items[k], items[k - 1]); --k) {
      std::swap(items[k], items[k - 1]);
    }
  }
}

uint32_t Hash(uint32_t prim, size_t size) {
  return (prim * 2654435761u) >> (32 - std::countr_zero(size));
}

}  // namespace

BlockSharer::BlockSharer(const BinaryTree& tree)
    : tree_(tree),
      seat_(tree.prims.size(), kNone),
      chains_(std::bit_ceil(std::max<size_t>(2, tree.prims.size())), kNone) {
  prims_.reserve(tree.prims.size());
  next_.reserve(tree.prims.size());
  taken_.reserve(tree.block_begins.size());
  std::fill(std::begin(open_), std::end(open_), kNone);
  // Full ones first, because others may be parts of them.
  for (uint32_t i = 0; i < tree.block_begins.size(); ++i) {
    if (PrimsOf(i).size() < kBlockWidth || FindPlace(i)) continue;
    Bin bin;
    Add({i, 0.0f}, bin);
    PlaceBin(bin);
  }
}

std::span<const uint32_t> BlockSharer::PrimsOf(uint32_t block) const {
  const size_t begin = tree_.block_begins[block];
  const bool last = block + 1 == tree_.block_begins.size();
  const size_t end = last ? tree_.prims.size() : tree_.block_begins[block + 1];
  return {tree_.prims.data() + begin, end - begin};
}

void BlockSharer::Place(BvhNode& node) {
  Item items[kBvhWidth];
  uint32_t count = 0;
  for (uint32_t i = 0; i < ChildCount(node); ++i) {
    if (!IsTriangleLeaf(node.child[i])) continue;
    const uint32_t block = LeafBlock(node.child[i]);
    if (seat_[tree_.block_begins[block]] != kNone || FindPlace(block)) continue;
    Item* const end = items + count;
    Item* const item = std::find_if(items, end, [=](const Item& i) { return i.block == block; });
    if (item == end) items[count++] = {block, 0.0f};
    item->urgency += HalfAreaOf(node, i) / static_cast<float>(PrimsOf(block).size());
  }
  PlaceItems({items, count});
  for (uint32_t i = 0; i < ChildCount(node); ++i) {
    if (IsTriangleLeaf(node.child[i])) node.child[i] = Moved(node.child[i]);
  }
}

void BlockSharer::Place(uint32_t& leaf) {
  if (!IsTriangleLeaf(leaf)) return;
  const uint32_t block = LeafBlock(leaf);
  if (seat_[tree_.block_begins[block]] == kNone && !FindPlace(block)) {
    Item item = {block, 0.0f};
    PlaceItems({&item, 1});
  }
  leaf = Moved(leaf);
}

uint32_t BlockSharer::MissingIn(const Bin& bin, uint32_t block) const {
  uint32_t missing = 0;
  const uint32_t* const end = bin.prims + bin.count;
  for (const uint32_t prim : PrimsOf(block)) missing += std::find(bin.prims, end, prim) == end;
  return missing;
}

void BlockSharer::Add(const Item& item, Bin& bin) const {
  bin.item[bin.items++] = item;
  for (const uint32_t prim : PrimsOf(item.block)) {
    uint32_t* const end = bin.prims + bin.count;
    if (std::find(bin.prims, end, prim) == end) bin.prims[bin.count++] = prim;
  }
}

// The largest first, each where it takes the fewest slots.
void BlockSharer::PlaceItems(std::span<Item> items) {
  SortFew(items, [&](const Item& a, const Item& b) {
    return PrimsOf(a.block).size() > PrimsOf(b.block).size();
  });
  Bin bins[kBvhWidth];
  uint32_t count = 0;
  for (const Item& item : items) {
    uint32_t best = count, least = kBlockWidth;
    for (uint32_t k = 0; k < count; ++k) {
      const uint32_t missing = MissingIn(bins[k], item.block);
      if (bins[k].count + missing > kBlockWidth || missing >= least) continue;
      best = k;
      least = missing;
    }
    count = std::max(count, best + 1);
    Add(item, bins[best]);
  }
  for (uint32_t k = 0; k < count; ++k) PlaceBin(bins[k]);
}

// Into the open block of which the least is left then, or a new one.
void BlockSharer::PlaceBin(const Bin& bin) {
  Item items[kBvhWidth];
  std::copy_n(bin.item, bin.items, items);
  SortFew(std::span<Item>(items, bin.items),
          [](const Item& a, const Item& b) { return a.urgency > b.urgency; });
  Bin sorted;
  for (uint32_t i = 0; i < bin.items; ++i) Add(items[i], sorted);
  uint32_t taken = kBlockWidth - sorted.count;
  while (taken > 0 && open_[taken] == kNone) --taken;
  uint32_t to = blocks();
  if (taken > 0) {
    to = std::exchange(open_[taken], kNone);
  } else {
    taken_.push_back(0);
    prims_.resize(prims_.size() + kBlockWidth, kNoPrim);
    next_.resize(prims_.size(), kNone);
  }
  for (uint32_t i = 0; i < sorted.count; ++i) {
    const auto first = prims_.begin() + kBlockWidth * size_t{to}, end = first + taken_[to];
    if (std::find(first, end, sorted.prims[i]) != end) continue;
    const uint32_t row = to * kBlockWidth + taken_[to]++;
    prims_[row] = sorted.prims[i];
    next_[row] = std::exchange(chains_[Hash(prims_[row], chains_.size())], row);
  }
  if (taken_[to] < kBlockWidth) open_[taken_[to]] = to;
  for (uint32_t i = 0; i < bin.items; ++i) Sit(items[i].block, to);
}

// A block that holds all of the tree's block already.
bool BlockSharer::FindPlace(uint32_t block) {
  const uint32_t first = PrimsOf(block)[0];
  for (uint32_t row = chains_[Hash(first, chains_.size())]; row != kNone; row = next_[row]) {
    if (prims_[row] == first && Sit(block, row / kBlockWidth)) return true;
  }
  return false;
}

// False if not all of the tree's block is there.
bool BlockSharer::Sit(uint32_t block, uint32_t to) {
  const uint32_t* const first = prims_.data() + kBlockWidth * size_t{to};
  const uint32_t* const end = first + taken_[to];
  const std::span<const uint32_t> prims = PrimsOf(block);
  uint32_t rows[kBlockWidth];
  for (size_t i = 0; i < prims.size(); ++i) {
    const uint32_t* const at = std::find(first, end, prims[i]);
    if (at == end) return false;
    rows[i] = static_cast<uint32_t>(at - prims_.data());
  }
  std::copy_n(rows, prims.size(), seat_.begin() + tree_.block_begins[block]);
  return true;
}

uint32_t BlockSharer::Moved(uint32_t leaf) const {
  const auto seat = seat_.begin() + tree_.block_begins[LeafBlock(leaf)];
  const uint32_t last = *std::max_element(seat, seat + LeafCount(leaf));
  return kLeafBit | ((last % kBlockWidth) << kBlockCountShift) | (last / kBlockWidth);
}

PageArray<uint32_t> BlockSharer::Rows() const {
  size_t size = blocks() + 1;
  for (const uint8_t taken : taken_) size += taken;
  PageArray<uint32_t> rows(size);
  uint32_t at = blocks() + 1;
  for (uint32_t i = 0; i < blocks(); ++i) {
    rows[i] = at;
    std::copy_n(prims_.data() + kBlockWidth * size_t{i}, taken_[i], rows.data() + at);
    at += taken_[i];
  }
  rows[blocks()] = at;
  return rows;
}

}  // namespace swell
