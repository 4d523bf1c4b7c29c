// The parameters of each shape, checked.
#include "src/import/shape_reader.h"

#include <algorithm>
#include <cmath>

#include "src/import/append_mesh.h"
#include "src/import/pbrt_v3.h"
#include "src/import/read_curve.h"
#include "src/import/subdivide.h"
#include "src/import/textures.h"
#include "src/base/suggest.h"

namespace swell {
namespace {

// The opacity of a shape; kNoTexture: 1 everywhere.
uint32_t ReadAlpha(Parameters& parameters) {
  if (parameters.Any("alpha") == nullptr || parameters.textures() == nullptr) return kNoTexture;
  const uint32_t node =
      parameters.textures()->Input(parameters, "alpha", TextureKind::kFloat, 1.0f);
  if (parameters.failed()) return kNoTexture;
  const TextureStep& step = parameters.textures()->node(node);
  return step.op == TextureOp::kConstant && step.value[0] >= 1.0f ? kNoTexture : node;
}

double ReadPhiMax(Parameters& parameters) {
  const float phi_max = parameters.FloatWithin("phimax", 360.0f, 0.0f, 360.0f);
  if (!parameters.failed() && phi_max == 0.0f) {
    parameters.Fail(parameters.Any("phimax")->place, "'phimax' is 0 but must be above 0");
  }
  return phi_max;
}

void ReadSphere(Parameters& parameters, const Placement& placement, Scene* scene) {
  const float radius = parameters.PositiveFloat("radius", 1.0f);
  const float z0 = parameters.Float("zmin", -radius), z1 = parameters.Float("zmax", radius);
  const double phi_max = ReadPhiMax(parameters);
  parameters.ReportUnknown();
  if (parameters.failed()) return;
  const float z_min = std::clamp(std::min(z0, z1), -radius, radius);
  const float z_max = std::clamp(std::max(z0, z1), -radius, radius);
  if (z_min <= -radius && z_max >= radius && phi_max >= 360.0) {
    return AddSphere(*scene, *parameters.diagnostics(), placement, radius);
  }
  if (!(z_min < z_max)) {
    return parameters.Fail(placement.place, "'zmin' and 'zmax' leave nothing of the sphere");
  }
  parameters.Warn(placement.place, "a part of a sphere is rendered as triangles");
  AddPartialSphere(*scene, *parameters.diagnostics(), placement, {radius, z_min, z_max, phi_max});
}

void ReadCylinder(Parameters& parameters, const Placement& placement, Scene* scene) {
  const float radius = parameters.PositiveFloat("radius", 1.0f);
  const float z0 = parameters.Float("zmin", -1.0f), z1 = parameters.Float("zmax", 1.0f);
  const double phi_max = ReadPhiMax(parameters);
  parameters.ReportUnknown();
  if (parameters.failed()) return;
  if (z0 == z1) return parameters.Fail(placement.place, "'zmin' and 'zmax' are the same");
  AddCylinder(*scene, *parameters.diagnostics(), placement,
              {radius, std::min(z0, z1), std::max(z0, z1), phi_max});
}

void ReadDisk(Parameters& parameters, const Placement& placement, Scene* scene) {
  const float height = parameters.Float("height", 0.0f);
  const float radius = parameters.PositiveFloat("radius", 1.0f);
  const float inner = parameters.FloatWithin("innerradius", 0.0f, 0.0f, 1e30f);
  const double phi_max = ReadPhiMax(parameters);
  parameters.ReportUnknown();
  if (parameters.failed()) return;
  if (!(inner < radius)) {
    return parameters.Fail(placement.place, "'innerradius' must be below 'radius'");
  }
  AddDisk(*scene, *parameters.diagnostics(), placement, {height, radius, inner, phi_max});
}

// An array with one row per vertex, or none with a warning.
void AppendRows(Parameters& parameters, const Parameter* parameter, size_t width, size_t vertices,
                std::vector<float>* out) {
  if (parameter == nullptr) return;
  if (parameter->floats.size() != width * vertices) {
    return parameters.Warn(parameter->place, parameter->Title() + " has " +
                                                 std::to_string(parameter->floats.size() / width) +
                                                 " rows but \"P\" " + std::to_string(vertices) +
                                                 "; it is ignored");
  }
  out->insert(out->end(), parameter->floats.begin(), parameter->floats.end());
}

// Appends P, N and uv and checks the indices, `corners` to a face, which may be absent for a single
// face. Null if there is no mesh.
const std::vector<int32_t>* ReadMeshRows(Parameters& parameters, size_t corners,
                                         std::vector<int32_t>* single, Scene* scene) {
  const Parameter* points = parameters.Floats("P", {"point3", "point"}, 3);
  const Parameter* indices = parameters.Ints("indices");
  const Parameter* normals = parameters.Floats("N", {"normal", "normal3"}, 3);
  const Parameter* uv = parameters.Floats("uv", {"point2", "float"}, 2);
  const Parameter* st = parameters.Floats("st", {"point2", "float"}, 2);
  parameters.Accept({"S", "faceIndices"});
  parameters.ReportUnknown();
  if (parameters.failed()) return nullptr;
  if (points == nullptr || points->floats.empty()) {
    parameters.Fail(parameters.place(), "\"point3 P\" is missing");
    return nullptr;
  }
  const size_t vertices = points->floats.size() / 3;
  if (indices == nullptr && vertices != corners) {
    parameters.Fail(parameters.place(), "\"integer indices\" is missing");
    return nullptr;
  }
  if (indices == nullptr) {
    for (size_t i = 0; i < corners; ++i) single->push_back(static_cast<int32_t>(i));
  }
  const std::vector<int32_t>* faces = indices == nullptr ? single : &indices->integers;
  if (faces->empty() || faces->size() % corners != 0) {
    parameters.Fail(indices->place, "'indices' has " + std::to_string(faces->size()) +
                                        " values, which is no multiple of " +
                                        std::to_string(corners) + " above 0");
    return nullptr;
  }
  for (size_t i = 0; i < faces->size(); ++i) {
    const int32_t index = (*faces)[i];
    if (index >= 0 && static_cast<size_t>(index) < vertices) continue;
    parameters.Fail(indices->place, "'indices' has " + std::to_string(index) + " at position " +
                                        std::to_string(i) + " but \"P\" has vertices 0 to " +
                                        std::to_string(vertices - 1));
    return nullptr;
  }
  scene->positions.insert(scene->positions.end(), points->floats.begin(), points->floats.end());
  AppendRows(parameters, normals, 3, vertices, &scene->normals);
  AppendRows(parameters, uv != nullptr ? uv : st, 2, vertices, &scene->uvs);
  return faces;
}

void ReadTriangleMesh(Parameters& parameters, const Placement& placement, Scene* scene) {
  const MeshStart start = BeginMesh(*scene);
  std::vector<int32_t> single;
  const std::vector<int32_t>* faces = ReadMeshRows(parameters, 3, &single, scene);
  if (faces == nullptr) return;
  const auto first = static_cast<uint32_t>(start.positions / 3);
  for (int32_t index : *faces) scene->indices.push_back(first + static_cast<uint32_t>(index));
  FinishMesh(*scene, *parameters.diagnostics(), placement, start);
}

void ReadBilinearMesh(Parameters& parameters, const Placement& placement, Scene* scene) {
  parameters.Ignore({"emissionfilename"});
  const MeshStart start = BeginMesh(*scene);
  std::vector<int32_t> single;
  const std::vector<int32_t>* faces = ReadMeshRows(parameters, 4, &single, scene);
  if (faces == nullptr) return;
  AddBilinearPatches(*scene, *parameters.diagnostics(), placement, start,
                     std::vector<uint32_t>(faces->begin(), faces->end()));
}

void ReadLoopSubdivision(Parameters& parameters, const Placement& placement, Scene* scene) {
  const int32_t levels = parameters.IntWithin("levels", 3, 0, kMaxSubdivisionLevels);
  parameters.Accept({"scheme"});
  const MeshStart start = BeginMesh(*scene);
  std::vector<int32_t> single;
  const std::vector<int32_t>* indices = ReadMeshRows(parameters, 3, &single, scene);
  if (indices == nullptr) return;
  ControlMesh control;
  for (size_t row = start.positions / 3; row < scene->positions.size() / 3; ++row) {
    control.points.push_back(Row3(scene->positions, row));
  }
  scene->positions.resize(start.positions);
  scene->normals.resize(start.normals);
  scene->uvs.resize(start.uvs);
  for (size_t i = 0; i < indices->size(); i += 3) {
    std::array<uint32_t, 3> face{};
    for (size_t k = 0; k < 3; ++k) face[k] = static_cast<uint32_t>((*indices)[i + k]);
    control.faces.push_back(face);
  }
  const Result<SmoothMesh> mesh = SubdivideLoop(std::move(control), levels);
  if (!mesh) return parameters.Fail(placement.place, mesh.error().message);
  for (size_t v = 0; v < mesh->points.size(); ++v) {
    // Where tangents vanish or no face is, any direction will do.
    const Point normal = Normalized(mesh->normals[v]).value_or(Point{0, 0, 1});
    AppendPoint(&scene->positions, mesh->points[v]);
    AppendPoint(&scene->normals, normal);
  }
  const auto first = static_cast<uint32_t>(start.positions / 3);
  for (const auto& face : mesh->faces) {
    for (const uint32_t corner : face) scene->indices.push_back(first + corner);
  }
  FinishMesh(*scene, *parameters.diagnostics(), placement, start);
}

void ReadPlyMesh(Parameters& parameters, const Placement& placement, SceneParts* parts) {
  const std::string name = parameters.String("filename", "");
  parameters.Ignore({"displacement"});
  parameters.Accept({"edgelength"});
  parameters.ReportUnknown();
  if (parameters.failed()) return;
  if (name.empty()) return parameters.Fail(placement.place, "\"string filename\" is missing");
  const std::string path = parameters.ResolveFile(name, parameters.Any("filename")->place);
  if (parameters.failed()) return;
  parts->AddPly(placement, path);
}

}  // namespace

void ReadShape(Parameters& parameters, const std::string& type, const Placement& placement,
               SceneParts* parts) {
  struct Kind {
    std::string_view name;
    void (*read)(Parameters&, const Placement&, Scene*);
  };
  constexpr Kind kKinds[] = {
      {"sphere", ReadSphere}, {"trianglemesh", ReadTriangleMesh}, {"plymesh", nullptr},
      {"disk", ReadDisk},     {"bilinearmesh", ReadBilinearMesh}, {"cylinder", ReadCylinder},
      {"curve", ReadCurve},   {"loopsubdiv", ReadLoopSubdivision}};
  std::vector<std::string_view> names;
  for (const Kind& kind : kKinds) {
    names.push_back(kind.name);
    if (kind.name != type) continue;
    Placement holed = placement;
    const uint32_t alpha = ReadAlpha(parameters);
    if (!placement.border) holed.alpha = alpha;
    if (kind.read == nullptr) return ReadPlyMesh(parameters, holed, parts);
    return kind.read(parameters, holed, &parts->Open(placement.place));
  }
  parameters.Fail(placement.place,
                  "unknown shape " + Quote(type) + KnownWords(type, names) + UpgradeHint(type));
}

}  // namespace swell
