// Reads images by OpenImageIO and picks their channels.
#include "src/import/read_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>

#include "src/base/available_memory.h"
#include "src/base/text.h"
#include "src/import/read_meter.h"

namespace swell {
namespace {

// Files that claim more are doubted if they unpack to more than so many times their size: deflate
// reaches 1032 at most.
constexpr uint64_t kUnquestionedBytes = uint64_t{16} << 20;
constexpr uint64_t kMaxExpansion = 2048;

// Places of red, green, blue (or of grey thrice) and alpha among a file's channels; -1: no alpha.
struct Channels {
  int color[3] = {0, 0, 0};
  int alpha = -1;
  bool grey = true;
};

Channels FindChannels(const OIIO::ImageSpec& spec) {
  Channels found;
  const auto place = [&](const char* name) {
    const auto at = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
    return at == spec.channelnames.end() ? -1 : static_cast<int>(at - spec.channelnames.begin());
  };
  const int r = place("R"), g = place("G"), b = place("B");
  found.alpha = spec.alpha_channel >= 0 ? spec.alpha_channel : place("A");
  if (r >= 0 && g >= 0 && b >= 0) {
    found.color[0] = r, found.color[1] = g, found.color[2] = b;
    found.grey = false;
  } else if (spec.nchannels >= 3) {
    found.color[1] = 1, found.color[2] = 2;
    found.grey = false;
  } else {
    found.color[0] = found.color[1] = found.color[2] = std::max(0, place("Y"));
  }
  return found;
}

// The values of a file, `channels` of them for each pixel: codes of 8 bits, or floats.
struct FileValues {
  size_t channels = 0;
  bool codes = false;
  bool encoded = false;  // the floats stand for wider codes
  std::vector<uint8_t> bytes;
  std::vector<float> floats;

  float Value(size_t pixel, int channel, const Encoding& encoding) const {
    const size_t i = pixel * channels + static_cast<size_t>(channel);
    if (codes) return encoding.Decode(bytes[i] / 255.0);
    return encoded ? encoding.Decode(floats[i]) : floats[i];
  }
  // Alpha is never encoded.
  float Alpha(size_t pixel, int channel) const {
    const size_t i = pixel * channels + static_cast<size_t>(channel);
    return codes ? static_cast<float>(bytes[i] / 255.0) : floats[i];
  }
};

Status ReadValues(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, FileValues* values) {
  values->channels = static_cast<size_t>(spec.nchannels);
  const size_t count = static_cast<size_t>(spec.image_pixels()) * values->channels;
  values->codes = spec.format == OIIO::TypeUInt8;
  values->encoded = !values->codes && !spec.format.is_floating_point();
  bool read = false;
  if (values->codes) {
    values->bytes.resize(count);
    read = input.read_image(0, 0, 0, -1, OIIO::TypeUInt8, values->bytes.data());
  } else {
    values->floats.resize(count);
    read = input.read_image(0, 0, 0, -1, OIIO::TypeFloat, values->floats.data());
  }
  if (!read) return Error{"cannot be read: " + FirstLine(input.geterror())};
  return Done{};
}

float Finite(float value, uint64_t* not_finite) {
  if (std::isfinite(value)) return value;
  ++*not_finite;
  return 0.0f;
}

// The file's channels of these numbers, decoded as `encoding` says.
void TakeChannels(const FileValues& values, const int* channels, uint32_t count,
                  const Encoding& encoding, ReadPixels* out) {
  Pixels& pixels = out->pixels;
  pixels.channels = count;
  const size_t total = size_t{pixels.width} * pixels.height;
  if (values.codes) pixels.codes.reserve(total * count);
  if (!values.codes) pixels.values.reserve(total * count);
  for (size_t i = 0; i < total; ++i) {
    for (uint32_t c = 0; c < count; ++c) {
      const size_t at = i * values.channels + static_cast<size_t>(channels[c]);
      if (values.codes) {
        pixels.codes.push_back(values.bytes[at]);
      } else {
        const float value = values.Value(i, channels[c], encoding);
        pixels.values.push_back(std::max(0.0f, Finite(value, &out->not_finite)));
      }
    }
  }
}

void TakeColors(const FileValues& values, const Channels& channels, const Encoding& encoding,
                ReadPixels* out) {
  TakeChannels(values, channels.color, channels.grey ? 1 : 3, encoding, out);
}

void TakeAlpha(const FileValues& values, const Channels& channels, ReadPixels* out) {
  Encoding linear;
  linear.curve = Encoding::Curve::kLinear;
  for (size_t code = 0; code < 256; ++code) {
    out->pixels.decode[code] = linear.Decode(static_cast<double>(code) / 255.0);
  }
  if (channels.alpha >= 0) return TakeChannels(values, &channels.alpha, 1, linear, out);
  out->pixels.channels = 1;
  out->pixels.format = TexelFormat::kByte;
  out->pixels.codes.assign(out->pixels.size(), 255);
}

void TakeScalars(const FileValues& values, const Channels& channels, const Encoding& encoding,
                 ReadPixels* out) {
  Pixels& pixels = out->pixels;
  pixels.channels = 1;
  const size_t count = size_t{pixels.width} * pixels.height;
  bool holes = false;
  for (size_t i = 0; i < count && channels.alpha >= 0 && !holes; ++i) {
    holes = values.Alpha(i, channels.alpha) != 1.0f;
  }
  if (values.codes && channels.grey && !holes) return TakeColors(values, channels, encoding, out);
  if (values.codes) pixels.format = TexelFormat::kFloat;
  pixels.values.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    float value = 0.0f;
    if (holes) {
      value = values.Alpha(i, channels.alpha);
    } else {
      for (int channel : channels.color) value += values.Value(i, channel, encoding) / 3.0f;
    }
    pixels.values.push_back(Finite(value, &out->not_finite));
  }
}

Status CheckSize(const OIIO::ImageSpec& spec, uint64_t file_bytes) {
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 || spec.depth > 1) {
    return Error{"holds no flat picture"};
  }
  const auto most = static_cast<int>(kMaxImageSide);
  if (spec.width > most || spec.height > most) {
    return Error{"has " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                 " pixels; at most " + std::to_string(most) + " a side are supported"};
  }
  const uint64_t pixels = spec.image_pixels();
  // The file's values, the chosen ones, and texels with their smaller levels.
  const uint64_t bytes = pixels * (static_cast<uint64_t>(spec.nchannels) + 8) * sizeof(float);
  if (bytes > AvailableMemory() || pixels > (uint64_t{1} << 29)) {
    return Error{"needs " + BytesForPeople(bytes) + " of memory; make it smaller"};
  }
  const uint64_t unpacked = spec.image_bytes(/*native=*/true);
  if (unpacked > kUnquestionedBytes && unpacked / kMaxExpansion > file_bytes) {
    return Error{"claims " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                 " pixels but has only " + BytesForPeople(file_bytes) + "; it may be cut off"};
  }
  return Done{};
}

ReadPixels Take(const FileValues& values, const OIIO::ImageSpec& spec, const Channels& channels,
                const ImagePick& pick) {
  ReadPixels out;
  out.pixels.width = static_cast<uint32_t>(spec.width);
  out.pixels.height = static_cast<uint32_t>(spec.height);
  out.pixels.format = values.codes                    ? TexelFormat::kByte
                      : spec.format == OIIO::TypeHalf ? TexelFormat::kHalf
                                                      : TexelFormat::kFloat;
  for (size_t code = 0; code < 256; ++code) {
    out.pixels.decode[code] = pick.encoding.Decode(static_cast<double>(code) / 255.0);
  }
  switch (pick.use) {
    case ImageUse::kColor:
      TakeColors(values, channels, pick.encoding, &out);
      break;
    case ImageUse::kScalar:
      TakeScalars(values, channels, pick.encoding, &out);
      break;
    case ImageUse::kAlpha:
      TakeAlpha(values, channels, &out);
      break;
    default:
      TakeChannels(values,
                   &channels.color[static_cast<int>(pick.use) - static_cast<int>(ImageUse::kRed)],
                   1, pick.encoding, &out);
  }
  return out;
}

// OpenImageIO unpacks a BMP of run lengths as it opens it, so its size must be checked before.
Status CheckPackedBmp(const std::string& path, uint64_t file_bytes) {
  std::array<unsigned char, 34> head{};
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(head.data()), head.size())) return Done{};
  const auto number = [&](size_t at) {
    int32_t value;
    std::memcpy(&value, &head[at], sizeof(value));
    return static_cast<int>(std::min<int64_t>(std::abs(int64_t{value}), 0x7FFFFFFF));
  };
  const bool has_compression = head[0] == 'B' && head[1] == 'M' && number(14) >= 40;
  if (!has_compression || (number(30) != 1 && number(30) != 2)) return Done{};
  if (head[28] != (number(30) == 1 ? 8 : 4)) return Error{"is no BMP: run lengths of such pixels"};
  return CheckSize(OIIO::ImageSpec(number(18), number(22), 1, OIIO::TypeUInt8), file_bytes);
}

// A name by which OpenImageIO finds the format of encoded bytes; "" for others.
std::string NameOfFormat(std::string_view bytes) {
  if (bytes.substr(0, 4) == "\x89PNG") return "embedded.png";
  if (bytes.substr(0, 3) == "\xFF\xD8\xFF") return "embedded.jpg";
  if (bytes.substr(0, 4) == "RIFF" && bytes.substr(8, 4) == "WEBP") return "embedded.webp";
  return "";
}

Result<std::vector<ReadPixels>> Read(const ImageSource& source,
                                     const std::vector<ImagePick>& picks) {
  const bool embedded = source.bytes.data() != nullptr;
  const std::string name = embedded ? NameOfFormat(source.bytes) : source.name;
  if (name.empty()) return Error{"is neither PNG nor JPEG nor WebP"};
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;  // colours as they stand in the file
  OIIO::Filesystem::IOMemReader memory(const_cast<char*>(source.bytes.data()), source.bytes.size());
  void* proxy = &memory;
  if (embedded) config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  std::error_code ignored;
  const uint64_t file_bytes =
      embedded ? source.bytes.size() : std::filesystem::file_size(name, ignored);
  if (!embedded) {
    if (Status fits = CheckPackedBmp(name, file_bytes); !fits) return fits.error();
  }
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(name, &config);
  if (!input) return Error{"cannot be read: " + FirstLine(OIIO::geterror())};
  const OIIO::ImageSpec spec = input->spec();
  if (Status fits = CheckSize(spec, file_bytes); !fits) return fits.error();
  const MeteredRead meter(file_bytes);
  const Channels channels = FindChannels(spec);
  FileValues values;
  if (Status read = ReadValues(*input, spec, &values); !read) return read.error();
  std::vector<ReadPixels> taken;
  for (const ImagePick& pick : picks) taken.push_back(Take(values, spec, channels, pick));
  return taken;
}

}  // namespace

float Encoding::Decode(double code) const {
  switch (curve) {
    case Curve::kLinear:
      return static_cast<float>(code);
    case Curve::kGamma:
      return static_cast<float>(std::pow(code, gamma));
    case Curve::kSrgb:
      break;
  }
  return static_cast<float>(code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4));
}

Result<std::vector<ReadPixels>> ReadImagePicks(const ImageSource& source,
                                               const std::vector<ImagePick>& picks) {
  try {
    Result<std::vector<ReadPixels>> read = Read(source, picks);
    if (!read) return Error{source.name + ": " + read.error().message};
    return read;
  } catch (const std::exception& exception) {  // memory, or what a codec throws
    return Error{source.name + ": cannot be read: " + FirstLine(exception.what())};
  }
}

Result<ReadPixels> ReadImagePixels(const std::string& path, ImageUse use,
                                   const Encoding& encoding) {
  Result<std::vector<ReadPixels>> read = ReadImagePicks({path, {}}, {{use, encoding}});
  if (!read) return read.error();
  return std::move((*read)[0]);
}

}  // namespace swell
