// What the vessel should do along the horizon: states and thrusts that follow the trajectory's
// position exactly with the tracker's own model, the disturbance estimate included.
//
// The trajectory gives z(t) and its derivatives; the heading, the other states and the thrusts
// follow by the manoeuvring model's inverse dynamics (vessel/inverse_dynamics.hpp).
#pragma once

#include <limits>

#include "otter_nav/tracker/options.hpp"
#include "otter_nav/trajectory/timed_trajectory.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/model.hpp"
#include "tracker/ocp/problem.hpp"

namespace otter_nav::tracker {

class ReferenceSource {
 public:
  ReferenceSource(const Options& options, const vessel::Parameters& vessel);

  // A new trajectory, which stays where it is; the reference starts at psi of the trajectory, and
  // in wind that says how the hull lies at its own.
  void start(const trajectory::TimedTrajectory& sailed, double now_s);
  // From now on the reference is led from `offset` (position and velocity off the trajectory's,
  // earth frame) to the trajectory within `duration_s`.
  void join(double now_s, const Eigen::Vector2d& offset, const Eigen::Vector2d& velocity_offset,
            double duration_s);

  // From now on, until the next start(): at rest there, on this heading; what lies abeam by less
  // than `free_abeam_m` is not worth turning for.
  void rest(const Eigen::Vector2d& position, double psi_rad, double free_abeam_m = 0.0);

  // Stages at `start_s` + k step_s; psi near `psi_near_rad`, continuous along the horizon, and on
  // the side of the wind that the reference's corridor is on.
  void fill(double start_s, double step_s, int stages, double psi_near_rad,
            const vessel::Disturbance& disturbance, OcpReference& reference);
  // One state, for comparison and display.
  [[nodiscard]] trajectory::Sample at(double time_s) const;
  [[nodiscard]] vessel::FlatPoint flat(double time_s) const;
  [[nodiscard]] double end() const;
  // Lets the reference wait for a vessel at `position`, or catch up; call once a control step.
  void wait(double now_s, const Eigen::Vector2d& position);
  [[nodiscard]] bool rests() const { return rests_; }
  // Its headings are meant, whatever the wind.
  [[nodiscard]] bool isRolledOut() const { return rolled_out_ && !rests_; }

 private:
  struct Course;
  [[nodiscard]] Course course(double time_s) const;
  [[nodiscard]] bool joining(double time_s) const;
  [[nodiscard]] static bool isAstern(const Course& course, double psi_rad);
  // The heading a step of `dt_s` after `psi_rad`.
  [[nodiscard]] vessel::SwayHeading heading(const Course& course, double psi_rad, double dt_s,
                                            const vessel::Disturbance& disturbance) const;
  void fillFlat(double start_s, double step_s, int stages, const vessel::Disturbance& disturbance,
                OcpReference& reference);
  void fillPlain(double start_s, double step_s, int stages, OcpReference& reference) const;

  Method method_;
  vessel::Parameters vessel_;
  vessel::InverseDynamics inverse_;  // of the paper's model in still water
  const trajectory::Trajectory* trajectory_ = nullptr;
  double start_s_ = 0.0;
  double lag_s_ = 0.0;  // of the reference behind the trajectory's own time
  double speed_max_mps_ = std::numeric_limits<double>::infinity();
  double waited_at_s_ = 0.0;
  trajectory::Piece joining_;
  double joining_start_s_ = 0.0;
  bool rolled_out_ = false;
  bool joins_ = false;
  bool rests_ = false;
  Eigen::Vector2d rest_position_ = Eigen::Vector2d::Zero();
  double rest_psi_rad_ = 0.0;
  double rest_free_abeam_m_ = 0.0;
  // The heading's own state, at a time.
  double psi_rad_ = 0.0;
  double psi_time_s_ = 0.0;
  bool in_corridor_ = false;
  bool stern_to_wind_ = false;
  bool started_ = false;
};

}  // namespace otter_nav::tracker
