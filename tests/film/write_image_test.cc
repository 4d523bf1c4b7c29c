// Images, good and bad paths, full disks in; claims about the files that are left out.
#include "src/film/write_image.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <thread>

#include "tests/support/compare_images.h"
#include "tests/support/error_lines.h"
#include "tests/support/temporary_folder.h"

namespace swell::test {
namespace {

namespace fs = std::filesystem;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Finite floats of every magnitude: incompressible, so that files are about as large as the pixels.
Image RandomImage(uint32_t width, uint32_t height, uint32_t seed = 1) {
  std::mt19937 random(seed);
  Image image{width, height, std::vector<float>(size_t{3} * width * height)};
  for (float& value : image.rgb) {
    do {
      value = std::bit_cast<float>(static_cast<uint32_t>(random()));
    } while (!std::isfinite(value));
  }
  return image;
}

TEST_CASE("WriteImage: an EXR gives every float back to the bit") {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1u, 1u}, {17u, 5u}, {64u, 100u}}) {
    const Image image = RandomImage(width, height);
    REQUIRE(WriteImage(folder / "a.exr", image, {}));
    const Result<Image> read = ReadImage(folder / "a.exr");
    REQUIRE(read);
    CHECK(SameBits(*read, image));
  }
  CHECK(folder.Entries() == std::vector<std::string>{"a.exr"});
}

TEST_CASE("WriteImage: an EXR keeps windows, metadata and colour space") {
  const TemporaryFolder folder;
  ImageMetadata metadata;
  metadata.frame_width = 200;
  metadata.frame_height = 100;
  metadata.crop = {30, 40, 50, 47};
  metadata.strings = {
      {"swell:scene", "a b.pbrt"}, {"swell:seed", "7"}, {"swell:note", "1 < 2\n\"x\""}};
  const Image image = RandomImage(20, 7);
  REQUIRE(WriteImage(folder / "crop.EXR", image, metadata));

  const auto input = OIIO::ImageInput::open(folder / "crop.EXR");
  REQUIRE(input);
  const OIIO::ImageSpec& spec = input->spec();
  CHECK(std::string(input->format_name()) == "openexr");
  CHECK(spec.x == 30);
  CHECK(spec.y == 40);
  CHECK(spec.width == 20);
  CHECK(spec.height == 7);
  CHECK(spec.full_x == 0);
  CHECK(spec.full_y == 0);
  CHECK(spec.full_width == 200);
  CHECK(spec.full_height == 100);
  CHECK(spec.format == OIIO::TypeFloat);
  CHECK(spec.channelnames == std::vector<std::string>{"R", "G", "B"});
  CHECK(spec.get_string_attribute("compression") == "zip");
  for (const auto& [name, value] : metadata.strings) {
    CHECK(spec.get_string_attribute(name) == value);
  }
  const OIIO::ParamValue* chromaticities = spec.find_attribute("chromaticities");
  REQUIRE(chromaticities != nullptr);
  REQUIRE(chromaticities->type().basevalues() == 8);
  const float rec709[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
  for (int i = 0; i < 8; ++i) CHECK(chromaticities->get_float_indexed(i) == rec709[i]);

  const Result<Image> read = ReadImage(folder / "crop.EXR");
  REQUIRE(read);
  CHECK(SameBits(*read, image));
}

TEST_CASE("WriteImage: the same image gives the same bytes at another time") {
  const TemporaryFolder folder;
  const Image image = RandomImage(40, 30);
  const ImageMetadata metadata = {{{"swell:seed", "1"}}, 100, 100, {1, 2, 41, 32}};
  for (const char* name : {"a.exr", "a.png"}) {
    REQUIRE(WriteImage(folder / name, image, metadata));
    const auto input = OIIO::ImageInput::open(folder / name);
    REQUIRE(input);
    CHECK(input->spec().get_string_attribute("DateTime") == "");
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // clocks in files count seconds
  for (const char* name : {"a.exr", "a.png"}) {
    const std::string other = folder / (std::string("b") + name);
    REQUIRE(WriteImage(other, image, metadata));
    CHECK(Contents(folder / name).size() > 500);
    CHECK(Contents(folder / name) == Contents(other));
  }
}

TEST_CASE("WriteImage: a PNG holds the crop in 8-bit sRGB codes") {
  const TemporaryFolder folder;
  Image image{4, 2, {}};
  std::vector<uint8_t> expected;
  const std::pair<float, uint8_t> codes[] = {
      {0.0f, 0},   {1.0f, 255}, {0.5f, 188}, {0.18f, 118},     {0.25f, 137},    {0.01f, 25},
      {0.001f, 3}, {-1.0f, 0},  {7.0f, 255}, {kInfinity, 255}, {-kInfinity, 0}, {std::nanf(""), 0},
  };
  for (size_t i = 0; i < 24; ++i) {
    image.rgb.push_back(codes[i % std::size(codes)].first);
    expected.push_back(codes[i % std::size(codes)].second);
  }
  REQUIRE(WriteImage(folder / "a.png", image, {{}, 100, 100, {10, 20, 14, 22}}));

  const auto input = OIIO::ImageInput::open(folder / "a.png");
  REQUIRE(input);
  const OIIO::ImageSpec& spec = input->spec();
  CHECK(spec.width == 4);
  CHECK(spec.height == 2);
  CHECK(spec.x == 0);
  CHECK(spec.y == 0);
  CHECK(spec.nchannels == 3);
  CHECK(spec.format == OIIO::TypeUInt8);
  CHECK(spec.get_string_attribute("oiio:ColorSpace") == "sRGB");
  std::vector<uint8_t> read(24);
  REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeUInt8, read.data()));
  CHECK(read == expected);
}

// The curve of IEC 61966-2-1 with more precision than the program uses.
long double SrgbCurve(long double linear) {
  return linear <= 0.0031308L ? 12.92L * linear : 1.055L * std::pow(linear, 1 / 2.4L) - 0.055L;
}

TEST_CASE("EncodeSrgb: every code is the rounded curve") {
  std::mt19937 random(1);
  for (int i = 0; i < 300000; ++i) {
    const float linear =
        i % 2 == 0 ? float(random()) / 4294967296.0f
                   : std::ldexp(1.0f, -int(random() % 20)) * float(random() % 4096) / 4096;
    const auto expected =
        static_cast<int>(std::floor(255 * SrgbCurve(std::min(linear, 1.0f)) + 0.5L));
    REQUIRE(int(EncodeSrgb(linear)) == expected);
  }
}

TEST_CASE("EncodeSrgb: no float is so near to a change of code that rounding could matter") {
  for (int code = 1; code < 256; ++code) {
    const long double encoded = (code - 0.5L) / 255;
    const long double threshold =
        encoded <= 0.04045L ? encoded / 12.92L : std::pow((encoded + 0.055L) / 1.055L, 2.4L);
    float above = static_cast<float>(threshold);
    if (above < threshold) above = std::nextafter(above, kInfinity);
    const float below = std::nextafter(above, 0.0f);
    CAPTURE(code);
    CHECK(int(EncodeSrgb(above)) == code);
    CHECK(int(EncodeSrgb(below)) == code - 1);
    CHECK((above - threshold) / threshold > 1e-12L);
    CHECK((threshold - below) / threshold > 1e-12L);
  }
}

TEST_CASE("EncodeSrgb: 8-bit codes survive decoding and encoding") {
  for (int code = 0; code < 256; ++code) {
    const double encoded = code / 255.0;
    const double linear =
        encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    CHECK(int(EncodeSrgb(static_cast<float>(linear))) == code);
  }
}

TEST_CASE("CheckOutput: a good path stays untouched") {
  const TemporaryFolder folder;
  CHECK(CheckOutput(folder / "new.exr"));
  CHECK(CheckOutput(folder / "new.png"));
  CHECK(folder.Entries().empty());
  std::ofstream(folder / "old.png") << "old";
  CHECK(CheckOutput(folder / "old.png"));
  CHECK(Contents(folder / "old.png") == "old");
  CHECK(folder.Entries().size() == 1);
}

TEST_CASE("CheckOutput, WriteImage: a path that cannot be written is one line and leaves nothing") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "folder.exr");
  std::ofstream(folder / "file") << "x";
  fs::create_symlink(folder / "nowhere.exr", folder / "dangling.exr");
  REQUIRE(mkfifo((folder / "pipe.png").c_str(), 0600) == 0);
  fs::create_symlink("/dev/full", folder / "full.exr");
  const std::vector<std::string> entries = folder.Entries();

  const struct {
    std::string path;
    const char* reason;
  } cases[] = {
      {folder / "a.jpg", "use .exr or .png"},
      {folder / "a", "use .exr or .png"},
      {folder / "exr", "use .exr or .png"},
      {"", "use .exr or .png"},
      {folder / "missing/a.exr", "there is no folder"},
      {folder / "file/a.exr", "is not a folder"},
      {folder / "folder.exr", "is a folder"},
      {folder / "dangling.exr", "symbolic link to nothing"},
      {folder / "pipe.png", "is not a regular file"},
      {folder / "full.exr", "is not a regular file"},
      {folder / (std::string(300, 'n') + ".exr"), "File name too long"},
      {"/proc/a.exr", "cannot be written"},
  };
  for (const auto& c : cases) {
    const std::string& path = c.path;
    CAPTURE(path);
    const Status check = CheckOutput(path);
    REQUIRE_FALSE(check);
    CheckIsLineAbout(check.error(), path);
    CHECK(check.error().message.find(c.reason) != std::string::npos);
    const Status write = WriteImage(path, RandomImage(8, 8), {});
    REQUIRE_FALSE(write);
    CHECK(write.error().message == check.error().message);
  }
  CHECK(folder.Entries() == entries);
}

// Permissions do not bind the superuser, so while this lives the process is somebody else.
class NotSuperuser {
 public:
  NotSuperuser() {
    if (geteuid() == 0) is_changed_ = seteuid(65534) == 0;
  }
  ~NotSuperuser() {
    if (is_changed_) SWELL_CHECK(seteuid(0) == 0);
  }

 private:
  bool is_changed_ = false;
};

TEST_CASE("CheckOutput, WriteImage: permissions are respected") {
  const TemporaryFolder folder;
  REQUIRE(chmod(folder.path().c_str(), 0777) == 0);
  fs::create_directory(folder / "closed");
  std::ofstream(folder / "read_only.exr") << "old";
  REQUIRE(chmod((folder / "closed").c_str(), 0555) == 0);
  REQUIRE(chmod((folder / "read_only.exr").c_str(), 0444) == 0);
  {
    const NotSuperuser user;
    for (const std::string& path : {folder / "closed/a.exr", folder / "read_only.exr"}) {
      CAPTURE(path);
      const Status check = CheckOutput(path);
      REQUIRE_FALSE(check);
      CheckIsLineAbout(check.error(), path);
      CHECK(check.error().message.find("Permission denied") != std::string::npos);
      CHECK_FALSE(WriteImage(path, RandomImage(8, 8), {}));
    }
    CHECK(CheckOutput(folder / "mine.exr"));
  }
  CHECK(Contents(folder / "read_only.exr") == "old");
  CHECK(fs::is_empty(folder / "closed"));
  REQUIRE(chmod((folder / "closed").c_str(), 0755) == 0);
}

TEST_CASE("WriteImage: a file replaces an old one, and through a link what it points to") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "far");
  const Image first = RandomImage(9, 9, 1), second = RandomImage(9, 9, 2);
  REQUIRE(WriteImage(folder / "far/a.exr", first, {}));
  fs::create_symlink("far/a.exr", folder / "link.exr");
  REQUIRE(WriteImage(folder / "link.exr", second, {}));
  CHECK(fs::is_symlink(folder / "link.exr"));
  const Result<Image> read = ReadImage(folder / "far/a.exr");
  REQUIRE(read);
  CHECK(SameBits(*read, second));
  CHECK(std::distance(fs::directory_iterator(folder / "far"), {}) == 1);
}

// Lets no file of this process grow beyond `bytes`: what a full disk does, on any machine.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(size_t bytes) {
    old_handler_ = signal(SIGXFSZ, SIG_IGN);
    SWELL_CHECK(getrlimit(RLIMIT_FSIZE, &old_) == 0);
    const rlimit limit = {bytes, old_.rlim_max};
    SWELL_CHECK(setrlimit(RLIMIT_FSIZE, &limit) == 0);
  }
  ~FileSizeLimit() {
    SWELL_CHECK(setrlimit(RLIMIT_FSIZE, &old_) == 0);
    signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_;
  void (*old_handler_)(int);
};

TEST_CASE("WriteImage: a disk that fills up at any byte is an error and changes nothing") {
  const TemporaryFolder folder;
  const Image image = RandomImage(50, 40);
  for (const char* name : {"a.exr", "a.png"}) {
    CAPTURE(name);
    const std::string path = folder / name;
    REQUIRE(WriteImage(path, image, {}));
    const std::string whole = Contents(path);
    REQUIRE(whole.size() > 1000);
    fs::remove(path);

    const size_t size = whole.size();
    for (bool has_old : {false, true}) {
      if (has_old) std::ofstream(path) << "old";
      // The last ones fail only when buffers are flushed.
      for (size_t limit :
           {size_t{0}, size_t{1}, size_t{100}, size / 3, size / 2, size - 500, size - 1}) {
        CAPTURE(limit);
        Status status = Done{};
        {
          const FileSizeLimit full(limit);
          status = WriteImage(path, image, {});
        }
        REQUIRE_FALSE(status);
        CheckIsLineAbout(status.error(), path);
        CHECK(status.error().message.find("File too large; free some space") != std::string::npos);
        CHECK(folder.Entries().size() == (has_old ? 1 : 0));
        if (has_old) CHECK(Contents(path) == "old");
      }
    }
    {
      const FileSizeLimit enough(size);
      CHECK(WriteImage(path, image, {}));
    }
    CHECK(Contents(path) == whole);
    fs::remove(path);
  }
}

TEST_CASE("WriteImage: a new file has the permissions that the user's mask leaves") {
  const TemporaryFolder folder;
  const mode_t before = umask(027);
  REQUIRE(WriteImage(folder / "a.png", RandomImage(2, 2), {}));
  umask(before);
  struct stat status;
  REQUIRE(stat((folder / "a.png").c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0640);
}

TEST_CASE("ReadImage: what is no image is an error in one line") {
  const TemporaryFolder folder;
  std::ofstream(folder / "empty.exr");
  std::ofstream(folder / "text.png") << "hello";
  REQUIRE(WriteImage(folder / "cut.exr", RandomImage(50, 50), {}));
  fs::resize_file(folder / "cut.exr", 3000);
  for (const char* name : {"missing.exr", "empty.exr", "text.png", "cut.exr"}) {
    CAPTURE(name);
    const Result<Image> image = ReadImage(folder / name);
    REQUIRE_FALSE(image);
    CheckIsLineAbout(image.error(), folder / name);
  }
}

TEST_CASE("ReadImage: a PNG gives its codes over 255, grey in all channels") {
  const TemporaryFolder folder;
  REQUIRE(WriteImage(folder / "a.png", {1, 1, {0.0f, 0.5f, 1.0f}}, {}));
  const Result<Image> image = ReadImage(folder / "a.png");
  REQUIRE(image);
  REQUIRE(image->rgb.size() == 3);
  CHECK(image->rgb[0] == 0.0f);
  CHECK(image->rgb[1] == doctest::Approx(188 / 255.0).epsilon(1e-6));
  CHECK(image->rgb[2] == 1.0f);

  const auto output = OIIO::ImageOutput::create("png");
  const uint8_t grey = 51;
  REQUIRE(output->open(folder / "grey.png", OIIO::ImageSpec(1, 1, 1, OIIO::TypeUInt8)));
  REQUIRE(output->write_image(OIIO::TypeUInt8, &grey));
  REQUIRE(output->close());
  const Result<Image> grey_image = ReadImage(folder / "grey.png");
  REQUIRE(grey_image);
  REQUIRE(grey_image->rgb.size() == 3);
  for (float value : grey_image->rgb) CHECK(value == doctest::Approx(51 / 255.0).epsilon(1e-6));
}

}  // namespace
}  // namespace swell::test
