// The PGM format (netpbm): "P2" or "P5", width, height and the value of white, separated by white
// space with comments from # to the line's end; one white space; then the pixels.
#include <algorithm>
#include <cctype>

#include "image.hpp"

namespace otter_nav::map {
namespace {

class Reader {
 public:
  Reader(const std::string& bytes, const std::string& path) : bytes_(bytes), path_(path) {}

  // The next whole number, at most `limit`.
  Result<int> number(const char* what, long limit) {
    skipSpace();
    long value = 0;
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && std::isdigit(byte()) != 0) {
      value = value * 10 + (byte() - '0');
      ++at_;
      if (value > limit) {
        return fail(what, "is above " + std::to_string(limit));
      }
    }
    if (at_ == begin) {
      return at_ == bytes_.size() ? fail(what, "is missing: the file ends")
                                  : fail(what, "is not a whole number");
    }
    return static_cast<int>(value);
  }

  // The pixels of P5, after exactly one white space.
  Status raw(GreyImage& image) {
    const std::size_t width = image.white > 255 ? 2 : 1;
    const std::size_t needed = image.pixels.size() * width;
    ++at_;
    const std::size_t left = bytes_.size() > at_ ? bytes_.size() - at_ : 0;
    if (left != needed) {
      return failure(path_ + ": " + std::to_string(left) + " bytes of pixels where " +
                     std::to_string(needed) + " are due (" + std::to_string(image.width) + " by " +
                     std::to_string(image.height) + "): the file is " +
                     (left < needed ? "truncated" : "too long"));
    }
    for (std::uint16_t& pixel : image.pixels) {
      unsigned value = byte();
      ++at_;
      if (width == 2) {
        value = 256U * value + byte();
        ++at_;
      }
      if (value > static_cast<unsigned>(image.white)) {
        return failure(path_ + ": a pixel is " + std::to_string(value) + ", above white, " +
                       std::to_string(image.white));
      }
      pixel = static_cast<std::uint16_t>(value);
    }
    return {};
  }

  // The pixels of P2.
  Status plain(GreyImage& image) {
    for (std::uint16_t& pixel : image.pixels) {
      const Result<int> value = number("pixel", image.white);
      if (!value) {
        return failure(value.error().message);
      }
      pixel = static_cast<std::uint16_t>(*value);
    }
    skipSpace();
    if (at_ != bytes_.size()) {
      return failure(where() + "more pixels than " + std::to_string(image.width) + " by " +
                     std::to_string(image.height) + ": the file is too long");
    }
    return {};
  }

  void skip(std::size_t count) { at_ += count; }

 private:
  [[nodiscard]] unsigned char byte() const { return static_cast<unsigned char>(bytes_[at_]); }

  void skipSpace() {
    while (at_ < bytes_.size() && (std::isspace(byte()) != 0 || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#') {
        at_ = std::min(bytes_.find('\n', at_), bytes_.size());
      } else {
        line_ += bytes_[at_] == '\n' ? 1 : 0;
        ++at_;
      }
    }
  }

  [[nodiscard]] std::string where() const {
    return path_ + ": line " + std::to_string(line_) + ": ";
  }
  [[nodiscard]] tl::unexpected<Error> fail(const char* what, const std::string& why) const {
    return failure(where() + what + " " + why);
  }

  const std::string& bytes_;
  const std::string& path_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

Result<GreyImage> parsePgm(const std::string& bytes, const std::string& path) {
  Reader reader(bytes, path);
  reader.skip(2);
  GreyImage image;
  const Result<int> width = reader.number("width", 1000000000);
  const Result<int> height = width ? reader.number("height", 1000000000) : width;
  const Result<int> white = height ? reader.number("value of white", 65535) : height;
  if (!white) {
    return failure(white.error().message);
  }
  if (const Status size = checkImageSize(*width, *height, path); !size) {
    return failure(size.error().message);
  }
  if (*white < 1) {
    return failure(path + ": the value of white is 0, allowed are 1 to 65535");
  }
  const std::size_t count = static_cast<std::size_t>(*width) * static_cast<std::size_t>(*height);
  if (bytes.size() < count) {  // before the memory is asked for
    return failure(path + ": " + std::to_string(bytes.size()) + " bytes cannot hold " +
                   std::to_string(*width) + " by " + std::to_string(*height) +
                   " pixels: the file is truncated");
  }
  image = {*width, *height, *white, std::vector<std::uint16_t>(count)};
  const Status read = bytes[1] == '5' ? reader.raw(image) : reader.plain(image);
  if (!read) {
    return failure(read.error().message);
  }
  return image;
}

}  // namespace otter_nav::map
