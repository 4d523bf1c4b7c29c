// Implements layered.h.
#include "tests/reference/layered.h"

#include <cmath>
#include <complex>

namespace swell::reference {
namespace {

constexpr double kPi = 3.14159265358979323846;

double Uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

bool IsSmooth(const Facets& facets) { return facets.x == 0.0; }

// Drawn from D(m) cos(m), by slopes: not the visible ones only.
Vector DrawFacet(const Facets& facets, std::mt19937_64& random) {
  if (IsSmooth(facets)) return {0, 0, 1};
  const double u = Uniform(random), phi = 2.0 * kPi * Uniform(random);
  const double radius = std::sqrt(u / (1.0 - u));
  return Normalize({radius * facets.x * std::cos(phi), radius * facets.y * std::sin(phi), 1.0});
}

double Lambda(const Facets& facets, const Vector& w) {
  const double slope =
      (facets.x * facets.x * w.x * w.x + facets.y * facets.y * w.y * w.y) / (w.z * w.z);
  return (std::sqrt(1.0 + slope) - 1.0) / 2.0;
}

// f cos(wi) / pdf, but for the Fresnel share, of going from wo to wi by the facet m.
double FacetWeight(const Facets& facets, const Vector& wo, const Vector& wi, const Vector& m) {
  if (IsSmooth(facets)) return 1.0;
  const double g = 1.0 / (1.0 + Lambda(facets, wo) + Lambda(facets, wi));
  return g * std::fabs(Dot(wo, m)) / std::fabs(wo.z * m.z);
}

double Fresnel(double cos_i, double cos_t, double eta) {
  const double p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const double s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5 * (p * p + s * s);
}

double FresnelMetal(double cos_i, std::complex<double> index) {
  const std::complex<double> cos_t = std::sqrt(1.0 - (1.0 - cos_i * cos_i) / (index * index));
  const std::complex<double> p = (index * cos_i - cos_t) / (index * cos_i + cos_t);
  const std::complex<double> s = (cos_i - index * cos_t) / (cos_i + index * cos_t);
  return 0.5 * (std::norm(p) + std::norm(s));
}

// Scatters at the coat; w points to where light came from and becomes where it goes. Returns the
// weight, without the squared index: it cancels from air to air.
double ScatterAtCoat(const LayeredModel& model, Vector& w, std::mt19937_64& random) {
  const bool below = w.z < 0.0;
  const Vector view = below ? Vector{w.x, w.y, -w.z} : w;
  const double eta = below ? 1.0 / model.eta : model.eta;
  const Vector m = DrawFacet(model.coat, random);
  const double cos_i = Dot(view, m);
  if (cos_i <= 0.0) return 0.0;
  const double cos2_t = 1.0 - (1.0 - cos_i * cos_i) / (eta * eta);
  const double cos_t = std::sqrt(std::fmax(0.0, cos2_t));
  const double share = cos2_t <= 0.0 ? 1.0 : Fresnel(cos_i, cos_t, eta);
  const bool reflect = Uniform(random) < share;
  Vector to = reflect ? m * (2.0 * cos_i) - view : m * (cos_i / eta - cos_t) - view * (1.0 / eta);
  if ((to.z > 0.0) != reflect) return 0.0;
  const double weight = FacetWeight(model.coat, view, to, m);
  if (below) to.z = -to.z;
  w = to;
  return weight;
}

// Likewise at the ground; w points up.
double ScatterAtGround(const LayeredModel& model, Vector& w, std::mt19937_64& random) {
  if (!model.metal) {
    const double u = Uniform(random), phi = 2.0 * kPi * Uniform(random);
    w = {std::sqrt(u) * std::cos(phi), std::sqrt(u) * std::sin(phi), std::sqrt(1.0 - u)};
    return model.reflectance;
  }
  const Vector m = DrawFacet(model.ground, random);
  const double cos_i = Dot(w, m);
  if (cos_i <= 0.0) return 0.0;
  const Vector to = m * (2.0 * cos_i) - w;
  if (to.z <= 0.0) return 0.0;
  const std::complex<double> index(model.metal_eta / model.eta, model.metal_k / model.eta);
  const double weight = FresnelMetal(cos_i, index) * FacetWeight(model.ground, w, to, m);
  w = to;
  return weight;
}

// A direction around w, the direction of travel: by the rejection of a uniform one against the
// phase function's largest value.
Vector ScatterInside(double g, const Vector& w, std::mt19937_64& random) {
  const auto phase = [&](double cosine) {
    return (1.0 - g * g) / std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5);
  };
  const double most = phase(g < 0.0 ? -1.0 : 1.0);
  for (;;) {
    const double z = 1.0 - 2.0 * Uniform(random), phi = 2.0 * kPi * Uniform(random);
    const double r = std::sqrt(1.0 - z * z);
    const Vector to = {r * std::cos(phi), r * std::sin(phi), z};
    if (Uniform(random) * most < phase(Dot(to, w))) return to;
  }
}

}  // namespace

LayeredExit WalkLayers(const LayeredModel& model, const Vector& wo, std::mt19937_64& random) {
  Vector w = wo;  // from the coat on: the direction of travel
  double weight = ScatterAtCoat(model, w, random), z = model.thickness;
  bool specular = IsSmooth(model.coat);
  for (int event = 0; weight > 0.0; ++event) {
    if (w.z > 0.0 && z == model.thickness) return {w, weight, specular};
    if (event == model.max_events) break;
    double step = w.z > 0.0 ? model.thickness - z : z;  // of height, to the next border
    if (model.albedo > 0.0) {
      const double free = -std::log(1.0 - Uniform(random)) * std::fabs(w.z);
      if (free < step) {
        z += w.z > 0.0 ? free : -free;
        weight *= model.albedo;
        w = ScatterInside(model.g, w, random);
        specular = false;
        continue;
      }
    } else {
      weight *= std::exp(-step / std::fabs(w.z));
    }
    const bool at_coat = w.z > 0.0;
    z = at_coat ? model.thickness : 0.0;
    w = w * -1.0;
    weight *= at_coat ? ScatterAtCoat(model, w, random) : ScatterAtGround(model, w, random);
    if (!at_coat) specular = IsSmooth(model.coat) && model.metal && IsSmooth(model.ground);
  }
  return {};
}

}  // namespace swell::reference
