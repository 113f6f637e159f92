#include "replay_tracker/bag_file.hpp"

#include <rosbag/chunked_file.h>
#include <rosbag/constants.h>
#include <rosbag/exceptions.h>

#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

namespace otter_nav::ros_bridge {
namespace {

constexpr std::uint32_t kLargest = 1U << 30U;  // of a record; more is damage

struct Connection {
  std::string topic;
  std::string type;
  std::string md5;
};

using Fields = std::map<std::string, std::string>;

template <typename Number>
Number numberIn(const Fields& fields, const std::string& key) {
  Number number{};
  const auto found = fields.find(key);
  if (found != fields.end() && found->second.size() == sizeof(number)) {
    std::memcpy(&number, found->second.data(), sizeof(number));
  }
  return number;
}

// name=value, each with its length before.
Fields fieldsOf(const std::uint8_t* data, std::uint32_t size) {
  Fields fields;
  std::uint32_t at = 0;
  while (at + 4 <= size) {
    std::uint32_t length = 0;
    std::memcpy(&length, data + at, 4);
    at += 4;
    if (length > size - at) {
      break;
    }
    const std::string field(reinterpret_cast<const char*>(data + at), length);
    const std::size_t equals = field.find('=');
    if (equals != std::string::npos) {
      fields[field.substr(0, equals)] = field.substr(equals + 1);
    }
    at += length;
  }
  return fields;
}

// A record in memory: header and data.
struct Record {
  Fields header;
  const std::uint8_t* data = nullptr;
  std::uint32_t size = 0;
};
// The next record of a decompressed chunk; false at its end or where it breaks off.
bool next(const std::vector<std::uint8_t>& chunk, std::size_t& at, Record& record) {
  const auto length = [&](std::uint32_t& value) {
    if (chunk.size() - at < 4) {
      return false;
    }
    std::memcpy(&value, chunk.data() + at, 4);
    at += 4;
    return value <= chunk.size() - at;
  };
  std::uint32_t header = 0;
  if (!length(header)) {
    return false;
  }
  record.header = fieldsOf(chunk.data() + at, header);
  at += header;
  if (!length(record.size)) {
    return false;
  }
  record.data = chunk.data() + at;
  at += record.size;
  return true;
}

class Reader {
 public:
  Reader(const std::string& path, const std::function<Status(const BagMessage&)>& take)
      : path_(path), take_(take), file_(path, std::ios::binary) {}

  Result<std::string> read(bool partial) {
    if (!file_) {
      return failure(path_ + ": no such file, or it cannot be read");
    }
    std::string magic;
    std::getline(file_, magic);
    if (magic.empty() && file_.eof()) {
      return failure(path_ + ": is empty (0 bytes)");
    }
    if (magic.rfind("#ROSBAG V2.0", 0) != 0) {
      return failure(path_ + (magic.rfind("#ROSBAG", 0) == 0
                                  ? ": is a bag of a version other than 2.0"
                                  : ": is not a ROS bag"));
    }
    std::string note;
    while (file_.peek() != std::ifstream::traits_type::eof()) {
      Fields header;
      if (!readRecord(header)) {
        note = "it is cut off after " + last();
        break;
      }
      const auto op = numberIn<std::uint8_t>(header, rosbag::OP_FIELD_NAME);
      if (op == rosbag::OP_FILE_HEADER) {
        if (numberIn<std::uint64_t>(header, rosbag::INDEX_POS_FIELD_NAME) == 0) {
          note = "it has no index, its recording was cut off";
          if (!partial) {
            break;
          }
        }
      } else if (op == rosbag::OP_CHUNK) {
        if (const Status status = readChunk(header, note); !status) {
          return failure(status.error().message);
        }
      }
    }
    if (!note.empty() && !partial) {
      return failure(path_ + ": " + note +
                     "; `rosbag reindex` mends what has no index, --partial reads what is there");
    }
    return note;
  }

 private:
  [[nodiscard]] std::string last() const {
    std::ostringstream out;
    out << messages_ << " messages";
    return out.str();
  }

  bool readBytes(std::vector<std::uint8_t>& bytes) {
    std::uint32_t length = 0;
    if (!file_.read(reinterpret_cast<char*>(&length), 4) || length > kLargest) {
      return false;
    }
    bytes.resize(length);
    return length == 0 || file_.read(reinterpret_cast<char*>(bytes.data()), length);
  }
  bool readRecord(Fields& header) {
    if (!readBytes(header_)) {
      return false;
    }
    header = fieldsOf(header_.data(), static_cast<std::uint32_t>(header_.size()));
    return readBytes(data_);
  }

  Status readChunk(const Fields& header, std::string& note) {
    const auto size = numberIn<std::uint32_t>(header, rosbag::SIZE_FIELD_NAME);
    const auto found = header.find(rosbag::COMPRESSION_FIELD_NAME);
    const std::string compression = found == header.end() ? "" : found->second;
    if (compression == "none") {
      chunk_ = data_;
    } else if (compression == "lz4" || compression == "bz2") {
      if (size > kLargest) {
        note = "a chunk is damaged after " + last();
        return {};
      }
      chunk_.resize(size);
      try {
        unpacker_.decompress(
            compression == "lz4" ? rosbag::compression::LZ4 : rosbag::compression::BZ2,
            chunk_.data(), size, data_.data(), static_cast<unsigned>(data_.size()));
      } catch (const rosbag::BagException&) {
        note = "a chunk is damaged after " + last();
        return {};
      }
    } else {
      return failure(path_ + ": has a chunk of unknown compression '" + compression + "'");
    }
    std::size_t at = 0;
    Record record;
    while (at < chunk_.size()) {
      if (!next(chunk_, at, record)) {
        note = "a chunk breaks off after " + last();
        return {};
      }
      if (const Status status = takeRecord(record); !status) {
        return status;
      }
    }
    return {};
  }

  Status takeRecord(const Record& record) {
    const auto op = numberIn<std::uint8_t>(record.header, rosbag::OP_FIELD_NAME);
    const auto id = numberIn<std::uint32_t>(record.header, rosbag::CONNECTION_FIELD_NAME);
    if (op == rosbag::OP_CONNECTION) {
      const Fields about = fieldsOf(record.data, record.size);
      const auto text = [&](const Fields& fields, const std::string& key) {
        const auto found = fields.find(key);
        return found == fields.end() ? std::string() : found->second;
      };
      connections_[id] = {text(record.header, rosbag::TOPIC_FIELD_NAME), text(about, "type"),
                          text(about, "md5sum")};
    } else if (op == rosbag::OP_MSG_DATA) {
      const auto connection = connections_.find(id);
      if (connection == connections_.end()) {
        return {};
      }
      const auto time = numberIn<std::uint64_t>(record.header, rosbag::TIME_FIELD_NAME);
      const double received_s =
          static_cast<double>(time & 0xffffffffU) + 1e-9 * static_cast<double>(time >> 32U);
      ++messages_;
      const Connection& from = connection->second;
      return take_({from.topic, from.type, from.md5, received_s, record.data, record.size});
    }
    return {};
  }

  const std::string& path_;
  const std::function<Status(const BagMessage&)>& take_;
  std::ifstream file_;
  rosbag::ChunkedFile unpacker_;
  std::map<std::uint32_t, Connection> connections_;
  std::vector<std::uint8_t> header_;
  std::vector<std::uint8_t> data_;
  std::vector<std::uint8_t> chunk_;
  std::uint64_t messages_ = 0;
};

}  // namespace

Result<std::string> readBagFile(const std::string& path, bool partial,
                                const std::function<Status(const BagMessage&)>& take) {
  return Reader(path, take).read(partial);
}

}  // namespace otter_nav::ros_bridge
