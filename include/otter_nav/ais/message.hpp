// AIS messages in AIS's own units, and the sentences they travel in.
//
// Source: Recommendation ITU-R M.1371-5, annex 8 (messages), IEC 61162-1 (!AIVDM sentences). Types
// 1 to 3 (position, class A), 5 (static, class A), 18 and 19 (position, class B), 21 (aid to
// navigation), 24 (static, class B).
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "otter_nav/base/result.hpp"

namespace otter_nav::ais {

constexpr double kNotAvailable = std::numeric_limits<double>::quiet_NaN();
constexpr double kKnotMps = 1852.0 / 3600.0;

// A bearing of AIS's, clockwise from north, as an angle of the map, counter-clockwise from east.
[[nodiscard]] double radiansFromEast(double degrees_from_north);

// All fields of all types, whoever uses them: what is decoded is compared with gpsd's decoder. A
// type carries some of them, the others keep their "not available".
// Courses and headings are degrees clockwise from true north, WGS 84.
struct Message {
  int type = 0;
  int repeat = 0;
  std::uint32_t mmsi = 0;

  // Position: types 1 to 3, 18, 19, 21.
  int status = 15;  // navigational status: 1 at anchor, 5 moored; 15 undefined (types 1 to 3)
  int turn = -128;  // rate of turn indicator as sent: 4.733 sqrt(deg / min), signed; -128 unknown
  double speed_knots = kNotAvailable;
  bool accurate = false;  // within 10 m
  double longitude_deg = kNotAvailable;
  double latitude_deg = kNotAvailable;
  double course_deg = kNotAvailable;
  double heading_deg = kNotAvailable;
  int second = 60;            // of the UTC minute; 60: not available
  bool off_position = false;  // type 21
  bool is_virtual = false;    // type 21: nothing floats there

  // Static: types 5, 19, 21, 24.
  int part = 0;  // type 24: 0 is part A (the name), 1 part B (all else)
  std::uint32_t imo = 0;
  std::string name;
  std::string callsign;
  int ship_type = 0;  // type 21: the aid's
  // Of the reported position from bow, stern, port and starboard side, m; all 0: not available.
  int to_bow_m = 0;
  int to_stern_m = 0;
  int to_port_m = 0;
  int to_starboard_m = 0;
  std::uint32_t mothership = 0;  // of an auxiliary craft (type 24 part B), instead of dimensions
  int position_fix = 0;
  int eta_month = 0;
  int eta_day = 0;
  int eta_hour = 24;
  int eta_minute = 60;
  double draught_m = 0.0;
  std::string destination;

  [[nodiscard]] bool hasPosition() const;
  [[nodiscard]] bool hasDimensions() const {
    return to_bow_m + to_stern_m > 0 && to_port_m + to_starboard_m > 0;
  }
  // Whether the dimensions tell where in the outline the position is: bow and port of 0 say that
  // they don't.
  [[nodiscard]] bool hasReferencePoint() const { return to_bow_m > 0 || to_port_m > 0; }
};

// The sentences of a message, without line ends: one, or as many as it needs. `sequence` (0 to 9)
// tells the parts of one message from another's. Values are rounded to what a field can hold and
// kept within its range; texts are cut, and letters AIS doesn't know become '?'. An error for a
// type that isn't handled.
[[nodiscard]] Result<std::vector<std::string>> encode(const Message& message, char channel,
                                                      int sequence);

// Reads sentences one by one and joins those of a message.
class Decoder {
 public:
  // A message when `sentence` completes one; nothing while parts are missing, or for a type or
  // sentence that isn't handled (own reports !AIVDO among them). An error says what is wrong with
  // it: no !..VDM at all, the checksum, a field, a letter that can't be, too few bits.
  [[nodiscard]] Result<std::optional<Message>> add(std::string_view sentence);

 private:
  struct Parts {
    int count = 0;
    int next = 1;
    std::string payload;
  };
  std::map<std::pair<std::string, std::string>, Parts> pending_;  // by sequence and channel
};

}  // namespace otter_nav::ais
