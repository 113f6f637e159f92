// The bits of each message, written once for reading and writing.
#pragma once

#include "otter_nav/ais/message.hpp"

namespace otter_nav::ais {

// `bits` takes each field in turn:
//   number(value, width)                      unsigned; signedNumber() two's complement
//   scaled(value, width, unit, none)          value / unit as a whole number, `none` for unknown
//   scaledSigned(...)                         the same in two's complement
//   bearing(...)                              degrees, 0 up to 360: from there on unknown
//   flag(value), text(value, letters), spare(width), rest(value, letters)
template <typename Bits>
void position(Message& m, Bits& bits) {
  constexpr double kTenThousandthMinute = 1.0 / 600000.0;
  bits.flag(m.accurate);
  bits.scaledSigned(m.longitude_deg, 28, kTenThousandthMinute, 181 * 600000);
  bits.scaledSigned(m.latitude_deg, 27, kTenThousandthMinute, 91 * 600000);
}

template <typename Bits>
void motion(Message& m, Bits& bits) {
  bits.scaled(m.speed_knots, 10, 0.1, 1023);
  position(m, bits);
  bits.bearing(m.course_deg, 12, 0.1, 3600);
  bits.bearing(m.heading_deg, 9, 1.0, 511);
  bits.number(m.second, 6);
}

template <typename Bits>
void dimensions(Message& m, Bits& bits) {
  bits.number(m.to_bow_m, 9);
  bits.number(m.to_stern_m, 9);
  bits.number(m.to_port_m, 6);
  bits.number(m.to_starboard_m, 6);
}

template <typename Bits>
void classAPosition(Message& m, Bits& bits) {
  bits.number(m.status, 4);
  bits.signedNumber(m.turn, 8);
  motion(m, bits);
  bits.spare(2 + 3 + 1 + 19);  // manoeuvre, spare, RAIM, radio
}

template <typename Bits>
void classAStatic(Message& m, Bits& bits) {
  bits.spare(2);  // version
  bits.number(m.imo, 30);
  bits.text(m.callsign, 7);
  bits.text(m.name, 20);
  bits.number(m.ship_type, 8);
  dimensions(m, bits);
  bits.number(m.position_fix, 4);
  bits.number(m.eta_month, 4);
  bits.number(m.eta_day, 5);
  bits.number(m.eta_hour, 5);
  bits.number(m.eta_minute, 6);
  bits.scaled(m.draught_m, 8, 0.1, 0);
  bits.text(m.destination, 20);
  bits.spare(1 + 1);  // data terminal, spare
}

template <typename Bits>
void classBPosition(Message& m, Bits& bits) {
  bits.spare(8);
  motion(m, bits);
  if (m.type == 18) {
    bits.spare(2 + 7 + 20);  // regional, equipment's flags, radio
    return;
  }
  bits.spare(4);
  bits.text(m.name, 20);
  bits.number(m.ship_type, 8);
  dimensions(m, bits);
  bits.number(m.position_fix, 4);
  bits.spare(1 + 1 + 1 + 4);  // RAIM, data terminal, assigned, spare
}

template <typename Bits>
void aid(Message& m, Bits& bits) {
  bits.number(m.ship_type, 5);
  bits.text(m.name, 20);
  position(m, bits);
  dimensions(m, bits);
  bits.number(m.position_fix, 4);
  bits.number(m.second, 6);
  bits.flag(m.off_position);
  bits.spare(8 + 1);  // regional, RAIM
  bits.flag(m.is_virtual);
  bits.spare(1 + 1);  // assigned, spare
  bits.rest(m.name, 20, 14);
}

// Whether an MMSI is that of a craft that belongs to a mother ship.
inline bool isAuxiliary(std::uint32_t mmsi) {
  return mmsi / 10000000U == 98U;
}

template <typename Bits>
void classBStatic(Message& m, Bits& bits) {
  bits.number(m.part, 2);
  if (m.part == 0) {
    bits.text(m.name, 20);
    bits.spare(8);
    return;
  }
  bits.number(m.ship_type, 8);
  bits.spare(18 + 4 + 20);  // vendor, model, serial number
  bits.text(m.callsign, 7);
  if (isAuxiliary(m.mmsi)) {
    bits.number(m.mothership, 30);
  } else {
    dimensions(m, bits);
  }
  bits.spare(6);
}

// False for a type that isn't handled.
template <typename Bits>
bool layout(Message& m, Bits& bits) {
  bits.number(m.type, 6);
  bits.number(m.repeat, 2);
  bits.number(m.mmsi, 30);
  switch (m.type) {
    case 1:
    case 2:
    case 3:
      classAPosition(m, bits);
      return true;
    case 5:
      classAStatic(m, bits);
      return true;
    case 18:
    case 19:
      classBPosition(m, bits);
      return true;
    case 21:
      aid(m, bits);
      return true;
    case 24:
      classBStatic(m, bits);
      return true;
    default:
      return false;
  }
}

}  // namespace otter_nav::ais
