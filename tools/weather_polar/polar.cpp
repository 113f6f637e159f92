#include "weather_polar/polar.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/vessel/steady_motion.hpp"

namespace otter_nav::tools {
namespace {

using Eigen::Vector2d;

Vector2d along(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

// Wind and force blow towards -x: angles from x are those from where they come from.
vessel::Disturbance weatherOf(double wind_mps, double force_n, double current_mps) {
  vessel::Disturbance weather;
  weather.wind_mps = {-wind_mps, 0.0};
  weather.force_n = {-force_n, 0.0};
  weather.current_mps = {-current_mps, 0.0};
  return weather;
}

// On the headings that the mean allows, what the gust asks for besides while they are held: its
// side force sets the vessel aside, which is the clearance's to allow for.
PolarPoint pointOf(const vessel::Parameters& vessel, const PolarOptions& options, PolarPoint p) {
  const Vector2d velocity = p.speed_mps * along(p.course_rad);
  const vessel::Disturbance mean = weatherOf(p.wind_mps, p.force_n, options.current_mps);
  const double more = 1.0 + options.gust;
  const vessel::Disturbance gust =
      weatherOf(more * p.wind_mps, more * p.force_n, options.current_mps);
  p.thrust_share = std::numeric_limits<double>::infinity();
  for (const vessel::SteadyMotion& way :
       vessel::steadyHeadings(velocity, p.course_rad, vessel, mean)) {
    const double share = std::max(
        way.thrust_share, vessel::steadyOn(way.psi_rad, velocity, vessel, gust).thrust_share);
    if (share < p.thrust_share) {
      p.thrust_share = share;
      p.heading_rad = wrapAngle(way.psi_rad);
    }
  }
  p.held = p.thrust_share <= 1.0 - options.reserve;
  return p;
}

// ---- The picture

constexpr double kPanel = 300.0;  // px
constexpr double kRadius = 120.0;
constexpr int kColumns = 2;

std::string colour(double share) {
  const int light = static_cast<int>(std::lround(80.0 - 55.0 * std::clamp(share, 0.0, 1.0)));
  return "hsl(210,60%," + std::to_string(light) + "%)";
}

class Rose {
 public:
  Rose(std::ostream& out, const Vector2d& centre, double top_mps)
      : out_(out), centre_(centre), px_per_mps_(kRadius / top_mps) {}

  void frame(double top_mps, const std::string& caption) {
    const double ring = top_mps > 2.5 ? 1.0 : 0.5;
    for (double speed = ring; speed <= top_mps + 1e-9; speed += ring) {
      out_ << "<circle cx='" << centre_.x() << "' cy='" << centre_.y() << "' r='"
           << speed * px_per_mps_ << "' fill='none' stroke='#bbb' stroke-width='0.5'/>\n"
           << "<text x='" << centre_.x() + 2.0 << "' y='" << centre_.y() - speed * px_per_mps_ - 2.0
           << "' font-size='8' fill='#777'>" << speed << "</text>\n";
    }
    out_ << "<text x='" << centre_.x() << "' y='" << centre_.y() - kRadius - 14.0
         << "' font-size='12' text-anchor='middle'>" << caption << "</text>\n";
  }
  void ray(double course_rad, double from_mps, double to_mps, double share) {
    const Vector2d a = at(course_rad, from_mps);
    const Vector2d b = at(course_rad, to_mps);
    out_ << "<path d='M" << a.x() << ' ' << a.y() << 'L' << b.x() << ' ' << b.y() << "' stroke='"
         << colour(share) << "' stroke-width='3'/>\n";
  }

 private:
  [[nodiscard]] Vector2d at(double course_rad, double speed_mps) const {
    return centre_ +
           speed_mps * px_per_mps_ * Vector2d(-std::sin(course_rad), -std::cos(course_rad));
  }

  std::ostream& out_;
  Vector2d centre_;
  double px_per_mps_;
};

bool sameWeather(const PolarPoint& a, const PolarPoint& b) {
  return a.wind_mps == b.wind_mps && a.force_n == b.force_n;
}

// Neighbouring speeds of one shade are one stroke.
void drawRays(Rose& rose, const PolarPoint* begin, const PolarPoint* end, double step_mps) {
  constexpr int kShades = 5;
  const auto shade = [](const PolarPoint& p) {
    return p.held ? static_cast<int>(std::floor(kShades * p.thrust_share)) : -1;
  };
  for (const PolarPoint* p = begin; p != end;) {
    const PolarPoint* q = p;
    while (q != end && q->course_rad == p->course_rad && shade(*q) == shade(*p)) {
      ++q;
    }
    if (p->held) {
      rose.ray(p->course_rad, p->speed_mps, (q - 1)->speed_mps + step_mps,
               (shade(*p) + 0.5) / kShades);
    }
    p = q;
  }
}

}  // namespace

Result<std::vector<PolarPoint>> polar(const vessel::Parameters& vessel,
                                      const PolarOptions& options) {
  if (!options.winds_mps.empty() && !vessel.manoeuvring.feelsWind()) {
    return failure("vessel '" + vessel.name +
                   "' has no wind loads in its file: ask for forces instead");
  }
  std::vector<PolarPoint> points;
  const auto add = [&](double wind_mps, double force_n) {
    for (int k = 0; k < options.courses; ++k) {
      const int speeds = static_cast<int>(vessel.top_speed_mps / options.speed_step_mps + 1e-9);
      for (int i = 0; i <= speeds; ++i) {
        PolarPoint point;
        point.wind_mps = wind_mps;
        point.force_n = force_n;
        point.course_rad = 2.0 * kPi * k / options.courses;
        point.speed_mps = i * options.speed_step_mps;
        points.push_back(pointOf(vessel, options, point));
      }
    }
  };
  for (const double wind : options.winds_mps) {
    add(wind, 0.0);
  }
  for (const double force : options.forces_n) {
    add(0.0, force);
  }
  return points;
}

Status savePolarCsv(const std::string& path, const std::vector<PolarPoint>& points) {
  std::ofstream out(path);
  out << "wind_mps,force_n,course_rad,speed_mps,held,heading_rad,thrust_share\n";
  for (const PolarPoint& p : points) {
    out << p.wind_mps << ',' << p.force_n << ',' << p.course_rad << ',' << p.speed_mps << ','
        << (p.held ? 1 : 0) << ',' << p.heading_rad << ',' << p.thrust_share << '\n';
  }
  out.close();
  return out ? Status{} : failure(path + " can't be written");
}

Status savePolarSvg(const std::string& path, const std::string& title,
                    const std::vector<PolarPoint>& points, double speed_step_mps) {
  std::ostringstream body;
  body << std::setprecision(4);
  double top_mps = 0.1;
  for (const PolarPoint& p : points) {
    top_mps = std::max(top_mps, p.held ? p.speed_mps + speed_step_mps : 0.0);
  }
  top_mps = 0.5 * std::ceil(2.0 * top_mps);
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++count) {
    std::size_t j = i;
    while (j < points.size() && sameWeather(points[i], points[j])) {
      ++j;
    }
    const Vector2d centre(kPanel * (count % kColumns + 0.5),
                          30.0 + kPanel * (std::floor(count / kColumns) + 0.5));
    Rose rose(body, centre, top_mps);
    std::ostringstream caption;
    if (points[i].wind_mps > 0.0 || points[i].force_n == 0.0) {
      caption << points[i].wind_mps << " m/s of wind";
    } else {
      caption << points[i].force_n << " N";
    }
    drawRays(rose, points.data() + i, points.data() + j, speed_step_mps);
    rose.frame(top_mps, caption.str());
    i = j;
  }
  const int rows = (count + kColumns - 1) / kColumns;
  std::ofstream out(path);
  out << "<svg xmlns='http://www.w3.org/2000/svg' width='" << kColumns * kPanel << "' height='"
      << 30.0 + rows * kPanel << "' font-family='sans-serif'>\n"
      << "<rect width='100%' height='100%' fill='white'/>\n"
      << "<text x='" << 0.5 * kColumns * kPanel << "' y='20' font-size='14' text-anchor='middle'>"
      << title << "</text>\n"
      << body.str() << "</svg>\n";
  out.close();
  return out ? Status{} : failure(path + " can't be written");
}

}  // namespace otter_nav::tools
