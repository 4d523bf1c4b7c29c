// Bad scenes: each ends in one line that names its file, line and remedy.
#include <string>

#include "tests/import/scene_texts.h"

namespace swell {
namespace {

struct BadText {
  const char* text;
  const char* error;  // a fragment, with the place where it has one
};

void CheckError(const Result<Scene>& scene, const std::string& fragment) {
  REQUIRE(!scene);
  INFO("expected: ", fragment, "\ngot: ", scene.error().message);
  CHECK(scene.error().message.find(fragment) != std::string::npos);
  CHECK(scene.error().message.find('\n') == std::string::npos);
}

const BadText kBadTexts[] = {
    // structure
    {"# nothing\n", "scene.pbrt: WorldBegin is missing"},
    {"Identity\n", "scene.pbrt:1: WorldBegin is missing"},
    {"WorldBegn", "scene.pbrt:1: unknown directive 'WorldBegn'; did you mean 'WorldBegin'?"},
    {"WorldBegin\n\nShpae \"sphere\"",
     "scene.pbrt:3: unknown directive 'Shpae'; did you mean 'Shape'?"},
    {"\x01\x02garbage\xFF", "unknown directive '??garbage"},
    {"WorldBegin \"sphere\"", "a directive is expected, not text 'sphere'"},
    {"WorldBegin 12", "a directive is expected, not '12'"},
    {"WorldBegin ]", "a directive is expected, not ']'"},
    {"WorldBegin\nAttributeBegin\nAttributeBegin AttributeEnd",
     ":2: AttributeBegin is never closed"},
    {"WorldBegin\nAttributeEnd", ":2: AttributeEnd has no AttributeBegin"},
    {"WorldBegin\nAttributeBegin\nTransformEnd", ":3: TransformEnd closes the AttributeBegin of "},
    {"TransformBegin\nWorldBegin", ":2: the TransformBegin of "},
    {"WorldBegin ObjectEnd", "ObjectEnd has no ObjectBegin"},
    {"WorldBegin ObjectBegin \"a\" ObjectBegin \"b\"", "ObjectBegin inside of another"},
    {"WorldBegin\nObjectEnd", ":2: ObjectEnd has no ObjectBegin"},
    {"WorldBegin\nObjectBegin \"a\" Shape \"sphere\"", ":2: ObjectBegin is never closed"},
    {"WorldBegin ObjectBegin \"a\"\nAttributeBegin ObjectEnd",
     ":2: ObjectEnd closes the AttributeBegin"},
    {"WorldBegin\nObjectInstance \"a\"", ":2: object 'a' is not defined"},
    {"WorldBegin ObjectBegin \"tree\" Shape \"sphere\" ObjectEnd\nObjectInstance \"tre\"",
     ":2: object 'tre' is not defined; did you mean 'tree'?"},
    {"WorldBegin ObjectBegin \"b\"\nObjectInstance \"a\" ObjectEnd",
     ":2: object 'a' is not defined"},
    {"WorldBegin\nObjectBegin \"a\" ObjectEnd\nObjectBegin \"a\" ObjectEnd",
     ":3: object 'a' is already defined at "},
    {"WorldBegin ObjectBegin \"a\"\nObjectInstance \"a\" ObjectEnd",
     ":2: object 'a' contains itself"},
    {"WorldBegin ObjectBegin \"a\" ObjectInstance \"b\" ObjectEnd\nObjectBegin \"b\"\n"
     "ObjectInstance \"a\" ObjectEnd",
     "contains itself, through '"},
    {"WorldBegin ObjectBegin \"a\" Shape \"sphere\" ObjectEnd\nScale 1e-30 1e-30 1e-30\n"
     "Scale 1e-30 1e-30 1e-30 ObjectInstance \"a\"",
     ":3: the transform flattens object 'a'"},
    {"WorldBegin ObjectInstance a", "the object's name in quotes is expected, not 'a'"},
    {"Shape \"sphere\"", "'Shape' must come after WorldBegin"},
    {"WorldBegin\nFilm \"rgb\"", ":2: 'Film' must come before WorldBegin"},
    {"WorldBegin WorldBegin", "'WorldBegin' must come before WorldBegin"},
    // tokens
    {"WorldBegin\nShape \"sphere\n", ":2: a string starts here and has no closing quote"},
    {"WorldBegin Shape \"sphere", "has no closing quote"},
    {"WorldBegin Shape \"a\\q\"", "unknown escape '\\q'"},
    {"WorldBegin Translate 1 2", "a number is missing at the end"},
    {"WorldBegin Translate 1 2 x", "a number is expected, not 'x'"},
    {"WorldBegin Translate 1 2 1e60", "'1e60' is not a finite 32-bit number"},
    {"WorldBegin Translate 1 2 nan", "a number is expected, not 'nan'"},
    {"WorldBegin Translate 1 2 -inf", "'-inf' is not a finite 32-bit number"},
    {"WorldBegin Shape", "the shape's type in quotes is expected"},
    {"WorldBegin Shape sphere", "the shape's type in quotes is expected, not 'sphere'"},
    {"WorldBegin LightSource \"infi\\nite\"", "LightSource 'infi?ite': unknown light 'infi?ite'"},
    {"WorldBegin Include \"a\\nb\"", "file 'a?b' is not in"},
    // transforms
    {"WorldBegin\nScale 1 0 1", ":2: a scale of 0"},
    {"WorldBegin Rotate 30 0 0 0", "the axis of Rotate is zero"},
    {"LookAt 0 0 0  0 0 0  0 1 0", "LookAt: the eye and the target"},
    {"LookAt 0 0 0  0 5 0  0 1 0", "points along the view"},
    {"Transform [1 0 0 0 0 1 0 0 0 0 0 0 0 0 0 1]", ":1: the matrix is singular"},
    {"Transform [1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1]", "not affine"},
    {"Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 0]", "not affine"},
    {"Transform [1 2 3]", "a number is expected, not ']'"},
    {"Transform 1 2 3", "16 numbers in [ ]"},
    {"CoordSysTransform \"camra\"", "unknown coordinate system 'camra'"},
    {"ActiveTransform Sometimes", "All, StartTime or EndTime, not 'Sometimes'"},
    {"WorldBegin Scale 1e30 1e30 1e30 Scale 1e30 1e30 1e30 Shape \"sphere\"", "flattens it"},
    // options
    {"Camera \"perspectiv\"", "unknown camera 'perspectiv'; did you mean 'perspective'? (known: "},
    {"ColorSpace \"adobe\"",
     "unknown colour space 'adobe' (known: aces2065-1, dci-p3, rec2020, srgb)"},
    {"Option \"sed\" 3", "unknown option 'sed'; did you mean 'seed'?"},
    {"Attribute \"shap\" \"float radius\" 2",
     "unknown target 'shap' of Attribute; did you mean 'shape'?"},
    // media
    {"WorldBegin\nMediumInterface \"in\" \"\"", ":2: medium 'in' is not defined"},
    {"MakeNamedMedium \"a\"", "medium 'a': \"string type\" is missing"},
    {"MakeNamedMedium \"a\" \"string type\" \"homogenous\"", "did you mean 'homogeneous'?"},
    {"MakeNamedMedium \"a\" \"string type\" \"cloud\"\n"
     "MakeNamedMedium \"a\" \"string type\" \"cloud\"",
     ":2: medium 'a' is defined twice"},
    {"MakeNamedMedium \"a\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [1 -1 1] "
     "\"rgb sigma_s\" [0 0 0]",
     "\"rgb sigma_a\" must not be negative"},
    // pbrt-v3
    {"Film \"image\"", "it is pbrt-v3's: convert the file with `pbrt --upgrade"},
    {"Integrator \"directlighting\"", "`pbrt --upgrade"},
    {"Sampler \"lowdiscrepancy\"", "`pbrt --upgrade"},
    {"SurfaceIntegrator \"path\"", "`pbrt --upgrade"},
    {"WorldBegin Material \"matte\" \"rgb Kd\" [1 1 1]", "`pbrt --upgrade"},
    {"WorldBegin Material \"uber\"", "`pbrt --upgrade"},
    {"WorldBegin Texture \"t\" \"color\" \"constant\"", "`pbrt --upgrade"},
    {"WorldBegin LightSource \"point\" \"color I\" [1 1 1]", "`pbrt --upgrade"},
    {"WorldBegin Shape \"paraboloid\"", "`pbrt --upgrade"},
    // curves and subdivision
    {"WorldBegin Shape \"curve\"", "\"point3 P\" is missing"},
    {"WorldBegin Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0 4 0 0]",
     "a bezier curve of degree 3 has 4 points and 3 more a segment, not 5"},
    {"WorldBegin Shape \"curve\" \"string type\" \"ribbon\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]",
     "a ribbon of 1 segments needs \"normal N\" with 2 normals"},
    {"WorldBegin Shape \"curve\" \"string basis\" \"nurbs\"", "unknown basis 'nurbs'"},
    {"WorldBegin Shape \"loopsubdiv\" \"integer levels\" 13", "'levels' is 13 but must be between"},
    {"WorldBegin Shape \"loopsubdiv\" \"integer indices\" [0 1 2 0 1 3] "
     "\"point3 P\" [0 0 0 1 0 0 0 1 0 0 -1 0]",
     "the faces around vertex 0 make no surface"},
    {"WorldBegin Shape \"cylinder\" \"float zmin\" 1", "'zmin' and 'zmax' are the same"},
    {"WorldBegin LightSource \"infinite\" \"spectrum L\" \"stdillum-D66\"",
     "unknown spectrum 'stdillum-D66'; did you mean 'stdillum-D65'? (known: illum-acesD60, "
     "stdillum-A"},
    {"WorldBegin LightSource \"infinite\" \"spectrum L\" \"metal-Cu-eta\"",
     "'metal-Cu-eta' is no spectrum of light"},
    {"Camera \"perspective\" \"integer fov\" 45",
     "\"integer fov\" has the wrong type; write \"float fov\""},
    {"Camera \"perspective\" \"float fov\" 180", "'fov' must lie between 0 and 180"},
    {"Camera \"perspective\" \"float fov\" 0", "'fov' must lie between 0 and 180"},
    {"Camera \"perspective\" \"float fov\" [1 2]", "needs 1 value, not 2"},
    {"Camera \"perspective\" \"float fov\" nan", "needs numbers, not 'nan'"},
    {"Camera \"perspective\" \"float lensradius\" -1", "'lensradius' is -1 but must lie"},
    {"Camera \"perspective\" \"float focaldistance\" 0",
     "'focaldistance' is 0 but must be above 0"},
    {"Camera \"perspective\" \"float screenwindow\" [1 2 3]", "needs 4 values, not 3"},
    {"Camera \"perspective\" \"float screenwindow\" [1 1 0 1]", "'screenwindow' has no area"},
    {"Camera \"perspective\" \"float shutterclose\" 0", "the shutter opens and closes"},
    {"Film \"rgbb\"", "unknown film 'rgbb'; did you mean 'rgb'?"},
    {"Film \"rgb\"\n\"integer xresolution\" 0",
     ":2: Film 'rgb': 'xresolution' is 0 but must be between 1 and 65535"},
    {"Film \"rgb\" \"integer yresolution\" -5", "'yresolution' is -5"},
    {"Film \"rgb\" \"integer yresolution\" 65536", "'yresolution' is 65536"},
    {"Film \"rgb\" \"integer yresolution\" 99999999999", "does not fit 32 bits"},
    {"Film \"rgb\" \"integer yresolution\" 1.5", "a whole number is expected, not '1.5'"},
    {"Film \"rgb\" \"float cropwindow\" [0.5 0.5 0 1]", "the crop window holds no pixel"},
    {"Film \"rgb\" \"integer pixelbounds\" [5 5 0 9]", "the crop window holds no pixel"},
    {"Film \"rgb\" \"float iso\" 0", "'iso' is 0 but must be above 0"},
    {"Sampler \"sobl\"", "unknown sampler 'sobl'; did you mean 'sobol'?"},
    {"Sampler \"sobol\" \"integer pixelsamples\" 0", "'pixelsamples' is 0 but must be at least 1"},
    {"PixelFilter \"boxx\"", "unknown filter 'boxx'; did you mean 'box'?"},
    {"PixelFilter \"box\" \"float xradius\" 0", "'xradius' is 0 but must be above 0"},
    {"PixelFilter \"box\" \"float xradius\" 1000", "radius is above 64"},
    {"Integrator \"pth\"", "unknown integrator 'pth'; did you mean 'path'?"},
    {"Integrator \"ambientocclusion\"", "is not supported; use 'path'"},
    {"Integrator \"path\" \"integer maxdepth\" -1", "'maxdepth' is -1"},
    // parameters
    {"Film \"rgb\" \"xresolution\" 5",
     "\"TYPE NAME\" of a parameter is expected, not 'xresolution'"},
    {"Film \"rgb\" \"intger xresolution\" 5",
     "unknown parameter type 'intger'; did you mean 'integer'?"},
    {"Film \"rgb\" \"integer xresolution\" \"5\"", "needs numbers, not '5'"},
    {"Film \"rgb\" \"string filename\" 5", "needs text in quotes, not '5'"},
    {"Film \"rgb\"\n\"integer xresolution\" [5", ":2: Film 'rgb': '[' has no ']'"},
    {"Film \"rgb\" \"integer xresolution\"", "the value of \"integer xresolution\" is missing"},
    {"Film \"rgb\" \"bool savefp16\" maybe", "is true or false, not 'maybe'"},
    {"Film \"rgb\" \"integer xresolution\" 5 \"integer xresolution\" 5",
     "'xresolution' is given twice"},
    // materials
    {"WorldBegin\nMaterial \"difuse\"",
     ":2: Material 'difuse': unknown material 'difuse'; did you mean 'diffuse'? (known: conductor, "
     "diffuse, "
     "glass)"},
    {"WorldBegin Material \"diffuse\" \"rgb reflectance\" [0 0 1.5]",
     "is 1.5 but must lie between 0 and 1"},
    {"WorldBegin Material \"diffuse\" \"rgb reflectance\" [0 0 -1]", "must not be negative"},
    {"WorldBegin Material \"diffuse\" \"rgb reflectance\" [0 0]", "needs 3 values, not 2"},
    {"WorldBegin Material \"diffuse\" \"rgb reflectance\" [0 nan 0]", "needs numbers, not 'nan'"},
    {"WorldBegin Material \"diffuse\" \"rgb reflectance\" [0 -nan 0]", "'-nan' is not a finite"},
    {"WorldBegin Material \"diffuse\" \"integer reflectance\" 1", "write \"rgb reflectance\""},
    {"WorldBegin Material \"glass\" \"float eta\" 0.5", "is 0.5 but must lie between 1 and 4"},
    {"WorldBegin Material \"glass\" \"spectrum eta\" \"watr\"",
     "unknown value 'watr'; did you mean 'water'?"},
    {"WorldBegin Material \"glass\" \"string fresnel\" \"shlick\"",
     "unknown value 'shlick'; did you mean 'schlick'?"},
    {"WorldBegin Material \"glass\" \"float fresnel\" 1", "write \"string fresnel\""},
    {"WorldBegin Material \"diffuse\" \"spectrum reflectance\" [400 1 400 1]",
     "wavelengths of a spectrum must rise"},
    {"WorldBegin Material \"diffuse\" \"spectrum reflectance\" [400 1 500]", "pairs of wavelength"},
    {"WorldBegin Material \"diffuse\" \"spectrum reflectance\" \"none.spd\"",
     "file 'none.spd' is not in"},
    {"WorldBegin\nNamedMaterial \"wal\" MakeNamedMaterial \"wall\" \"string type\" \"diffuse\"",
     ":2: material 'wal' is not defined; did you mean 'wall'?"},
    {"WorldBegin MakeNamedMaterial \"wall\"", "has no \"string type\""},
    {"WorldBegin MakeNamedMaterial \"a\" \"string type\" \"diffuse\" MakeNamedMaterial \"a\" "
     "\"string type\" \"diffuse\"",
     "material 'a' is defined twice"},
    {"WorldBegin NamedMaterial \"a\" MakeNamedMaterial \"a\" \"string type\" \"interface\"",
     "define it before it is used"},
    {"WorldBegin Material \"glass\" \"integer maxdepth\" 10", "must lie between 1 and 9"},
    {"WorldBegin Material \"glass\" \"float maxdepth\" 2", "integer"},
    {"WorldBegin Material \"mix\" \"string materials\" \"a\"", "with two names"},
    {"WorldBegin MakeNamedMaterial \"i\" \"string type\" \"interface\" "
     "Material \"mix\" \"string materials\" [\"i\" \"i\"]",
     "an interface cannot be mixed"},
    {"WorldBegin MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" "
     "[\"m\" \"m\"]",
     "the mix 'm' holds itself"},
    {"WorldBegin NamedMaterial \"m\" MakeNamedMaterial \"m\" \"string type\" \"mix\"",
     "is a mix; define it before it is used"},
    {"WorldBegin Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" 2", "amount"},
    {"WorldBegin Material \"conductor\" \"rgb eta\" [1 1 1] \"rgb reflectance\" [1 1 1]",
     "not both"},
    {"WorldBegin Material \"conductor\" \"spectrum k\" \"metal-Cx-k\"",
     "unknown value 'metal-Cx-k'"},
    // lights
    {"WorldBegin LightSource \"pont\"", "unknown light 'pont'; did you mean 'point'?"},
    {"WorldBegin LightSource \"point\" \"rgb I\" [1 1]", "needs 3 values, not 2"},
    {"WorldBegin LightSource \"point\" \"rgb I\" [1 1 -1]", "must not be negative"},
    {"WorldBegin LightSource \"point\" \"float scale\" -1", "'scale' is -1"},
    {"WorldBegin LightSource \"point\" \"rgb I\" [1e30 1 1] \"float scale\" 1e30",
     "infinitely bright"},
    {"WorldBegin LightSource \"point\" \"float from\" 1", "write \"point3 from\""},
    {"WorldBegin LightSource \"distant\" \"point3 to\" [0 0 0]", "are the same point"},
    {"WorldBegin LightSource \"infinite\" \"blackbody L\" -5", "temperature of at least 500 K"},
    {"WorldBegin LightSource \"infinite\" \"spectrum L\" \"stdillum-D56\"",
     "unknown spectrum 'stdillum-D56'; did you mean 'stdillum-D"},
    {"WorldBegin LightSource \"infinite\" \"string L\" \"sky\"", "write \"rgb L\""},
    {"WorldBegin AreaLightSource \"diffus\"",
     "unknown area light 'diffus'; did you mean 'diffuse'?"},
    {"WorldBegin AreaLightSource \"diffuse\" \"float power\" 1e38 Scale 1e-7 1e-7 1e-7 Shape "
     "\"disk\"",
     "infinitely bright"},
    // shapes
    {"WorldBegin Shape \"spehre\"", "unknown shape 'spehre'; did you mean 'sphere'? (known: "},
    {"WorldBegin Shape \"sphere\" \"float radius\" 0", "'radius' is 0 but must be above 0"},
    {"WorldBegin Shape \"sphere\" \"float radius\" -1", "'radius' is -1 but must be above 0"},
    {"WorldBegin Shape \"sphere\" \"float zmin\" 2", "leave nothing of the sphere"},
    {"WorldBegin Shape \"sphere\" \"float phimax\" 0", "'phimax' is 0"},
    {"WorldBegin Shape \"disk\" \"float innerradius\" 1", "'innerradius' must be below 'radius'"},
    {"WorldBegin Shape \"trianglemesh\"", "\"point3 P\" is missing"},
    {"WorldBegin Shape \"trianglemesh\" \"point3 P\" []", "\"point3 P\" is missing"},
    {"WorldBegin Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0]",
     "\"integer indices\" is missing"},
    {"WorldBegin Shape \"trianglemesh\" \"point3 P\" [0 0]", "no multiple of 3"},
    {"WorldBegin Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1]",
     "'indices' has 2 values"},
    {"WorldBegin Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" []",
     "'indices' has 0 values"},
    {"WorldBegin Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n\"integer indices\" [0 1 "
     "3]",
     ":2: Shape 'trianglemesh': 'indices' has 3 at position 2"},
    {"WorldBegin Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 "
     "-1]",
     "'indices' has -1"},
    {"WorldBegin Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 inf 0]",
     "needs numbers, not 'inf'"},
    {"WorldBegin Scale 1e30 1 1 Shape \"trianglemesh\" \"point3 P\" [0 0 0 1e30 0 0 0 1 0]",
     "vertex 1 is not finite in world space"},
    {"WorldBegin Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]",
     "\"integer indices\" is missing"},
    {"WorldBegin Shape \"plymesh\"", "\"string filename\" is missing"},
    {"WorldBegin\nShape \"plymesh\" \"string filename\" \"none.ply\"",
     ":2: Shape 'plymesh': file 'none.ply' is not"},
};

}  // namespace

TEST_CASE("bad input: every bad text ends in an error that names what is wrong") {
  for (const BadText& row : kBadTexts) {
    INFO(std::string(row.text));
    CheckError(test::ReadText(row.text), row.error);
  }
}

TEST_CASE("bad input: files that cannot be read") {
  const test::TemporaryFolder folder;
  CheckError(ImportScene({}), "no scene file");
  CheckError(ImportScene({folder / "none.pbrt"}), "none.pbrt: does not exist");
  CheckError(ImportScene({folder / ""}), "is a directory");
  CheckError(ImportScene({folder.Write("empty.pbrt", "")}), "empty.pbrt: is empty");
  CheckError(ImportScene({folder.Write("scene.stl", "x")}), "unknown scene format '.stl'");
  CheckError(ImportScene({folder.Write("wide.pbrt", "\xFF\xFEW")}), "is UTF-16 text");
  CheckError(ImportScene({folder.Write("packed.pbrt", "\x1F\x8B\x08")}), "is cut short");
}

TEST_CASE("bad input: includes that are missing, cyclic, broken or too deep") {
  const test::TemporaryFolder folder;
  const auto read = [&](std::string_view text) {
    return ImportScene({folder.Write("scene.pbrt", text)});
  };
  CheckError(read("\nInclude \"none.pbrt\""), "scene.pbrt:2: Include: file 'none.pbrt' is not");
  CheckError(read("Include 5"), "the file's name in quotes is expected, not '5'");
  folder.Write("empty.pbrt", "");
  CheckError(read("Include \"empty.pbrt\""),
             "scene.pbrt:1: '" + folder / "empty.pbrt" + "' is empty");
  folder.Write("folder/x", "");
  CheckError(read("Include \"folder\""), "is a directory");
  folder.Write("b.pbrt", "WorldBegin\nInclude \"scene.pbrt\"");
  CheckError(read("Include \"b.pbrt\""),
             folder / "b.pbrt" + ":2: a file includes itself: " + folder / "scene.pbrt" + " -> " +
                 folder / "b.pbrt" + " -> ");
  CheckError(read("Include \"./scene.pbrt\""), "a file includes itself");
  folder.Write("bad.pbrt", "\n\nScale 0 0 0");
  CheckError(read("Include \"bad.pbrt\""), folder / "bad.pbrt" + ":3: a scale of 0");
  for (int i = 0; i < 100; ++i) {
    std::string name = std::to_string(i), next = std::to_string(i + 1);
    folder.Write(name.append(".pbrt"), "Include \"" + next + ".pbrt\"\n");
  }
  CheckError(read("Include \"0.pbrt\""), "included more than 64 deep");
  for (int i = 0; i < 20; ++i) {
    const std::string next = "Include \"" + std::to_string(i + 1) + ".pbrt\"\n";
    folder.Write(std::to_string(i) + ".pbrt", next + next);
  }
  folder.Write("20.pbrt", "# the end");
  CheckError(read("Include \"0.pbrt\""), "more than 32768 files are included");
}

TEST_CASE("bad input: attributes nested beyond the limit") {
  std::string text = "WorldBegin\n";
  for (int i = 0; i < 5000; ++i) text += "AttributeBegin\n";
  CheckError(test::ReadText(text), "nested more than 4096 deep");
}

TEST_CASE("bad input: a bad PLY names the directive and the mesh") {
  const test::TemporaryFolder folder;
  folder.Write("m.ply", "ply\nformat ascii 1.0\nelement vertex 9\n");
  CheckError(ImportScene({folder.Write(
                 "scene.pbrt", "WorldBegin\nShape \"plymesh\" \"string filename\" \"m.ply\"")}),
             "scene.pbrt:2: Shape 'plymesh': " + folder / "m.ply" + ": the header has no");
}

TEST_CASE("bad input: every truncation of a good scene is read or refused, never a crash") {
  const std::string good =
      "LookAt 0 0 -5 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" [45]\n"
      "WorldBegin LightSource \"infinite\" \"rgb L\" [1 1 1] AttributeBegin\n"
      "Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5] AttributeEnd Shape \"sphere\"";
  CHECK(test::ReadText(good));
  for (size_t size = 0; size < good.size(); ++size) {
    const Result<Scene> scene = test::ReadText(good.substr(0, size));
    INFO(size);
    if (!scene) CHECK(scene.error().message.find("scene") != std::string::npos);
  }
}

}  // namespace swell
