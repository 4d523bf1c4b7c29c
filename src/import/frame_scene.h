// A scene that says nothing of its view or its light -> one with a camera that shows all of it, and
// a soft sky.
#ifndef SWELL_IMPORT_FRAME_SCENE_H_
#define SWELL_IMPORT_FRAME_SCENE_H_

#include "src/scene/scene.h"

namespace swell {

// FrameCamera and AddSoftSky. To be called when all geometry is in the scene; +y is up, and the
// front of things is at +z.
void FrameScene(Scene& scene);

// Looks at the middle of everything from the front, a little from the right and from above, as near
// as shows all of it in a frame of any shape; and asks for a picture of 1024 x 768.
void FrameCamera(Scene& scene);

// A grey environment, bright above and to the left of the automatic camera, dim behind what it
// looks at. White that lies flat in it is about white.
void AddSoftSky(Scene& scene);

}  // namespace swell

#endif  // SWELL_IMPORT_FRAME_SCENE_H_
