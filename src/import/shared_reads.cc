// Meshes and images by name: the first who asks has them read.
#include "src/import/shared_reads.h"

#include <new>

namespace swell {

void SharedImage::Read() try {
  Result<ReadPixels> read = ReadImagePixels(path, use, encoding);
  if (!read) {
    image = read.error();
    return;
  }
  not_finite = read->not_finite;
  image = MakeTexelImage(read->pixels, Levels::kAll);
  (*image)->name = path;
} catch (const std::bad_alloc&) {
  image.reset();
}

std::shared_ptr<SharedPly> SharedReads::Ply(const std::string& path) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<SharedPly>& ply = plys_[path];
  const bool is_new = ply == nullptr;
  if (is_new) ply = std::make_shared<SharedPly>(path);
  ply->AddUse();
  if (is_new) Run([ply] { ply->Read(); });
  return ply;
}

std::shared_ptr<SharedImage> SharedReads::Image(const std::string& path, ImageUse use,
                                                const Encoding& encoding) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<SharedImage>& image =
      images_[{path, use, static_cast<int>(encoding.curve), encoding.gamma}];
  if (image != nullptr) return image;
  image = std::make_shared<SharedImage>();
  image->path = path;
  image->use = use;
  image->encoding = encoding;
  Run([shared = image] { shared->Read(); });
  return image;
}

}  // namespace swell
