#include "octree_file.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace otter_nav::map {
namespace {

constexpr int kDepth = 16;  // of an OcTree
constexpr std::size_t kValueBytes = sizeof(float);

struct Header {
  bool binary = false;
  std::string type;
  std::size_t nodes = 0;
  double resolution_m = 0.0;
  std::size_t data_begin = 0;
};

Result<Header> readHeader(const std::string& bytes, const std::string& path) {
  const std::string binary_magic = "# Octomap OcTree binary file";
  const std::string full_magic = "# Octomap OcTree file";
  Header header;
  header.binary = bytes.compare(0, binary_magic.size(), binary_magic) == 0;
  if (!header.binary && bytes.compare(0, full_magic.size(), full_magic) != 0) {
    return failure(path + ": not an OctoMap file: it does not begin with '" + full_magic + "'");
  }
  std::istringstream in(bytes.substr(0, 4096));
  std::string line;
  bool complete = false;
  while (!complete && std::getline(in, line)) {
    std::istringstream fields(line);
    std::string key;
    fields >> key;
    if (key == "id") {
      fields >> header.type;
    } else if (key == "size") {
      fields >> header.nodes;
    } else if (key == "res") {
      fields >> header.resolution_m;
    } else if (key == "data") {
      complete = true;
      header.data_begin = static_cast<std::size_t>(in.tellg());
    }
    if (fields.fail() && !line.empty() && line[0] != '#') {
      return failure(path + ": header line '" + line + "' cannot be read");
    }
  }
  if (!complete) {
    return failure(path + ": the header has no 'data' line: the file is truncated");
  }
  if (header.type != "OcTree") {
    return failure(path + ": holds a tree of type '" + header.type + "', only OcTree can be used");
  }
  if (!(header.resolution_m >= 1e-3 && header.resolution_m <= 100.0)) {
    return failure(path + ": 'res' is " + std::to_string(header.resolution_m) +
                   ", allowed range [0.001, 100]");
  }
  return header;
}

// Follows the tree's structure through the bytes without building it.
class Walker {
 public:
  Walker(const std::string& bytes, std::size_t begin, bool binary)
      : bytes_(bytes), at_(begin), binary_(binary) {}

  bool node(int depth) {
    const std::size_t head = binary_ ? 2 : kValueBytes + 1;
    if (depth > kDepth || at_ + head > bytes_.size()) {
      return false;
    }
    const std::size_t begin = at_;
    at_ += head;
    ++nodes_;
    return binary_ ? binaryChildren(begin, depth) : fullChildren(begin, depth);
  }
  [[nodiscard]] std::size_t nodes() const { return nodes_; }
  [[nodiscard]] std::size_t at() const { return at_; }

 private:
  [[nodiscard]] unsigned byte(std::size_t i) const { return static_cast<unsigned char>(bytes_[i]); }

  // Two bits a child: unknown, occupied leaf, free leaf, or a node of its own.
  bool binaryChildren(std::size_t begin, int depth) {
    const unsigned bits = byte(begin) + 256U * byte(begin + 1);
    for (unsigned child = 0; child < 8; ++child) {
      const unsigned kind = (bits >> (2 * child)) & 3U;
      if (kind == 3U) {
        if (!node(depth + 1)) {
          return false;
        }
      } else if (kind != 0U) {
        ++nodes_;
      }
    }
    return true;
  }

  // The node's value, then a bit for each child that follows; values are log-odds.
  bool fullChildren(std::size_t begin, int depth) {
    float value = 0.0F;
    bytes_.copy(reinterpret_cast<char*>(&value), kValueBytes, begin);
    if (!std::isfinite(value)) {
      return false;
    }
    for (unsigned child = 0; child < 8; ++child) {
      if (((byte(begin + kValueBytes) >> child) & 1U) != 0 && !node(depth + 1)) {
        return false;
      }
    }
    return true;
  }

  const std::string& bytes_;
  std::size_t at_;
  bool binary_;
  std::size_t nodes_ = 0;
};

}  // namespace

Result<std::unique_ptr<octomap::OcTree>> readOctree(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return failure(path + ": no such file");
  }
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const Result<Header> header = readHeader(bytes, path);
  if (!header) {
    return failure(header.error().message);
  }
  Walker walker(bytes, header->data_begin, header->binary);
  if (header->nodes > 0 &&
      (!walker.node(0) || walker.nodes() != header->nodes || walker.at() != bytes.size())) {
    return failure(path + ": " + std::to_string(header->nodes) +
                   " nodes announced, but the data are truncated, too long or garbled");
  }
  std::istringstream stream(bytes);
  auto tree = std::make_unique<octomap::OcTree>(header->resolution_m);
  if (header->binary) {
    if (!tree->readBinary(stream)) {
      return failure(path + ": OctoMap cannot read it");
    }
    return tree;
  }
  std::unique_ptr<octomap::AbstractOcTree> any(octomap::AbstractOcTree::read(stream));
  auto* read = dynamic_cast<octomap::OcTree*>(any.get());
  if (read == nullptr) {
    return failure(path + ": OctoMap cannot read it");
  }
  static_cast<void>(any.release());
  tree.reset(read);
  return tree;
}

}  // namespace otter_nav::map
