// swell_bench_textures: lookups per second of swell's texels beside OpenImageIO's TextureSystem, by
// turns, and how far their values lie apart.
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/spread.h"
#include "bench/textures/filter_columns.h"
#include "bench/textures/lookups.h"
#include "bench/textures/peer.h"
#include "src/stats/isa.h"
#include "src/stats/machine.h"

namespace swell::bench {
namespace {

constexpr size_t kBlock = 4096;  // lookups of one call: swell's default wave

struct Arguments {
  uint32_t side = 4096;
  size_t lookups = size_t{1} << 19;
  uint32_t repetitions = 10;
  std::vector<uint32_t> thread_counts = {1, 2};
  std::string isa = "auto";
  bool quick = false;
};

struct Case {
  const char* format;
  TextureFilter filter;
  TextureWrap wrap;
  Coherence coherence;
  uint32_t threads;
};

struct Columns {
  explicit Columns(size_t count) {
    for (size_t c = 0; c < 3; ++c) {
      memory[c] = hwy::AllocateAligned<float>(count);
      column[c] = memory[c].get();
    }
  }
  hwy::AlignedFreeUniquePtr<float[]> memory[3];
  float* column[3];
};

double Seconds(const std::function<void()>& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void InBlocks(uint32_t threads, size_t count, const std::function<void(size_t)>& block) {
  tbb::task_arena arena(static_cast<int>(threads));
  arena.execute(
      [&] { tbb::parallel_for(size_t{0}, count / kBlock, [&](size_t i) { block(i * kBlock); }); });
}

double LargestDifference(const Columns& a, const Columns& b, size_t count) {
  float largest = 0;
  for (size_t c = 0; c < 3; ++c) {
    for (size_t i = 0; i < count; ++i) {
      const float difference = std::abs(a.column[c][i] - b.column[c][i]);
      if (!(difference <= largest)) largest = difference;  // also what is not a number
    }
  }
  return largest;
}

const char* NameOf(TextureFilter filter) {
  return filter == TextureFilter::kBilinear ? "bilinear" : "trilinear";
}

// Coordinates are floats: each engine may place a lookup a few of their steps elsewhere in the
// image, and neighbouring texels differ by at most 1.
double Tolerance(uint32_t side) { return 4 * 0x1p-24 * side + 1e-5; }

// Prints one row. Whether the values agree.
bool Measure(const Case& test, const Arguments& arguments, const TexelImage& image,
             TexturePeer& peer) {
  const Lookups lookups = MakeLookups(arguments.lookups, test.coherence, arguments.side);
  const Lookups of_peer = WidthsOfPeer(lookups, image);
  const ImageView view = image.view();
  Columns own(lookups.count), others(lookups.count);
  const auto swell = [&](size_t first) {
    FilterColumnsArgs args{
        &view, test.wrap, test.filter, &lookups.s[first], &lookups.t[first], &lookups.width[first],
        {},    kBlock};
    // Bilinear lookups are of the largest level.
    static const std::vector<float> narrow(kBlock + 16, 0.0f);
    if (test.filter == TextureFilter::kBilinear) args.width = narrow.data();
    for (size_t c = 0; c < 3; ++c) args.rgb[c] = own.column[c] + first;
    FilterColumns(Width::kWide, args);
  };
  const auto oiio = [&](size_t first) {
    peer.Filter(of_peer, first, kBlock, test.wrap, test.filter, others.column);
  };
  std::vector<double> own_rates, others_rates, ratios;
  for (uint32_t r = 0; r <= arguments.repetitions; ++r) {
    double seconds[2];
    for (uint32_t turn = 0; turn < 2; ++turn) {
      const uint32_t engine = (turn + r) % 2;
      seconds[engine] = Seconds([&] {
        engine == 0 ? InBlocks(test.threads, lookups.count, swell)
                    : InBlocks(test.threads, lookups.count, oiio);
      });
    }
    if (r == 0) continue;  // reads the file
    own_rates.push_back(static_cast<double>(lookups.count) / seconds[0] * 1e-6);
    others_rates.push_back(static_cast<double>(lookups.count) / seconds[1] * 1e-6);
    ratios.push_back(seconds[1] / seconds[0]);
  }
  const double difference = LargestDifference(own, others, lookups.count);
  const Spread ratio = SpreadOf(ratios);
  std::printf("| %s | %s | %s | %s | %u | %.1f | %.2f | %.1f (%.1f-%.1f) | %.1e |\n", test.format,
              NameOf(test.filter), test.wrap == TextureWrap::kRepeat ? "repeat" : "clamp",
              test.coherence == Coherence::kCoherent ? "coherent" : "random", test.threads,
              SpreadOf(own_rates).median, SpreadOf(others_rates).median, ratio.median, ratio.lower,
              ratio.upper, difference);
  std::fflush(stdout);
  return difference <= Tolerance(arguments.side);
}

Status MeasureFormat(TexelFormat format, const std::string& folder, const Arguments& arguments,
                     bool* agree) {
  const bool bytes = format == TexelFormat::kByte;
  const std::string file = folder + (bytes ? "/bytes.tif" : "/halves.exr");
  const TexelImage image = MakeTexelImage(MakePattern(arguments.side, format), Levels::kAll);
  if (Status written = WriteTiled(image, file); !written) return written;
  Result<std::unique_ptr<TexturePeer>> peer = TexturePeer::Make(file);
  if (!peer) return peer.error();
  for (TextureFilter filter : {TextureFilter::kBilinear, TextureFilter::kTrilinear}) {
    for (TextureWrap wrap : {TextureWrap::kRepeat, TextureWrap::kClamp}) {
      for (Coherence coherence : {Coherence::kCoherent, Coherence::kRandom}) {
        for (uint32_t threads : arguments.thread_counts) {
          const Case test{bytes ? "bytes" : "halves", filter, wrap, coherence, threads};
          if (!Measure(test, arguments, image, **peer)) *agree = false;
        }
      }
    }
  }
  constexpr double kMiB = 1 << 20;
  std::fprintf(stderr, "%s: swell holds %.1f MiB, TextureSystem's cache %.1f MiB\n",
               bytes ? "bytes" : "halves", static_cast<double>(image.bytes()) / kMiB,
               static_cast<double>((*peer)->cache_bytes()) / kMiB);
  return Done{};
}

Result<bool> Run(const Arguments& arguments) {
  if (Status s = SelectIsa(arguments.isa); !s) return s.error();
  const Machine machine = DescribeMachine(Width::kWide);
  std::printf("%s, %s, %u threads, %s; image of %u x %u, %zu lookups, %u repetitions by turns\n\n",
              machine.cpu.value_or("unknown CPU").c_str(), machine.isa.c_str(), machine.threads,
              machine.compiler.c_str(), arguments.side, arguments.side, arguments.lookups,
              arguments.repetitions);
  std::printf(
      "| texels | filter | wrap | uv | threads | swell, M/s | TextureSystem, M/s | ratio | "
      "largest difference |\n|---|---|---|---|---|---|---|---|---|\n");
  std::string folder = std::filesystem::temp_directory_path() / "swell_bench_XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) return Error{folder + ": cannot be made"};
  bool agree = true;
  Status status = Done{};
  for (TexelFormat format : {TexelFormat::kByte, TexelFormat::kHalf}) {
    if (status) status = MeasureFormat(format, folder, arguments, &agree);
  }
  std::filesystem::remove_all(folder);
  if (!status) return status.error();
  std::printf("\nvalues: %s\n", agree ? "agree within rounding" : "DIFFER");
  return agree;
}

}  // namespace
}  // namespace swell::bench

int main(int argc, char** argv) {
  swell::bench::Arguments arguments;
  CLI::App app("Looks an image up by swell's texels and by OpenImageIO's TextureSystem, by turns.");
  app.add_option("--size", arguments.side, "texels of the image's side")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str();
  app.add_option("--lookups", arguments.lookups, "of each case; whole blocks of 4096")
      ->check(CLI::Range(4096, 1 << 26))
      ->capture_default_str();
  app.add_option("--reps", arguments.repetitions, "repetitions of each engine")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--nthreads", arguments.thread_counts, "numbers of threads, one row each")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--isa", arguments.isa, "as of swell render")->capture_default_str();
  app.add_flag("--quick", arguments.quick, "a small image, one repetition: compares values only");
  CLI11_PARSE(app, argc, argv);
  if (arguments.quick) {
    arguments.side = 200;  // whose smaller levels are odd
    arguments.lookups = 16 * swell::bench::kBlock;
    arguments.repetitions = 1;
  }
  arguments.lookups -= arguments.lookups % swell::bench::kBlock;
  const swell::Result<bool> agree = swell::bench::Run(arguments);
  if (agree) return *agree ? 0 : 1;
  std::fprintf(stderr, "swell_bench_textures: %s\n", agree.error().message.c_str());
  return 1;
}
