#include "ais_transmitters.hpp"

#include <cmath>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::plant {
namespace {

constexpr double kPositionNoiseM = 1.5;  // standard deviation of a small vessel's GNSS, each axis
constexpr double kCourseNoiseRad = 0.02;
constexpr double kStaticPeriodS = 360.0;
constexpr std::uint32_t kFirstMmsi = 200000000;
constexpr std::uint32_t kMmsiCount = 600000000;

double positionPeriod(double speed_mps) {
  const double knots = speed_mps / ais::kKnotMps;
  if (knots > 23.0) {
    return 5.0;
  }
  if (knots > 14.0) {
    return 15.0;
  }
  return knots > 2.0 ? 30.0 : 180.0;
}

std::uint32_t mmsiOf(int id) {
  return kFirstMmsi + static_cast<std::uint32_t>(id) % kMmsiCount;
}

double degreesFromNorth(double rad_from_east) {
  const double degrees = 90.0 - rad_from_east * 180.0 / kPi;
  return degrees - 360.0 * std::floor(degrees / 360.0);
}

ais::Message staticPart(const OtherVessel& other, int part) {
  ais::Message m;
  m.type = 24;
  m.mmsi = mmsiOf(other.id);
  m.part = part;
  m.name = "VESSEL " + std::to_string(other.id);
  m.ship_type = 37;  // pleasure craft
  const int length = static_cast<int>(std::ceil(other.hull.length_m));
  const int beam = static_cast<int>(std::ceil(other.hull.beam_m));
  m.to_bow_m = (length + 1) / 2;
  m.to_stern_m = length / 2;
  m.to_port_m = (beam + 1) / 2;
  m.to_starboard_m = beam / 2;
  return m;
}

}  // namespace

void AisTransmitters::set(const std::vector<vessel::ScriptedVessel>& scripts, double time_s) {
  transmitters_.clear();
  for (const vessel::ScriptedVessel& script : scripts) {
    const double phase = random_.uniform();
    const double first =
        time_s + phase * positionPeriod(vessel::motionAt(script, time_s).speed_mps);
    transmitters_.push_back({script.ais, first, first});
  }
}

void AisTransmitters::advance(const std::vector<OtherVessel>& others, double time_s,
                              std::vector<std::string>& sentences) {
  for (std::size_t k = 0; k < transmitters_.size(); ++k) {
    Transmitter& transmitter = transmitters_[k];
    if (!transmitter.on) {
      continue;
    }
    if (time_s >= transmitter.next_position_s) {
      send(positionOf(others[k], time_s), sentences);
      transmitter.next_position_s = time_s + positionPeriod(others[k].motion.speed_mps);
    }
    if (time_s >= transmitter.next_static_s) {
      send(staticPart(others[k], 0), sentences);
      send(staticPart(others[k], 1), sentences);
      transmitter.next_static_s = time_s + kStaticPeriodS;
    }
  }
}

void AisTransmitters::send(const ais::Message& message, std::vector<std::string>& sentences) {
  sequence_ = (sequence_ + 1) % 10;
  const auto parts = ais::encode(message, sequence_ % 2 == 0 ? 'A' : 'B', sequence_);
  sentences.insert(sentences.end(), parts->begin(), parts->end());  // its type is one that is known
}

ais::Message AisTransmitters::positionOf(const OtherVessel& other, double time_s) {
  ais::Message m;
  m.type = 18;
  m.mmsi = mmsiOf(other.id);
  const Eigen::Vector2d noise(random_.normal(), random_.normal());
  const Eigen::Vector2d degrees =
      frame_.toDegrees(other.motion.pose.position + kPositionNoiseM * noise);
  m.latitude_deg = degrees.x();
  m.longitude_deg = degrees.y();
  m.accurate = true;
  m.speed_knots = other.motion.speed_mps / ais::kKnotMps;
  const double course = other.motion.pose.psi_rad + kCourseNoiseRad * random_.normal();
  if (other.motion.speed_mps > 0.0) {
    m.course_deg = degreesFromNorth(course);
  }
  m.second = static_cast<int>(std::fmod(time_s, 60.0));
  return m;
}

}  // namespace otter_nav::plant
