#include "image.hpp"

#include <png.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace otter_nav::map {
namespace {

Result<GreyImage> loadPng(const std::string& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) {
    return failure(path + ": not a readable PNG: " + png.message);
  }
  if (const Status size = checkImageSize(png.width, png.height, path); !size) {
    png_image_free(&png);
    return failure(size.error().message);
  }
  png.format = PNG_FORMAT_GA;  // with alpha, so that nothing is blended; it is then ignored
  png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  std::vector<png_byte> bytes(PNG_IMAGE_SIZE(png));
  const bool complete = png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr) != 0;
  if (!complete || PNG_IMAGE_FAILED(png)) {
    const std::string reason = png.message;
    png_image_free(&png);
    return failure(path + ": broken PNG: " + reason);
  }
  GreyImage image{static_cast<int>(png.width), static_cast<int>(png.height), 255, {}};
  image.pixels.resize(bytes.size() / 2);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = bytes[2 * i];
  }
  return image;
}

}  // namespace

Status checkImageSize(long width, long height, const std::string& path) {
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) {
    return failure(path + ": picture of " + std::to_string(width) + " by " +
                   std::to_string(height) + " pixels, allowed are 1 to " +
                   std::to_string(kLargestSide) + " a side");
  }
  return {};
}

Result<GreyImage> loadImage(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return failure(path + ": no such file");
  }
  std::ifstream file(path, std::ios::binary);
  char magic[2] = {0, 0};
  file.read(magic, 2);
  if (!file) {
    return failure(path + ": cannot be read, or is empty");
  }
  if (magic[0] == '\x89' && magic[1] == 'P') {
    return loadPng(path);
  }
  if (magic[0] != 'P' || (magic[1] != '2' && magic[1] != '5')) {
    return failure(path + ": neither PGM (P2 or P5) nor PNG");
  }
  file.seekg(0);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return parsePgm(bytes, path);
}

Status savePgm(const GreyImage& image, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  file << "P5\n" << image.width << ' ' << image.height << "\n255\n";
  std::string bytes(image.pixels.size(), '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<char>(image.pixels[i]);
  }
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) {
    return failure(path + ": cannot be written");
  }
  return {};
}

}  // namespace otter_nav::map
