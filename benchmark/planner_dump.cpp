#include "planner_dump.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "otter_nav/trajectory/motion_along.hpp"

namespace otter_nav::benchmark {

Status dumpTrajectory(const trajectory::Trajectory& trajectory, const vessel::Parameters& vessel,
                      const std::string& path) {
  constexpr double kStepS = 0.02;
  constexpr double kSameInstantS = 1e-9;
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "w"),
                                                             &std::fclose);
  if (!file) {
    return failure("can't write the dump " + path);
  }
  std::fputs("t,x,y,psi,u,v,r,tau_u,tau_r\n", file.get());
  const double duration = trajectory.duration();
  const trajectory::MotionAlong motion(trajectory, vessel, {});
  const auto row = [&](double t) {
    const trajectory::Sample s = motion.sample(t);
    std::fprintf(file.get(), "%.9f,%.9f,%.9f,%.9f,%.9f,%.9f,%.9f,%.9f,%.9f\n", t, s.state[0],
                 s.state[1], s.state[2], s.state[3], s.state[4], s.state[5], s.tau.surge_n,
                 s.tau.yaw_nm);
  };
  const auto steps = static_cast<long>(std::floor((duration - kSameInstantS) / kStepS));
  for (long i = 0; i <= steps; ++i) {
    row(kStepS * static_cast<double>(i));
  }
  row(duration);
  return {};
}

}  // namespace otter_nav::benchmark
