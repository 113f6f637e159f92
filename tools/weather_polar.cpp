// Writes what speeds a vessel can hold on which courses in which wind: a CSV and a picture.
#include <CLI/CLI.hpp>
#include <iostream>

#include "number_in.hpp"
#include "otter_nav/base/first_failure.hpp"
#include "weather_polar/polar.hpp"

namespace {

using namespace otter_nav;

struct Arguments {
  std::string vessel = "otter_gazebo";
  std::string out = "polar";
  tools::PolarOptions polar;
};

Status run(const Arguments& a) {
  const auto vessel = vessel::loadParameters(a.vessel);
  if (!vessel) {
    return failure(vessel.error().message);
  }
  tools::PolarOptions options = a.polar;
  if (options.winds_mps.empty() && options.forces_n.empty()) {
    options.winds_mps = {4.0, 6.0, 8.0, 10.0};
  }
  const auto points = tools::polar(*vessel, options);
  if (!points) {
    return failure(points.error().message);
  }
  const Status csv = tools::savePolarCsv(a.out + ".csv", *points);
  const Status svg = tools::savePolarSvg(a.out + ".svg",
                                         vessel->name + ": m/s over ground, up is against the wind",
                                         *points, options.speed_step_mps);
  return firstFailure(csv, svg);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app{
      "Writes OUT.csv and OUT.svg: on each course the speeds over ground that a vessel can hold in "
      "a\n"
      "wind, with the heading and the share of its thrust that takes. Courses count from where "
      "the\n"
      "wind comes from."};
  app.add_option("--vessel", a.vessel, "NAME of config/vessels or a YAML file")
      ->capture_default_str();
  app.add_option("--wind", a.polar.winds_mps, "m/s, any number of them (default: 4 6 8 10)")
      ->check(tools::numberIn(0.0, 40.0));
  app.add_option("--force", a.polar.forces_n,
                 "N, fixed in the earth frame: for vessels without wind loads")
      ->check(tools::numberIn(0.0, 1e5));
  app.add_option("--gust", a.polar.gust, "share by which gusts exceed the mean")
      ->check(tools::numberIn(0.0, 5.0))
      ->capture_default_str();
  app.add_option("--current", a.polar.current_mps, "m/s along the wind, or against it (negative)")
      ->check(tools::numberIn(-5.0, 5.0))
      ->capture_default_str();
  app.add_option("--reserve", a.polar.reserve, "of the thrusters' limits, left over")
      ->check(tools::numberIn(0.0, 0.9))
      ->capture_default_str();
  app.add_option("--courses", a.polar.courses, "of a full turn")
      ->check(tools::numberIn(4, 720))
      ->capture_default_str();
  app.add_option("--step", a.polar.speed_step_mps, "of the speeds, m/s")
      ->check(tools::numberIn(0.01, 1.0))
      ->capture_default_str();
  app.add_option("--out", a.out, "path of both files, without their endings")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (const Status status = run(a); !status) {
    std::cerr << "weather_polar: " << status.error().message << '\n';
    return 2;
  }
  return 0;
}
