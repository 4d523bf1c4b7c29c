// Directives of transforms -> the map from the current space to the world (to the camera before
// WorldBegin).
#include "src/import/pbrt_directives.h"

#include <array>

#include "src/base/suggest.h"

namespace swell {

template <size_t N> std::array<double, N> PbrtReader::Numbers() {
  std::array<double, N> numbers{};
  for (size_t i = 0; i < N && !failed(); ++i) {
    numbers[i] = ParseDouble(tokens_.Next(), &diagnostics_);
  }
  return numbers;
}

// 16 numbers in brackets, column by column as pbrt writes them.
swell::Transform PbrtReader::Matrix(Place place) {
  const bool open = tokens_.Next().kind == TokenKind::kOpen;
  if (!open) Fail(place, "16 numbers in [ ] are expected");
  const std::array<double, 16> columns = Numbers<16>();
  if (!failed() && tokens_.Next().kind != TokenKind::kClose) {
    Fail(place, "16 numbers in [ ] are expected");
  }
  swell::Transform matrix;
  for (size_t row = 0; row < 3; ++row) {
    for (size_t col = 0; col < 4; ++col) {
      matrix.m[4 * row + col] = columns[4 * col + row] / columns[15];
    }
  }
  const bool affine = columns[3] == 0.0 && columns[7] == 0.0 && columns[11] == 0.0;
  if (!failed() && (!affine || columns[15] == 0.0)) {
    Fail(place, "the matrix is not affine; its 4th, 8th and 12th numbers must be 0, its last 1");
  }
  if (!failed() && !Inverse(matrix))
    Fail(place, "the matrix is singular; it flattens what it maps");
  return matrix;
}

void PbrtReader::Translate(Place) {
  const auto v = Numbers<3>();
  Concat(swell::Translate(v[0], v[1], v[2]));
}

void PbrtReader::Scale(Place place) {
  const auto v = Numbers<3>();
  if (!failed() && (v[0] == 0.0 || v[1] == 0.0 || v[2] == 0.0)) {
    return Fail(place, "a scale of 0 makes the transform singular");
  }
  Concat(swell::Scale(v[0], v[1], v[2]));
}

void PbrtReader::Rotate(Place place) {
  const auto v = Numbers<4>();
  if (failed()) return;
  if (v[1] == 0.0 && v[2] == 0.0 && v[3] == 0.0) return Fail(place, "the axis of Rotate is zero");
  Concat(swell::Rotate(v[0], {v[1], v[2], v[3]}));
}

void PbrtReader::LookAt(Place place) {
  const auto v = Numbers<9>();
  if (failed()) return;
  const auto look_at = swell::LookAt({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]});
  if (!look_at) {
    return Fail(place,
                "LookAt: the eye and the target are the same point, or \"up\" is zero or "
                "points along the view");
  }
  Concat(*look_at);
}

void PbrtReader::TransformMatrix(Place place) { Set(Matrix(place)); }
void PbrtReader::ConcatTransform(Place place) { Concat(Matrix(place)); }

void PbrtReader::CoordinateSystem(Place) {
  systems_[Text("the coordinate system's name")] = state_.to_world;
}

void PbrtReader::CoordSysTransform(Place place) {
  const std::string name = Text("the coordinate system's name");
  const auto found = systems_.find(name);
  if (found != systems_.end()) return Set(found->second);
  std::vector<std::string_view> names;
  for (const auto& [known, transform] : systems_) names.push_back(known);
  Fail(place, "unknown coordinate system " + Quote(name) + DidYouMean(name, names));
}

void PbrtReader::ActiveTransform(Place place) {
  const std::string_view which = tokens_.Next().text;
  if (which != "All" && which != "StartTime" && which != "EndTime") {
    return Fail(place, "ActiveTransform is All, StartTime or EndTime, not " + Quote(which));
  }
  if (which == "EndTime") {
    Warn(place, "motion is not supported; the scene stands still at its start time");
  }
  state_.transform_applies = which != "EndTime";
}

void PbrtReader::TransformTimes(Place) { Numbers<2>(); }

}  // namespace swell
