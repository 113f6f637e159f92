// AIS sentences: against gpsd's decoder where it is installed, there and back, and refused.
#include "otter_nav/ais/message.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "ais/bits.hpp"
#include "otter_nav/base/random.hpp"
#include "otter_nav/base/text.hpp"

namespace otter_nav::ais {
namespace {

int whole(Random& random, int low, int high) {
  return low + static_cast<int>(random.uniform() * (high - low + 1));
}

std::string letters(Random& random, int most) {
  const std::string known = "ABCDEFGHIJKLMNOPQRSTUVWXYZ 0123456789-./";
  std::string text = "X";
  for (int k = whole(random, 0, most - 2); k > 0; --k) {
    text += known[static_cast<std::size_t>(whole(random, 0, static_cast<int>(known.size()) - 1))];
  }
  return text.find_last_not_of(' ') + 1 < text.size() ? text + "X" : text;
}

// Every field that its type carries.
Message anyMessage(int type, Random& random) {
  Message m;
  m.type = type;
  m.repeat = whole(random, 0, 3);
  m.mmsi = static_cast<std::uint32_t>(whole(random, 200000000, 799999999));
  m.status = whole(random, 0, 15);
  m.turn = whole(random, -128, 127);
  const bool unknown = random.uniform() < 0.2;
  m.speed_knots = unknown ? kNotAvailable : 0.1 * whole(random, 0, 1022);
  m.course_deg = unknown ? kNotAvailable : 0.1 * whole(random, 0, 3599);
  m.heading_deg = unknown ? kNotAvailable : whole(random, 0, 359);
  m.longitude_deg = random.uniform(-180.0, 180.0);
  m.latitude_deg = random.uniform(-90.0, 90.0);
  m.accurate = random.uniform() < 0.5;
  m.second = whole(random, 0, 59);
  m.part = type == 24 ? whole(random, 0, 1) : 0;
  if (m.part == 1 && random.uniform() < 0.5) {  // of a craft that belongs to a ship
    m.mmsi = static_cast<std::uint32_t>(whole(random, 980000000, 989999999));
    m.mothership = static_cast<std::uint32_t>(whole(random, 200000000, 799999999));
  }
  m.imo = static_cast<std::uint32_t>(whole(random, 0, 9999999));
  m.name = letters(random, type == 21 && random.uniform() < 0.5 ? 34 : 20);
  m.callsign = letters(random, 7);
  m.ship_type = whole(random, 0, type == 21 ? 31 : 99);
  m.to_bow_m = whole(random, 0, 511);
  m.to_stern_m = whole(random, 0, 511);
  m.to_port_m = whole(random, 0, 63);
  m.to_starboard_m = whole(random, 0, 63);
  m.position_fix = whole(random, 0, 8);
  m.eta_month = whole(random, 1, 12);
  m.eta_day = whole(random, 1, 28);
  m.eta_hour = whole(random, 0, 23);
  m.eta_minute = whole(random, 0, 59);
  m.draught_m = 0.1 * whole(random, 1, 255);
  m.destination = letters(random, 20);
  m.off_position = random.uniform() < 0.5;
  m.is_virtual = random.uniform() < 0.5;
  return m;
}

constexpr int kTypes[] = {1, 2, 3, 5, 18, 19, 21, 24};

bool carriesPosition(int type) {
  return type != 5 && type != 24;
}
bool carriesDimensions(const Message& m) {
  return m.type == 5 || m.type == 19 || m.type == 21 ||
         (m.type == 24 && m.part == 1 && m.mothership == 0);
}
bool carriesMotion(int type) {
  return carriesPosition(type) && type != 21;
}

void expectSameNumber(double a, double b, double within) {
  EXPECT_TRUE((std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= within) << a << ' ' << b;
}

TEST(AisMessage, ComesBackAsItWent) {
  Random random(5);
  Decoder decoder;
  for (int run = 0; run < 400; ++run) {
    const Message m = anyMessage(kTypes[run % 8], random);
    const auto sentences = encode(m, 'B', run % 10);
    ASSERT_TRUE(sentences) << sentences.error().message;
    std::optional<Message> back;
    for (const std::string& sentence : *sentences) {
      EXPECT_LE(sentence.size(), 80U);
      EXPECT_FALSE(back);
      const auto added = decoder.add(sentence + "\r\n");
      ASSERT_TRUE(added) << added.error().message;
      back = *added;
    }
    ASSERT_TRUE(back);
    EXPECT_EQ(back->type, m.type);
    EXPECT_EQ(back->mmsi, m.mmsi);
    EXPECT_EQ(back->repeat, m.repeat);
    if (carriesPosition(m.type)) {
      EXPECT_TRUE(back->hasPosition());
      expectSameNumber(back->longitude_deg, m.longitude_deg, 0.51 / 600000.0);
      expectSameNumber(back->latitude_deg, m.latitude_deg, 0.51 / 600000.0);
      EXPECT_EQ(back->second, m.second);
    }
    if (carriesMotion(m.type)) {
      expectSameNumber(back->speed_knots, m.speed_knots, 1e-6);
      expectSameNumber(back->course_deg, m.course_deg, 1e-6);
      expectSameNumber(back->heading_deg, m.heading_deg, 1e-6);
    }
    if (m.type <= 3) {
      EXPECT_EQ(back->turn, m.turn);
      EXPECT_EQ(back->status, m.status);
    }
    if (m.type == 5 || m.type == 19 || m.type == 21 || (m.type == 24 && m.part == 0)) {
      EXPECT_EQ(back->name, m.type == 21 ? m.name : m.name.substr(0, 20));
    }
    if (m.type == 5 || m.type == 19 || m.type == 21 || (m.type == 24 && m.part == 1)) {
      EXPECT_EQ(back->ship_type, m.ship_type);
      EXPECT_EQ(back->mothership, m.mothership);
    }
    if (carriesDimensions(m)) {
      EXPECT_EQ(back->to_bow_m, m.to_bow_m);
      EXPECT_EQ(back->to_starboard_m, m.to_starboard_m);
    }
  }
}

// Each field as gpsd's decoder has it.
void expectAsDecoded(const nlohmann::json& json, const Message& m) {
  const auto number = [&](const char* key, double none) {
    const double value = json.at(key).get<double>();
    return value == none ? kNotAvailable : value;
  };
  EXPECT_EQ(json.at("type"), m.type);
  EXPECT_EQ(json.at("mmsi"), m.mmsi);
  EXPECT_EQ(json.at("repeat"), m.repeat);
  if (carriesPosition(m.type)) {
    expectSameNumber(json.at("lon"), m.longitude_deg, 2e-6);
    expectSameNumber(json.at("lat"), m.latitude_deg, 2e-6);
    EXPECT_EQ(json.at("accuracy"), m.accurate);
    EXPECT_EQ(json.at("second"), m.second);
  }
  if (carriesMotion(m.type)) {
    if (json.at("speed").is_number()) {  // class A spells unknown and fastest out
      expectSameNumber(number("speed", 102.3), m.speed_knots, 0.051);
    }
    expectSameNumber(number("course", 360.0), m.course_deg, 0.051);
    expectSameNumber(number("heading", 511), m.heading_deg, 0.5);
  }
  if (m.type <= 3) {
    EXPECT_EQ(json.at("status"), m.status);
  }
  const bool has_static = m.type == 5 || m.type == 19 || m.type == 21;
  const bool part_b = m.type == 24 && m.part == 1;
  if (has_static || (m.type == 24 && m.part == 0)) {
    EXPECT_EQ(json.at(m.type == 21 ? "name" : "shipname"),
              m.type == 21 ? m.name : m.name.substr(0, 20));
  }
  if (carriesDimensions(m)) {
    EXPECT_EQ(json.at("to_bow"), m.to_bow_m);
    EXPECT_EQ(json.at("to_stern"), m.to_stern_m);
    EXPECT_EQ(json.at("to_port"), m.to_port_m);
    EXPECT_EQ(json.at("to_starboard"), m.to_starboard_m);
  } else if (part_b) {
    EXPECT_EQ(json.at("mothership_mmsi"), m.mothership);
  }
  if (has_static || part_b) {
    EXPECT_EQ(json.at(m.type == 21 ? "aid_type" : "shiptype"), m.ship_type);
  }
  if (m.type == 5 || part_b) {
    EXPECT_EQ(json.at("callsign"), m.callsign);
  }
  if (m.type == 5) {
    EXPECT_EQ(json.at("imo"), m.imo);
    EXPECT_EQ(json.at("destination"), m.destination);
    EXPECT_EQ(json.at("eta"), otter_nav::text("%02d-%02dT%02d:%02dZ", m.eta_month, m.eta_day,
                                              m.eta_hour, m.eta_minute));
    expectSameNumber(json.at("draught"), m.draught_m, 0.051);
  }
  if (m.type == 21) {
    EXPECT_EQ(json.at("off_position"), m.off_position);
    EXPECT_EQ(json.at("virtual_aid"), m.is_virtual);
  }
}

TEST(AisMessage, IsWhatGpsdDecodes) {
  if (std::string(GPSDECODE).empty()) {
    GTEST_SKIP() << "gpsdecode (Debian: gpsd-clients) is not installed";
  }
  const auto file = std::filesystem::temp_directory_path() /
                    ("otter_nav_ais_" + std::to_string(::getpid()) + ".nmea");
  Random random(6);
  std::vector<Message> sent;
  {
    std::ofstream out(file);
    for (int run = 0; run < 240; ++run) {
      sent.push_back(anyMessage(kTypes[run % 8], random));
      const auto sentences = encode(sent.back(), run % 2 == 0 ? 'A' : 'B', run % 10);
      for (const std::string& sentence : *sentences) {
        out << sentence << '\n';
      }
    }
  }
  // Part by part: by default the two halves of type 24 are joined.
  FILE* pipe = popen((std::string(GPSDECODE) + " -s < " + file.string()).c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string text;
  char piece[4096];
  while (std::fgets(piece, sizeof(piece), pipe) != nullptr) {
    text += piece;
  }
  pclose(pipe);
  std::filesystem::remove(file);
  std::istringstream lines(text);
  std::size_t k = 0;
  for (std::string line; std::getline(lines, line); ++k) {
    ASSERT_LT(k, sent.size());
    SCOPED_TRACE(line);
    expectAsDecoded(nlohmann::json::parse(line), sent[k]);
  }
  EXPECT_EQ(k, sent.size());
}

// Sentences from the air, with what gpsd says of them.
TEST(AisDecoder, ReadsWhatOthersSend) {
  Decoder decoder;
  const auto position = decoder.add("!AIVDM,1,1,,A,B52K>;h00Fc>jpUlNV@ikwpUoP06,0*4C");
  ASSERT_TRUE(position && *position);
  EXPECT_EQ((*position)->mmsi, 338087471U);
  EXPECT_NEAR((*position)->longitude_deg, -74.072132, 1e-6);
  EXPECT_NEAR((*position)->latitude_deg, 40.684540, 1e-6);
  EXPECT_NEAR((*position)->course_deg, 79.6, 1e-9);
  EXPECT_TRUE(std::isnan((*position)->heading_deg));
  const auto first = decoder.add(
      "\\s:r1,c:1*00\\!AIVDM,2,1,1,A,55?MbV02;H;s<HtKR20EHE:0@T4@Dn2222222216L961O5Gf0NSQEp6ClRp8,"
      "0*1C");
  ASSERT_TRUE(first && !*first);
  const auto whole = decoder.add("!AIVDM,2,2,1,A,88888888880,2*25");
  ASSERT_TRUE(whole && *whole);
  EXPECT_EQ((*whole)->name, "EVER DIADEM");
  EXPECT_EQ((*whole)->to_bow_m, 225);
  EXPECT_EQ((*whole)->to_starboard_m, 31);
  EXPECT_NEAR((*whole)->draught_m, 12.2, 1e-9);
}

TEST(AisDecoder, SaysWhatIsWrong) {
  const auto expectError = [](const std::string& sentence, const std::string& what) {
    Decoder decoder;
    const auto result = decoder.add(sentence);
    ASSERT_FALSE(result) << sentence;
    EXPECT_NE(result.error().message.find(what), std::string::npos) << result.error().message;
  };
  const auto summed = [](const std::string& body) {
    unsigned sum = 0;
    for (const char c : body) {
      sum ^= static_cast<unsigned char>(c);
    }
    char tail[8];
    std::snprintf(tail, sizeof(tail), "*%02X", sum);
    return "!" + body + tail;
  };
  expectError("", "no AIS sentence");
  expectError("!AIVDM,1,1,,A,B52K>;h00Fc>jpUlNV@ikwpUoP06,0", "'*'");
  expectError("!AIVDM,1,1,,A,B52K>;h00Fc>jpUlNV@ikwpUoP06,0*4D", "checksum");
  expectError("!AIVDM,1,1,,A,B52K>;h00Fc>jpUlNV@ikwpUoP07,0*4C", "checksum");
  expectError(summed("AIVDM,1,1,,A,B52K>;h00Fc"), "6 fields");
  expectError(summed("AIVDM,1,2,,A,B52K,0"), "part");
  expectError(summed("AIVDM,1,1,,A,B52K,7"), "fill");
  expectError(summed("AIVDM,1,1,,A,B52[,0"), "letter");
  expectError(summed("AIVDM,1,1,,A,B52K>;h00Fc,0"), "bits");
  expectError(summed("AIVDM,1,1,,A,,0"), "bits");
  expectError(summed("AIVDM,2,2,1,A,88888888880,2"), "without the one before");
  expectError(summed("GPGGA,1,1,,A,88888888880,2"), "GPGGA");
  Decoder decoder;
  EXPECT_FALSE(*decoder.add(summed("AIVDO,1,1,,A,B52K>;h00Fc>jpUlNV@ikwpUoP06,0")));
  EXPECT_FALSE(*decoder.add(summed("AIVDM,1,1,,A,402M3@000Htt<tSF0l4Q@000H400,0")));  // type 4
  EXPECT_FALSE(encode(Message{}, 'A', 0));
}

// Noise of every kind ends in an error or in nothing, never in anything worse.
TEST(AisDecoder, BearsNoise) {
  Random random(9);
  Decoder decoder;
  for (int run = 0; run < 20000; ++run) {
    std::string body = "AIVDM,1,1,,A,";
    for (int k = whole(random, 0, 80); k > 0; --k) {
      body += static_cast<char>(whole(random, 33, 126));
    }
    body += ",0";
    unsigned sum = 0;
    for (const char c : body) {
      sum ^= static_cast<unsigned char>(c);
    }
    char tail[8];
    std::snprintf(tail, sizeof(tail), "*%02X", sum);
    (void)decoder.add("!" + body + tail);
  }
}

// From 360 on a bearing is none: not a full turn and some more. What rounds up to 360 is north.
TEST(AisMessage, TakesNoBearingBeyondAFullTurn) {
  BitWriter writer;
  writer.number(405, 9);
  writer.number(3700, 12);
  writer.number(359, 9);
  BitReader reader(writer.bits());
  double heading = 0.0;
  double course = 0.0;
  double known = 0.0;
  reader.bearing(heading, 9, 1.0, 511);
  reader.bearing(course, 12, 0.1, 3600);
  reader.bearing(known, 9, 1.0, 511);
  EXPECT_TRUE(std::isnan(heading));
  EXPECT_TRUE(std::isnan(course));
  EXPECT_EQ(known, 359.0);
  BitWriter north;
  north.bearing(359.7, 9, 1.0, 511);
  BitReader back(north.bits());
  back.bearing(known, 9, 1.0, 511);
  EXPECT_EQ(known, 0.0);
}

}  // namespace
}  // namespace otter_nav::ais
