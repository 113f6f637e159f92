// Grey pictures: PGM (plain P2 and raw P5, 8 and 16 bits) and PNG.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"

namespace otter_nav::map {

struct GreyImage {
  int width = 0;
  int height = 0;
  int white = 255;                    // the value of white
  std::vector<std::uint16_t> pixels;  // row-major from the top left
};

// Larger pictures are refused: at 0.25 m a cell this is 5 km a side.
constexpr int kLargestSide = 20000;

[[nodiscard]] Status checkImageSize(long width, long height, const std::string& path);

// By what the file begins with, not by its name. Errors name the file and what is wrong with it.
[[nodiscard]] Result<GreyImage> loadImage(const std::string& path);
[[nodiscard]] Result<GreyImage> parsePgm(const std::string& bytes, const std::string& path);

// Raw PGM with 8 bits.
[[nodiscard]] Status savePgm(const GreyImage& image, const std::string& path);

}  // namespace otter_nav::map
