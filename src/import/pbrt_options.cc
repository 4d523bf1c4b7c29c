// Directives of the camera, the film, the sampler and other options -> the camera and the request.
#include "src/import/pbrt_directives.h"

#include "src/import/options.h"

namespace swell {

void PbrtReader::Camera(Place place) {
  const std::string type = Text("the camera's type");
  Parameters parameters = ParseParameters(place, "Camera '" + type + "'");
  if (failed()) return;
  ReadCamera(parameters, type, state_.to_world, &scene_.camera, &shutter_);
  scene_.camera.medium = state_.outside;
  if (const auto to_world = Inverse(state_.to_world)) systems_["camera"] = *to_world;
}

void PbrtReader::Film(Place place) {
  const std::string type = Text("the film's type");
  Parameters parameters = ParseParameters(place, "Film '" + type + "'");
  if (!failed()) ReadFilm(parameters, type, &scene_.request);
}

void PbrtReader::Sampler(Place place) {
  const std::string type = Text("the sampler's type");
  Parameters parameters = ParseParameters(place, "Sampler '" + type + "'");
  if (!failed()) ReadSampler(parameters, type, &scene_.request);
}

void PbrtReader::PixelFilter(Place place) {
  const std::string type = Text("the filter's type");
  Parameters parameters = ParseParameters(place, "PixelFilter '" + type + "'");
  if (!failed()) ReadPixelFilter(parameters, type, &scene_.request.filter);
}

void PbrtReader::Integrator(Place place) {
  const std::string type = Text("the integrator's type");
  Parameters parameters = ParseParameters(place, "Integrator '" + type + "'");
  if (!failed()) ReadIntegrator(parameters, type, &scene_.request);
}

void PbrtReader::Accelerator(Place place) {
  Text("the accelerator's type");
  SkipParameters(place);
}

}  // namespace swell
