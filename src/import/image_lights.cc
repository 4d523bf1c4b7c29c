// Infinite, goniometric and projection lights with pbrt-v4's meaning of their images and units.
#include "src/import/image_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/import/read_image.h"
#include "src/import/spectrum.h"

namespace swell {
namespace {

constexpr double kPi = std::numbers::pi;

void SetSpace(const Transform& to_world, ImageLight* light) {
  const auto inverse = Inverse(to_world);
  for (size_t row = 0; row < 3; ++row) {
    for (size_t col = 0; col < 3; ++col) {
      light->world_from_light[3 * row + col] = static_cast<float>(to_world.m[4 * row + col]);
      light->light_from_world[3 * row + col] = static_cast<float>(inverse->m[4 * row + col]);
    }
  }
}

void SetPosition(const Transform& to_world, LightRecord* light) {
  const Point p = MapPoint(to_world, {0, 0, 0});
  for (size_t c = 0; c < 3; ++c) light->p[c] = static_cast<float>(p[c]);
}

bool CheckTransform(Parameters& parameters, const Transform& to_world) {
  if (Inverse(to_world)) return true;
  parameters.Fail(parameters.place(), "the transform is singular; it flattens the light");
  return false;
}

// A square is the equal-area map of pbrt-v4; twice as wide as high is the latitude-longitude map of
// everyone else, placed as pbrt's `imgtool makeequiarea` takes it.
bool FindMapping(Parameters& parameters, const Parameter& file, ImageLight* light) {
  const ImageLevel& level = light->image.levels[0];
  if (level.width == level.height) {
    light->mapping = ImageMapping::kEqualArea;
  } else if (level.width == 2 * level.height) {
    light->mapping = ImageMapping::kLatLong;
  } else {
    parameters.Fail(file.place, file.Title() + " has " + std::to_string(level.width) + " x " +
                                    std::to_string(level.height) +
                                    " pixels; a sphere of directions is square (equal-area) or "
                                    "twice as wide as high (latitude-longitude)");
    return false;
  }
  return true;
}

double Illuminance(const ImageLight& light) {
  double sum = 0.0;
  const ImageLevel& level = light.image.levels[0];
  for (uint32_t y = 0; y < level.height; ++y) {
    const double angle = PixelSolidAngle(light.image, light.mapping, y);
    for (uint32_t x = 0; x < level.width; ++x) {
      const double cosine = PixelDirection(light.image, light.mapping, x, y)[2];
      if (cosine > 0.0) sum += angle * cosine * Luminance(TexelAt(light.image, 0, x, y));
    }
  }
  return sum;
}

// Mean over the sphere of directions, or over the slide, of luminance times `weight`.
template <class Weight> double MeanLuminance(const ImageLight& light, const Weight& weight) {
  double sum = 0.0;
  const ImageLevel& level = light.image.levels[0];
  for (uint32_t y = 0; y < level.height; ++y) {
    double row = 0.0;
    for (uint32_t x = 0; x < level.width; ++x) {
      row += Luminance(TexelAt(light.image, 0, x, y)) *
             weight((x + 0.5) / level.width, (y + 0.5) / level.height);
    }
    const double share = light.mapping == ImageMapping::kLatLong
                             ? PixelSolidAngle(light.image, light.mapping, y) / (4.0 * kPi)
                             : 1.0 / (double{1} * level.width * level.height);
    sum += row * share;
  }
  return sum;
}

// Scales the light so that `emitted`, what it emits now, becomes the target, if there is one.
void MeetTarget(Parameters& parameters, const char* name, double emitted, LightRecord* light) {
  const float target = parameters.Float(name, -1.0f);
  if (!(target > 0.0f)) return;
  if (!(emitted > 0.0)) {
    return parameters.Fail(parameters.Any(name)->place,
                           "the image is black; no \"" + std::string(name) + "\" can come of it");
  }
  for (float& channel : light->radiance) channel *= static_cast<float>(target / emitted);
}

void Add(const ImageLight& image_light, LightRecord* light, Scene* scene) {
  light->image = static_cast<uint32_t>(scene->image_lights.size());
  scene->image_lights.push_back(image_light);
}

}  // namespace

double Luminance(const std::array<float, 3>& rgb) {  // ITU-R BT.709
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

bool ReadLightImage(Parameters& parameters, const Parameter& file, TexelImage* image) {
  if (file.type != "string" || file.strings.size() != 1) {
    parameters.FailType(file, "string");
    return false;
  }
  const std::string path = parameters.ResolveFile(file.strings[0], file.place);
  if (parameters.failed()) return false;
  const Result<ReadPixels> read = ReadImagePixels(path, ImageUse::kColor, {});
  if (!read) {
    parameters.Fail(file.place, read.error().message);
    return false;
  }
  if (read->not_finite > 0) {
    parameters.Fail(file.place, path + ": " + std::to_string(read->not_finite) +
                                    " values are not finite; a light needs finite ones");
    return false;
  }
  *image = MakeTexelImage(read->pixels, Levels::kOne);
  image->name = path;
  return true;
}

void ReadSkyImage(Parameters& parameters, const Parameter& file, const Transform& to_world,
                  LightRecord* light, Scene* scene) {
  ImageLight sky;
  if (!CheckTransform(parameters, to_world)) return;
  if (!ReadLightImage(parameters, file, &sky.image)) return;
  if (!FindMapping(parameters, file, &sky)) return;
  sky.infinite = true;
  SetSpace(to_world, &sky);
  if (parameters.Any("illuminance") != nullptr) {
    MeetTarget(parameters, "illuminance", Illuminance(sky), light);
  }
  Add(sky, light, scene);
}

void ReadGoniometric(Parameters& parameters, const Transform& to_world, LightRecord* light,
                     Scene* scene) {
  const Parameter* file = parameters.Any("filename");
  if (file == nullptr) {
    return parameters.Fail(parameters.place(), "\"string filename\" is missing");
  }
  ImageLight beam;
  if (!CheckTransform(parameters, to_world)) return;
  if (!ReadLightImage(parameters, *file, &beam.image)) return;
  if (!FindMapping(parameters, *file, &beam)) return;
  // pbrt swaps y and z: the image's z, its middle, is the light's y.
  SetSpace(to_world * Transform{{1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0}}, &beam);
  SetPosition(to_world, light);
  const auto all = [](double, double) { return 1.0; };
  if (parameters.Any("power") != nullptr) {
    const double level = Luminance({light->radiance[0], light->radiance[1], light->radiance[2]});
    // As pbrt, which counts the colour "I" as white here.
    const double white = level > 0.0 ? 1.0 : 0.0;
    MeetTarget(parameters, "power", white * 4.0 * kPi * MeanLuminance(beam, all), light);
  }
  Add(beam, light, scene);
}

void ReadProjection(Parameters& parameters, const Transform& to_world, LightRecord* light,
                    Scene* scene) {
  const Parameter* file = parameters.Any("filename");
  const float fov = parameters.FloatWithin("fov", 90.0f, 0.001f, 179.9f);
  if (file == nullptr) {
    return parameters.Fail(parameters.place(), "\"string filename\" is missing");
  }
  ImageLight beam;
  if (!CheckTransform(parameters, to_world)) return;
  if (!ReadLightImage(parameters, *file, &beam.image)) return;
  beam.mapping = ImageMapping::kProjection;
  // "fov" spans the shorter side; images have their first row on top, so y points down.
  const ImageLevel& level = beam.image.levels[0];
  const double aspect = double{1} * level.width / level.height, half = std::tan(fov * kPi / 360.0);
  const double x = half * std::max(1.0, aspect), y = half * std::max(1.0, 1.0 / aspect);
  beam.half_width = {static_cast<float>(x), static_cast<float>(y)};
  SetSpace(to_world * Scale(1, -1, 1), &beam);
  SetPosition(to_world, light);
  if (parameters.Any("power") != nullptr) {
    // Solid angle of the slide's parts: cos^3 of the angle to its middle.
    const auto cosine3 = [&](double u, double v) {
      const double px = (2 * u - 1) * x, py = (2 * v - 1) * y;
      return std::pow(1.0 + px * px + py * py, -1.5);
    };
    MeetTarget(parameters, "power", 4.0 * x * y * MeanLuminance(beam, cosine3), light);
  }
  Add(beam, light, scene);
}

uint32_t ReadSurfaceImage(Parameters& parameters, const Parameter& file, Scene* scene,
                          double* mean_luminance) {
  ImageLight surface;
  surface.mapping = ImageMapping::kSurface;
  if (!ReadLightImage(parameters, file, &surface.image)) return kNoTexture;
  *mean_luminance = MeanLuminance(surface, [](double, double) { return 1.0; });
  scene->image_lights.push_back(surface);
  return static_cast<uint32_t>(scene->image_lights.size() - 1);
}

}  // namespace swell
