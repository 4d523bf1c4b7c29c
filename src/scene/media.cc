// Media and the shapes that divide them -> the tables that kernels read.
#include <algorithm>

#include "src/scene/scene.h"

namespace swell {

MediaTables MakeMediaTables(const Scene& scene) {
  MediaTables tables;
  const bool any = scene.camera.medium != kVacuum ||
                   std::any_of(scene.shapes.begin(), scene.shapes.end(),
                               [](const Shape& shape) { return shape.inside != shape.outside; });
  if (!any) return tables;
  for (const Medium& medium : scene.media) {
    tables.absorption.insert(tables.absorption.end(), medium.absorption.begin(),
                             medium.absorption.end());
  }
  for (const Shape& shape : scene.shapes) {
    const bool border = shape.border;
    tables.view.any_border = tables.view.any_border || border;
    tables.inside.push_back(border ? kVacuum : shape.inside);
    tables.outside.push_back(border ? kVacuum : shape.outside);
    tables.border_inside.push_back(border ? shape.inside : kVacuum);
    tables.border_outside.push_back(border ? shape.outside : kVacuum);
  }
  tables.view.absorption = tables.absorption.data();
  tables.view.surfaces = {tables.inside.data(), tables.outside.data()};
  tables.view.borders = {tables.border_inside.data(), tables.border_outside.data()};
  tables.view.camera = scene.camera.medium;
  return tables;
}

}  // namespace swell
