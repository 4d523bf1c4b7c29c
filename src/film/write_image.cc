// Images in, the bytes of EXR and PNG files out, and back.
#include "src/film/write_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <new>
#include <exception>

#include "src/base/available_memory.h"
#include "src/base/check.h"
#include "src/base/new_file.h"
#include "src/base/text.h"

namespace swell {
namespace {

// Rec. ITU-R BT.709 primaries and D65 white: x, y of red, green, blue and white.
constexpr float kRec709[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};

// Lets OpenImageIO write into a NewFile. Failures are kept there until Commit, as the codecs differ
// in what they make of a failed write.
class NewFileProxy final : public OIIO::Filesystem::IOProxy {
 public:
  explicit NewFileProxy(NewFile& file) : IOProxy("", Write), file_(file) {}

  const char* proxytype() const override { return "new_file"; }
  int64_t tell() override { return file_.position(); }
  bool seek(int64_t offset) override {
    file_.Seek(offset);
    return true;
  }
  size_t write(const void* bytes, size_t count) override {
    file_.Write(bytes, count);
    return count;
  }
  size_t pwrite(const void* bytes, size_t count, int64_t offset) override {
    const int64_t before = file_.position();
    file_.Seek(offset);
    file_.Write(bytes, count);
    file_.Seek(before);
    return count;
  }
  size_t size() const override { return static_cast<size_t>(file_.size()); }

 private:
  NewFile& file_;
};

enum class Format { kUnknown, kExr, kPng };

Format FormatOf(const std::string& path) {
  if (path.size() < 4) return Format::kUnknown;
  const std::string ending = LowerCase(path.substr(path.size() - 4));
  return ending == ".exr" ? Format::kExr : ending == ".png" ? Format::kPng : Format::kUnknown;
}

Error UnknownEnding(const std::string& path) {
  return Error{path + ": cannot be written: its ending names no known format; use .exr or .png"};
}

OIIO::ImageSpec ExrSpec(const Image& image, const ImageMetadata& metadata) {
  OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), 3,
                       OIIO::TypeFloat);
  spec.channelnames = {"R", "G", "B"};
  if (metadata.frame_width != 0) {
    SWELL_CHECK(metadata.crop.width() == image.width && metadata.crop.height() == image.height);
    spec.x = static_cast<int>(metadata.crop.x0);
    spec.y = static_cast<int>(metadata.crop.y0);
    spec.full_width = static_cast<int>(metadata.frame_width);
    spec.full_height = static_cast<int>(metadata.frame_height);
  }
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), kRec709);
  spec.attribute("DateTime", "");  // else OpenImageIO puts the clock into the header
  for (const auto& [name, value] : metadata.strings) spec.attribute(name, value);
  return spec;
}

OIIO::ImageSpec PngSpec(const Image& image) {
  OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), 3,
                       OIIO::TypeUInt8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  return spec;
}

Status Encode(const std::string& path, const Image& image, const ImageMetadata& metadata,
              NewFile& file) {
  const bool is_exr = FormatOf(path) == Format::kExr;
  const std::unique_ptr<OIIO::ImageOutput> output =
      OIIO::ImageOutput::create(is_exr ? "exr" : "png");
  if (!output) return Error{path + ": " + FirstLine(OIIO::geterror())};
  NewFileProxy proxy(file);
  OIIO::Filesystem::IOProxy* proxy_pointer = &proxy;
  OIIO::ImageSpec spec = is_exr ? ExrSpec(image, metadata) : PngSpec(image);
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy_pointer);

  std::vector<uint8_t> codes;
  const void* values = image.rgb.data();
  if (!is_exr) {
    codes.resize(image.rgb.size());
    std::transform(image.rgb.begin(), image.rgb.end(), codes.begin(), EncodeSrgb);
    values = codes.data();
  }
  if (!output->open(path, spec) || !output->write_image(spec.format, values) || !output->close()) {
    return Error{path + ": " + FirstLine(output->geterror())};
  }
  return Done{};
}

// Element k is the least linear value whose code is k + 1: there the curve crosses (k + 0.5) / 255.
// No float is nearer to one of these than 1e-12 of it, so the rounding of pow cannot change a code.
std::array<double, 255> CodeThresholds() {
  std::array<double, 255> thresholds;
  for (size_t k = 0; k < thresholds.size(); ++k) {
    const double encoded = (static_cast<double>(k) + 0.5) / 255;
    thresholds[k] = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
  }
  return thresholds;
}

}  // namespace

Status CheckOutput(const std::string& path) {
  if (FormatOf(path) == Format::kUnknown) return UnknownEnding(path);
  const Result<NewFile> file = NewFile::Open(path);
  if (!file) return file.error();
  return Done{};
}

Status WriteImage(const std::string& path, const Image& image, const ImageMetadata& metadata) {
  SWELL_CHECK(image.rgb.size() == size_t{3} * image.width * image.height);
  SWELL_CHECK(!image.rgb.empty());
  if (FormatOf(path) == Format::kUnknown) return UnknownEnding(path);
  Result<NewFile> file = NewFile::Open(path);
  if (!file) return file.error();
  try {
    const Status encoded = Encode(path, image, metadata, *file);
    if (!encoded) return encoded;
  } catch (const std::exception& exception) {  // memory, or what a codec throws
    return Error{path + ": cannot be written: " + FirstLine(exception.what())};
  }
  return file->Commit();
}

Result<Image> ReadImage(const std::string& path) {
  try {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
    if (!input) return Error{path + ": cannot be read: " + FirstLine(OIIO::geterror())};
    const OIIO::ImageSpec& spec = input->spec();
    const uint64_t value_count = spec.image_pixels() * static_cast<uint64_t>(spec.nchannels);
    if (value_count == 0) return Error{path + ": has no pixels"};
    const uint64_t bytes = (value_count + spec.image_pixels() * 3) * sizeof(float);
    if (bytes > AvailableMemory()) {
      return Error{path + ": cannot be read: needs " + BytesForPeople(bytes) + " of memory"};
    }
    std::vector<float> values(value_count);
    if (!input->read_image(0, 0, 0, -1, OIIO::TypeFloat, values.data())) {
      return Error{path + ": cannot be read: " + FirstLine(input->geterror())};
    }

    Image image{static_cast<uint32_t>(spec.width), static_cast<uint32_t>(spec.height), {}};
    const size_t channels = static_cast<size_t>(spec.nchannels);
    image.rgb.resize(size_t{3} * image.width * image.height);
    for (size_t i = 0; i < image.rgb.size(); ++i) {
      image.rgb[i] = values[i / 3 * channels + (channels < 3 ? 0 : i % 3)];
    }
    return image;
  } catch (const std::exception& exception) {
    return Error{path + ": cannot be read: " + FirstLine(exception.what())};
  }
}

uint8_t EncodeSrgb(float linear) {
  static const std::array<double, 255> thresholds = CodeThresholds();
  if (!(linear > 0)) return 0;
  const auto above = std::upper_bound(thresholds.begin(), thresholds.end(), double{linear});
  return static_cast<uint8_t>(above - thresholds.begin());
}

}  // namespace swell
