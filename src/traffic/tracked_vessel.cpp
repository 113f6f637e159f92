#include "tracked_vessel.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::traffic {
namespace {

// Standard deviations of a middle found from echoes. Errors of scan after scan are alike (the fit
// is wrong in the same way), so that they weigh less than fifteen of them a second would.
constexpr double kSeenSideM = 0.5;
constexpr double kGuessedSideM = 0.7;
constexpr double kMeasuredSideM = 0.2;  // where the sides themselves tell how the hull lies
constexpr double kLeastSizeM = 0.5;
constexpr int kYoungHits = 5;
// A heading that is known within this much tells how long and how broad a hull is.
constexpr double kHeadingForSizeRad = 0.3;

constexpr double kLeastCourseSpeedMps = 0.3;
constexpr double kLeastUnderWayMps = 0.6;
constexpr double kCourseSigmas = 2.5;
constexpr double kBriefTurnS = 5.0;  // in which a turn just begun dies out

// A cluster in the axes of a hull: what is seen of it, and from where. A side is seen whole when
// the line of sight doesn't graze it.
struct View {
  Span along;
  Span athwart;
  double eye_along = 0.0;
  double eye_athwart = 0.0;
  bool from_beside = false;  // the long sides' one is seen
  bool from_end = false;     // bow or stern is

  View(const Cluster& cluster, const Eigen::Vector2d& eye, const Eigen::Vector2d& ahead)
      : along(spanOf(cluster.points, ahead)),
        athwart(spanOf(cluster.points, across(ahead))),
        eye_along(ahead.dot(eye)),
        eye_athwart(across(ahead).dot(eye)),
        from_beside(looksAt(eye_athwart, athwart, eye_along, along)),
        from_end(looksAt(eye_along, along, eye_athwart, athwart)) {
    if (cluster.first_hidden) {
      hide(cluster.points.begin(), cluster.points.end(), ahead);
    }
    if (cluster.last_hidden) {
      hide(cluster.points.rbegin(), cluster.points.rend(), ahead);
    }
  }

  // Whether an end of the spans is where something nearer begins, and not the hull's.
  struct Hidden {
    bool low = false;
    bool high = false;
    [[nodiscard]] bool any() const { return low || high; }
  };
  Hidden along_hidden;
  Hidden athwart_hidden;

 private:
  // The hull goes on beyond its first point, the way its echoes run there: along its side or its
  // end.
  template <typename Points>
  void hide(Points first, Points last, const Eigen::Vector2d& ahead) {
    constexpr double kRunM = 0.6;
    const auto inner =
        std::find_if(first, last, [&](const auto& p) { return (p - *first).norm() > kRunM; });
    const Eigen::Vector2d run = *first - (inner == last ? *std::prev(last) : *inner);
    const double runs_along = ahead.dot(run);
    const double runs_athwart = across(ahead).dot(run);
    const bool on_side = std::abs(runs_along) >= std::abs(runs_athwart);
    Hidden& ends = on_side ? along_hidden : athwart_hidden;
    ((on_side ? runs_along : runs_athwart) > 0.0 ? ends.high : ends.low) = true;
  }
  static double outside(double value, const Span& span) {
    return std::max({0.0, span.low - value, value - span.high});
  }
  static bool looksAt(double eye, const Span& side, double eye_past, const Span& past) {
    constexpr double kLeastSlope = 0.25;  // 14 degrees
    const double farthest = std::max(std::abs(eye_past - past.low), std::abs(eye_past - past.high));
    return outside(eye, side) > kLeastSlope * farthest;
  }
};

// The middle along an axis, with its standard deviation.
struct Middle {
  double at = 0.0;
  double deviation_m = 0.0;
};

// `eye`: the sensor along this axis; `whole_seen`: whether it sees the sides that lie along it. If
// not, only the near end is seen, and the middle is half the size away. `seen_side_m`: how well a
// side that is seen tells the middle.
Middle middleAlong(const Span& span, const View::Hidden& hidden, double eye, bool whole_seen,
                   double size_m, bool size_known, double seen_side_m) {
  const bool whole = whole_seen && !hidden.any() && span.length() > 0.8 * size_m;
  if (whole || (whole_seen && !hidden.any() && !size_known)) {
    return {span.middle(), seen_side_m};
  }
  const double half = 0.5 * size_m;
  if (hidden.low && hidden.high) {
    return {span.middle(), std::max(kGuessedSideM, half)};
  }
  const double deviation = size_known ? seen_side_m : kGuessedSideM;
  const bool from_low =
      hidden.any() ? hidden.high : std::abs(eye - span.low) < std::abs(eye - span.high);
  return {from_low ? span.low + half : span.high - half, deviation};
}

// m/s, either axis.
double velocityDeviation(const MotionFilter& motion) {
  return std::sqrt(0.5 * motion.usualCovariance().block<2, 2>(2, 2).trace());
}

// Of who comes into range abeam only a part is seen, and more with every scan: along `axis`, at a
// steady distance from her end that is in range.
double besideTheNearerEnd(const Cluster& cluster, const Eigen::Vector2d& eye,
                          const Eigen::Vector2d& axis, double distance_m) {
  const Eigen::Vector2d& first = cluster.points.front();
  const Eigen::Vector2d& last = cluster.points.back();
  const bool first_is_nearer = (first - eye).norm() < (last - eye).norm();
  const double near = axis.dot(first_is_nearer ? first : last);
  const double far = axis.dot(first_is_nearer ? last : first);
  return near + (far > near ? distance_m : -distance_m);
}

// What a cluster shows of her size; `anew`: it counts as if nothing were known. Whether she is as
// large as that from now on, or at least so large.
bool takeSize(TrackedVessel& vessel, const Cluster& cluster, const View& view, double shrinks,
              bool anew) {
  constexpr double kGrows = 0.3;  // of the difference, a scan
  const bool unknown = anew || vessel.size == TrackedVessel::Size::kGuessed;
  const auto learn = [&](double& known_m, double seen_m) {
    known_m += (unknown ? 1.0 : (seen_m > known_m ? kGrows : shrinks)) * (seen_m - known_m);
  };
  // Both have to be seen before a guess is left; what is cut off is longer than it seems.
  if (cluster.isCut() || (unknown && !(view.from_beside && view.from_end))) {
    vessel.length_m = std::max(vessel.length_m, view.along.length());
    vessel.beam_m = std::max(vessel.beam_m, view.athwart.length());
    return false;
  }
  if (view.from_beside) {
    learn(vessel.length_m, std::max(view.along.length(), kLeastSizeM));
  }
  if (view.from_end) {
    learn(vessel.beam_m, std::max(view.athwart.length(), kLeastSizeM));
  }
  vessel.size = TrackedVessel::Size::kSeen;
  return true;
}

}  // namespace

std::optional<double> TrackedVessel::course() const {
  const MotionState x = motion.usualState();
  const double speed = x.segment<2>(2).norm();
  if (speed < kLeastCourseSpeedMps || speed < kCourseSigmas * velocityDeviation(motion)) {
    return std::nullopt;
  }
  return std::atan2(x[3], x[2]);
}

bool TrackedVessel::followCourse() {
  const std::optional<double> now = course();
  const bool first = now && !heading_rad;
  if (now) {
    heading_rad = wrapAngle(*now + leeway_rad);
    has_moved = true;
  }
  return first;
}

void TrackedVessel::findPlace(double now_s) {
  constexpr double kPlaceM = 2.0;
  constexpr double kForS = 15.0;
  const Eigen::Vector2d here = motion.usualState().head<2>();
  if (placed_s == kLongAgoS || course() || (here - place).norm() > kPlaceM) {
    place = here;
    placed_s = now_s;
  }
  stays = now_s - placed_s > kForS;
}

void TrackedVessel::lookedAt(const Cluster& cluster, double now_s) {
  // A side that comes into sight is met where nothing was, as a bow is, until it has stood a while.
  constexpr double kShare = 0.5;
  constexpr double kShareLying = 0.3;
  constexpr double kGapS = 0.5;  // unseen for longer, she may have gone, and another come
  if (!is_mapped && now_s - looked_s > kGapS) {
    stands_since_s = kLongAgoS;
  }
  looked_s = now_s;
  const double share = is_mapped ? kShareLying : kShare;
  const bool moves = is_mapped ? isUnderWay() : course().has_value();
  if (moves || cluster.standing_points < share * static_cast<double>(cluster.points.size())) {
    stands_since_s = kLongAgoS;
  } else if (stands_since_s == kLongAgoS) {
    stands_since_s = now_s;
  }
}

bool TrackedVessel::liesStill(double now_s, double for_s) const {
  return stands_since_s != kLongAgoS && now_s - stands_since_s > for_s;
}

void TrackedVessel::compare(const Cluster& cluster, double surprise2) {
  constexpr int kLastLooks = 30;
  constexpr double kLeastM = 0.01;
  const double now_m = (cluster.points.back() - cluster.points.front()).norm();
  if (looks > 0) {
    const double change = std::abs(now_m - shows_m) / std::max({now_m, shows_m, kLeastM});
    const int of = std::min(looks, kLastLooks);
    changes += (change - changes) / of;
    surprises2 += (surprise2 - surprises2) / of;
  }
  shows_m = now_m;
  ++looks;
}

bool TrackedVessel::isAlike() const {
  constexpr double kMostChanges = 0.15;
  constexpr double kMostSurprises2 = 0.5;
  return changes < kMostChanges || surprises2 < kMostSurprises2;
}

bool TrackedVessel::isUnderWay() const {
  return has_moved && motion.state().segment<2>(2).norm() > kLeastUnderWayMps;
}

Track TrackedVessel::track() const {
  const MotionState x = motion.usualState();
  Track track;
  track.id = id;
  track.mmsi = mmsi;
  track.stamp_s = motion.stamp();
  track.position = x.head<2>();
  track.keeps_place = keeps_place || is_mapped || stays;
  track.velocity = track.keeps_place ? Eigen::Vector2d::Zero() : Eigen::Vector2d(x.segment<2>(2));
  track.turn_rate_radps = track.keeps_place ? 0.0 : x[4];
  track.turn_time_s = kBriefTurnS + motion.steadiness() * (kSteadyTurnS - kBriefTurnS);
  track.covariance = motion.likelyCovariance().topLeftCorner<4, 4>();
  if (track.keeps_place) {
    track.covariance.rightCols<2>().setZero();
    track.covariance.bottomRows<2>().setZero();
  }
  track.shape = heading_rad ? Shape::kBox : Shape::kDisc;
  track.heading_rad = heading_rad.value_or(0.0);
  track.length_m = length_m;
  track.beam_m = beam_m;
  if (!heading_rad) {
    // A disc round the reported position that holds the hull wherever it points.
    const double reach =
        dimensions ? std::hypot(std::max(dimensions->to_bow_m, dimensions->to_stern_m),
                                std::max(dimensions->to_port_m, dimensions->to_starboard_m))
                   : 0.5 * std::max(length_m, beam_m);
    track.length_m = track.beam_m = std::min(2.0 * reach, kLongestM);
  }
  track.existence = existence;
  track.sources = sources;
  track.met = met;
  return track;
}

std::vector<Eigen::Vector2d> TrackedVessel::pointsWithin() const {
  constexpr double kInsideM = 0.3;  // the sides themselves are the lidar's to tell
  constexpr double kSpacingM = 0.2;
  std::vector<Eigen::Vector2d> points;
  if (!knowsOutline()) {
    return points;
  }
  const Eigen::Vector2d middle = motion.usualState().head<2>();
  const Eigen::Vector2d half(0.5 * length_m - kInsideM, 0.5 * beam_m - kInsideM);
  for (double along = -half.x(); along <= half.x(); along += kSpacingM) {
    for (double athwart = -half.y(); athwart <= half.y(); athwart += kSpacingM) {
      points.push_back(middle + along * ahead() + athwart * across(ahead()));
    }
  }
  return points;
}

Eigen::Vector2d TrackedVessel::ahead() const {
  return unitVector(*heading_rad);
}

double TrackedVessel::halfDepth(const Eigen::Vector2d& along) const {
  if (!heading_rad) {
    return 0.5 * std::max(length_m, beam_m);
  }
  return 0.5 *
         (length_m * std::abs(ahead().dot(along)) + beam_m * std::abs(across(ahead()).dot(along)));
}

std::optional<double> TrackedVessel::sidesOf(const Cluster& cluster) {
  constexpr std::size_t kFewest = 8;
  constexpr double kLeastLengthM = 1.0;
  constexpr double kMostDeviationM = 0.15;
  if (cluster.points.size() < kFewest ||
      (cluster.points.front() - cluster.points.back()).norm() < kLeastLengthM) {
    return std::nullopt;
  }
  const double direction = rectangleDirection(cluster.points);
  if (rectangleDeviation(cluster.points, direction) > kMostDeviationM) {
    return std::nullopt;
  }
  return direction;
}

std::optional<double> TrackedVessel::axisOf(const Cluster& cluster, const Eigen::Vector2d& eye) {
  constexpr double kClearlyLonger = 1.4;
  const std::optional<double> sides = sidesOf(cluster);
  if (!sides || cluster.isCut()) {
    return std::nullopt;
  }
  const View view(cluster, eye, unitVector(*sides));
  const double along = view.along.length();
  const double athwart = view.athwart.length();
  if (!view.from_beside || !view.from_end ||
      std::max(along, athwart) < kClearlyLonger * std::min(along, athwart)) {
    return std::nullopt;
  }
  return along > athwart ? *sides : *sides + 0.5 * kPi;
}

double TrackedVessel::headingDeviation() const {
  const double speed = motion.usualState().segment<2>(2).norm();
  const double deviation = velocityDeviation(motion) / std::max(speed, kLeastCourseSpeedMps);
  return mmsi != 0 ? 0.0 : std::min(kPi, deviation);
}

std::optional<double> TrackedVessel::headingBySides(const Cluster& cluster) const {
  const std::optional<double> sides = sidesOf(cluster);
  if (!sides) {
    return std::nullopt;
  }
  const double direction = *sides;
  constexpr double kQuarter = 0.5 * kPi;
  return direction + kQuarter * std::round((*heading_rad - direction) / kQuarter);
}

Measurement TrackedVessel::measure(const Cluster& cluster, const Eigen::Vector2d& eye,
                                   bool among_many) const {
  const bool guessed = size == Size::kGuessed;
  const std::optional<double> axis =
      guessed && !among_many ? axisOf(cluster, eye) : std::optional<double>{};
  const bool young = hits < kYoungHits && guessed;
  const bool vague = guessed && !among_many && headingDeviation() > kHeadingForSizeRad;
  const bool headed = heading_rad && !young && !vague;
  const std::optional<double> sides =
      headed && among_many ? headingBySides(cluster) : std::optional<double>{};
  // Without a heading, along the line of sight: its near end doesn't shift as more of a hull comes
  // into sight behind it.
  const Eigen::Vector2d ahead =
      axis     ? unitVector(*axis)
      : headed ? unitVector(sides.value_or(*heading_rad))
               : Eigen::Vector2d((cluster.points[cluster.points.size() / 2] - eye).normalized());
  const Eigen::Vector2d port = across(ahead);
  const View view(cluster, eye, ahead);
  Middle middle[2];
  if (axis) {  // whatever her course, her middle is that of both sides
    middle[0] = {view.along.middle(), kSeenSideM};
    middle[1] = {view.athwart.middle(), kSeenSideM};
  } else if (!headed) {
    middle[0] = {view.along.low + 0.5 * beam_m, kGuessedSideM};
    middle[1] = {view.athwart.middle(), kGuessedSideM};
    if (cluster.out_of_range && !among_many) {
      middle[1].at = besideTheNearerEnd(cluster, eye, port, 0.5 * beam_m);
    }
  } else {
    // What she turns out to be longer by is learned apart, and is no motion.
    const double length = among_many ? std::max(length_m, view.along.length()) : length_m;
    const double beam = among_many ? std::max(beam_m, view.athwart.length()) : beam_m;
    const bool known = !guessed || sides;
    const bool in_range = !cluster.out_of_range;
    const double seen_side_m = sides ? kMeasuredSideM : kSeenSideM;
    middle[0] = middleAlong(view.along, view.along_hidden, view.eye_along,
                            view.from_beside && in_range, length, known, seen_side_m);
    middle[1] = middleAlong(view.athwart, view.athwart_hidden, view.eye_athwart,
                            view.from_end && in_range, beam, known, seen_side_m);
  }
  const Eigen::Matrix2d axes = (Eigen::Matrix2d() << ahead, port).finished();
  const Eigen::Vector2d variances(middle[0].deviation_m * middle[0].deviation_m,
                                  middle[1].deviation_m * middle[1].deviation_m);
  Measurement measurement;
  measurement.value.head<2>() = middle[0].at * ahead + middle[1].at * port;
  measurement.covariance.topLeftCorner<2, 2>() = axes * variances.asDiagonal() * axes.transpose();
  return measurement;
}

void TrackedVessel::followMiddle(const Cluster& cluster, const Eigen::Vector2d& eye,
                                 bool among_many) {
  const std::optional<double> heading = heading_rad;
  const Eigen::Vector4d headed = measure(cluster, eye, among_many).value;
  heading_rad.reset();
  const Eigen::Vector4d before = measure(cluster, eye, among_many).value;
  heading_rad = heading;
  motion.shift((headed - before).head<2>());
}

bool TrackedVessel::isShownAgain(const Eigen::Vector2d& size_m) {
  constexpr double kAlikeM = 0.3;
  constexpr int kOften = 5;
  shown_alike = (size_m - shown_m).cwiseAbs().maxCoeff() < kAlikeM ? shown_alike + 1 : 0;
  shown_m = size_m;
  return shown_alike >= kOften;
}

void TrackedVessel::learnSize(const Cluster& cluster, const Eigen::Vector2d& eye) {
  constexpr double kShrinks = 0.01;    // of the difference, a scan
  constexpr double kByBothRad = 0.05;  // how well both sides tell how she lies
  constexpr double kClearlyBetter = 0.7;
  constexpr double kKnownCourseRad = 0.15;
  constexpr double kBroaderM = 0.2;  // than long, by the echoes' noise
  if (size == Size::kReported || !heading_rad) {
    return;
  }
  const std::optional<double> axis = axisOf(cluster, eye);
  const double within = axis ? std::min(kByBothRad, headingDeviation()) : headingDeviation();
  if (within > kHeadingForSizeRad) {
    return;
  }
  const double heading = axis ? *axis + kPi * std::round((*heading_rad - *axis) / kPi)
                              : headingBySides(cluster).value_or(*heading_rad);
  const View view(cluster, eye, unitVector(heading));
  const bool across_her_course = std::abs(wrapAngle(heading - *heading_rad)) > 0.25 * kPi &&
                                 headingDeviation() < kKnownCourseRad;
  if (across_her_course ||
      view.athwart.length() > std::max(length_m, view.along.length()) + kBroaderM) {
    return;  // two that look like one
  }
  const Eigen::Vector4d before = measure(cluster, eye).value;
  // What a worse heading made of her counts no more.
  const bool anew = within < kClearlyBetter * sized_within_rad;
  if (takeSize(*this, cluster, view, kShrinks, anew)) {
    sized_within_rad = std::min(within, sized_within_rad);
  }
  motion.shift((measure(cluster, eye).value - before).head<2>());
}

void TrackedVessel::learnSizeAmongMany(const Cluster& cluster, const Eigen::Vector2d& eye) {
  constexpr double kShrinks = 0.1;  // what was taken for hers before may have been more
  const std::optional<double> heading =
      heading_rad ? headingBySides(cluster) : std::optional<double>{};
  if (size == Size::kReported || !heading) {
    return;
  }
  const View view(cluster, eye, unitVector(*heading));
  if (isShownAgain({view.along.length(), view.athwart.length()})) {
    takeSize(*this, cluster, view, kShrinks, false);
  }
}

void TrackedVessel::takeDimensions(const ais::Message& message) {
  const double reported_length_m = message.to_bow_m + message.to_stern_m;
  const double reported_beam_m = message.to_port_m + message.to_starboard_m;
  if (!message.hasDimensions() || std::max(reported_length_m, reported_beam_m) > kLongestM) {
    return;  // the fields' maxima mean "or more"
  }
  dimensions = message;
  size = Size::kReported;
  length_m = reported_length_m;
  beam_m = reported_beam_m;
}

Eigen::Vector2d TrackedVessel::middleFromReported() const {
  if (!dimensions || !heading_rad || !dimensions->hasReferencePoint()) {
    return Eigen::Vector2d::Zero();
  }
  const Eigen::Vector2d ahead = unitVector(*heading_rad);
  return 0.5 * (dimensions->to_bow_m - dimensions->to_stern_m) * ahead +
         0.5 * (dimensions->to_port_m - dimensions->to_starboard_m) * across(ahead);
}

}  // namespace otter_nav::traffic
