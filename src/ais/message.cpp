#include "otter_nav/ais/message.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "bits.hpp"
#include "layout.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/text.hpp"

namespace otter_nav::ais {
namespace {

constexpr std::size_t kLettersPerSentence = 60;  // keeps a sentence within its 82 characters
// Some transmitters leave out the last spare bits.
constexpr std::size_t kForgivenBits = 8;

// Ten sequence numbers on two channels; more is noise.
constexpr std::size_t kMostPending = 32;

unsigned checksumOf(std::string_view text) {
  unsigned sum = 0;
  for (const char c : text) {
    sum ^= static_cast<unsigned char>(c);
  }
  return sum;
}

std::string armoured(const std::vector<bool>& bits, std::size_t& fill) {
  std::string payload;
  fill = (6 - bits.size() % 6) % 6;
  for (std::size_t k = 0; k < bits.size() + fill; k += 6) {
    int six = 0;
    for (std::size_t i = k; i < k + 6; ++i) {
      six = 2 * six + (i < bits.size() && bits[i] ? 1 : 0);
    }
    payload += static_cast<char>(six < 40 ? six + 48 : six + 56);
  }
  return payload;
}

// The bits of a payload's letters, or nothing for a letter that can't be.
std::optional<std::vector<bool>> bitsOf(std::string_view payload, std::size_t fill) {
  std::vector<bool> bits;
  bits.reserve(6 * payload.size());
  for (const char c : payload) {
    if (c < '0' || c > 'w' || (c > 'W' && c < '`')) {
      return std::nullopt;
    }
    const int six = c < '`' ? c - 48 : c - 56;
    for (int k = 5; k >= 0; --k) {
      bits.push_back((six >> k & 1) != 0);
    }
  }
  bits.resize(bits.size() - std::min(fill, bits.size()));
  return bits;
}

std::optional<int> wholeNumber(std::string_view text, int base) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc() || end != text.data() + text.size()) {
    return std::nullopt;
  }
  return value;
}

// !AIVDM,parts,part,sequence,channel,payload,fill*checksum
struct Sentence {
  std::string_view kind;
  int parts = 0;
  int part = 0;
  std::string_view sequence;
  std::string_view channel;
  std::string_view payload;
  int fill = 0;
};

// The line's end, and what some receivers put before the sentence: \...\ .
std::string_view bare(std::string_view text) {
  while (!text.empty() && (text.back() == '\r' || text.back() == '\n' || text.back() == ' ')) {
    text.remove_suffix(1);
  }
  if (!text.empty() && text.front() == '\\') {
    const std::size_t end = text.find('\\', 1);
    text.remove_prefix(end == std::string_view::npos ? 0 : end + 1);
  }
  return text;
}

Result<Sentence> parse(std::string_view text) {
  const std::size_t star = text.rfind('*');
  if (text.empty() || text.front() != '!' || star == std::string_view::npos) {
    return failure("no AIS sentence: it has no '!' or no '*'");
  }
  const std::optional<int> sum = wholeNumber(text.substr(star + 1), 16);
  const std::string_view body = text.substr(1, star - 1);
  if (!sum || static_cast<unsigned>(*sum) != checksumOf(body)) {
    return failure("checksum is '" + std::string(text.substr(star + 1)) +
                   otter_nav::text("', not %02X", checksumOf(body)));
  }
  std::array<std::string_view, 7> fields;
  std::size_t count = 0;
  for (std::size_t from = 0; from <= body.size(); ++count) {
    const std::size_t comma = std::min(body.find(',', from), body.size());
    if (count < fields.size()) {
      fields[count] = body.substr(from, comma - from);
    }
    from = comma + 1;
  }
  if (count != fields.size()) {
    return failure("it has " + std::to_string(count) + " fields, not 7");
  }
  const auto parts = wholeNumber(fields[1], 10);
  const auto part = wholeNumber(fields[2], 10);
  const auto fill = wholeNumber(fields[6], 10);
  if (!parts || !part || *parts < 1 || *parts > 9 || *part < 1 || *part > *parts) {
    return failure("part '" + std::string(fields[2]) + "' of '" + std::string(fields[1]) +
                   "' can't be");
  }
  if (!fill || *fill < 0 || *fill > 5) {
    return failure("fill bits '" + std::string(fields[6]) + "' are not 0 to 5");
  }
  return Sentence{fields[0], *parts, *part, fields[3], fields[4], fields[5], *fill};
}

Result<std::optional<Message>> messageOf(std::string_view payload, int fill) {
  const auto bits = bitsOf(payload, static_cast<std::size_t>(fill));
  if (!bits) {
    return failure("its payload holds a letter that AIS doesn't use");
  }
  Message message;
  BitReader reader(*bits);
  const bool handled = layout(message, reader);
  if (reader.ranOut(handled ? kForgivenBits : 0)) {
    return failure("type " + std::to_string(message.type) + " needs more than its " +
                   std::to_string(bits->size()) + " bits");
  }
  if (!handled) {
    return std::optional<Message>();
  }
  return std::optional<Message>(std::move(message));
}

}  // namespace

double radiansFromEast(double degrees_from_north) {
  return wrapAngle((90.0 - degrees_from_north) * kPi / 180.0);
}

bool Message::hasPosition() const {
  return std::abs(longitude_deg) <= 180.0 && std::abs(latitude_deg) <= 90.0;
}

Result<std::vector<std::string>> encode(const Message& message, char channel, int sequence) {
  Message copy = message;
  BitWriter writer;
  if (!layout(copy, writer)) {
    return failure("AIS message type " + std::to_string(message.type) +
                   " is not one of 1 to 3, 5, 18, 19, 21, 24");
  }
  std::size_t fill = 0;
  const std::string payload = armoured(writer.bits(), fill);
  const std::size_t parts = (payload.size() + kLettersPerSentence - 1) / kLettersPerSentence;
  std::vector<std::string> sentences;
  for (std::size_t part = 0; part < parts; ++part) {
    std::string body = "AIVDM," + std::to_string(parts) + "," + std::to_string(part + 1) + "," +
                       (parts > 1 ? std::to_string(sequence) : "") + "," + channel + "," +
                       payload.substr(part * kLettersPerSentence, kLettersPerSentence) + "," +
                       std::to_string(part + 1 == parts ? fill : 0);
    sentences.push_back("!" + body + text("*%02X", checksumOf(body)));
  }
  return sentences;
}

Result<std::optional<Message>> Decoder::add(std::string_view sentence) {
  const Result<Sentence> parsed = parse(bare(sentence));
  if (!parsed) {
    return failure(parsed.error().message);
  }
  const std::string_view kind = parsed->kind;
  if (kind.size() != 5 || kind.substr(2) != "VDM") {
    if (kind.size() == 5 && kind.substr(2) == "VDO") {
      return std::optional<Message>();
    }
    return failure("'!" + std::string(kind) + "' is no AIS report");
  }
  if (parsed->parts == 1) {
    return messageOf(parsed->payload, parsed->fill);
  }
  const std::pair<std::string, std::string> key(parsed->sequence, parsed->channel);
  if (parsed->part == 1) {
    if (pending_.size() >= kMostPending) {
      pending_.clear();
    }
    pending_[key] = {parsed->parts, 1, {}};
  }
  const auto found = pending_.find(key);
  if (found == pending_.end() || found->second.next != parsed->part ||
      found->second.count != parsed->parts) {
    if (found != pending_.end()) {
      pending_.erase(found);
    }
    return failure("part " + std::to_string(parsed->part) + " of " + std::to_string(parsed->parts) +
                   " came without the one before it");
  }
  found->second.payload += parsed->payload;
  ++found->second.next;
  if (parsed->part < parsed->parts) {
    return std::optional<Message>();
  }
  const std::string payload = std::move(found->second.payload);
  pending_.erase(found);
  return messageOf(payload, parsed->fill);
}

}  // namespace otter_nav::ais
