// Camera, Film, Sampler, PixelFilter and Integrator directives -> the scene's camera and request.
#ifndef SWELL_IMPORT_OPTIONS_H_
#define SWELL_IMPORT_OPTIONS_H_

#include <string>

#include "src/import/parameters.h"
#include "src/import/transform.h"
#include "src/scene/scene.h"

namespace swell {

inline constexpr int32_t kMaxResolution = 65535;  // pixels are packed as x | y << 16

// `shutter` receives the time that the shutter is open, which scales the exposure.
void ReadCamera(Parameters& parameters, const std::string& type, const Transform& world_to_camera,
                Camera* camera, float* shutter);
void ReadFilm(Parameters& parameters, const std::string& type, RenderRequest* request);
void ReadSampler(Parameters& parameters, const std::string& type, RenderRequest* request);
void ReadPixelFilter(Parameters& parameters, const std::string& type, Filter* filter);
void ReadIntegrator(Parameters& parameters, const std::string& type, RenderRequest* request);

}  // namespace swell

#endif  // SWELL_IMPORT_OPTIONS_H_
