// Rows of an imported file's tables -> rows of the scene that imports it.
#ifndef SWELL_IMPORT_ROW_MAP_H_
#define SWELL_IMPORT_ROW_MAP_H_

#include <cstdint>
#include <vector>

#include "src/import/shapes.h"
#include "src/scene/scene.h"

namespace swell {

struct RowMap {
  // By the imported file's row.
  std::vector<uint32_t> materials, media, images, image_lights;
  uint32_t first_mix = 0;
  uint32_t outer_nodes = 0;  // texture nodes below this are the importing file's own
  uint32_t first_node = 0;   // of the others

  uint32_t Material(uint32_t row) const {
    return (row & kMixedMaterial) != 0 ? row + first_mix : materials[row];
  }
  uint32_t Node(uint32_t row) const {
    return row < outer_nodes || row == kNoTexture ? row : row - outer_nodes + first_node;
  }
  uint32_t Image(uint32_t row) const { return row == kNoTexture ? row : images[row]; }
  uint32_t ImageLight(uint32_t row) const { return row == kNoTexture ? row : image_lights[row]; }

  void Map(Shape* shape) const {
    shape->record.material = Material(shape->record.material);
    shape->alpha = Node(shape->alpha);
    shape->emission_image = ImageLight(shape->emission_image);
    shape->inside = media[shape->inside];
    shape->outside = media[shape->outside];
  }
  void Map(Placement* placement) const {
    placement->material = Material(placement->material);
    placement->alpha = Node(placement->alpha);
    placement->emission.image = ImageLight(placement->emission.image);
    placement->inside = media[placement->inside];
    placement->outside = media[placement->outside];
  }
};

}  // namespace swell

#endif  // SWELL_IMPORT_ROW_MAP_H_
