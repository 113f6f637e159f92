#include "otter_nav/traffic/tracker.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "association.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "scan_clusters.hpp"
#include "tracked_vessel.hpp"

namespace otter_nav::traffic {
namespace {

constexpr double kGate2 = 16.0;      // squared Mahalanobis distance
constexpr double kLivesS = 300.0;    // a vessel is there for so long on average
constexpr double kConfirmed = 0.98;  // existence
constexpr double kGone = 0.02;
constexpr double kReportedAtLeast = 0.5;  // by AIS not long ago
constexpr int kFewestHits = 2;

// Lidar.
constexpr double kLidarDetection = 0.9;
constexpr double kLidarUnplaced = 0.5;
constexpr double kHardlyConcluded = 0.02;
// Among many, of one this near another, whom the scan may have met as one thing: so much of it.
constexpr double kBesideConcluded = 0.2;
constexpr double kAsOneM = 1.0;
constexpr double kPlacedM = 2.0;
constexpr double kNearerM = 0.5;
constexpr double kMostOffM = 2.0;
constexpr double kLidarClutterPerM2 = 2e-3;
constexpr double kFirstExistence = 0.2;
constexpr int kFewestNew = 2;  // echoes of a cluster in water seen free, to begin a track
constexpr int kFewestMovingHits = 6;
constexpr double kFewestSeconds = 2.2;
constexpr double kUnconfirmedAtMost = 0.99;
constexpr double kUnconfirmedGone = 0.1;
// Squared Mahalanobis distance: a hull's echoes are steadier than their deviation says, clutter
// that follows on clutter isn't. Once she has a heading her middle is measured otherwise than
// before.
constexpr double kSurprise2 = 10.0;
constexpr double kSurpriseHeaded2 = 12.0;
constexpr int kMostMissed = 1;
constexpr double kTentativeS = 8.0;  // what is not confirmed by then is dropped, in doubt or not
constexpr double kOutlineMarginM = 0.7;  // echoes this near a vessel's outline are hers
constexpr double kLostS = 30.0;          // neither seen nor heard for so long
constexpr double kMappedS = 2.0;         // lies still in the lidar's sight for so long
// Of what the lidar takes for one thing nothing is longer by much: what AIS says to be so is not
// what stands there, or too large for the map to be given it point by point.
constexpr double kLongestMappedM = 40.0;

// Radar.
constexpr double kRadarDetection = 0.9;
// Of false plots, a scan: begins at the first, then is what is seen, and never below the second.
constexpr double kRadarClutterPerM2 = 1e-6;
constexpr double kLeastClutterPerM2 = 3e-7;
constexpr double kClutterShare = 0.1;   // by which a scan changes it
constexpr double kVesselsPerM2 = 1e-6;  // that come into sight, a scan

// AIS.
constexpr double kAisPositionM = 2.5;  // standard deviations, each axis
constexpr double kAisInaccurateM = 8.0;
constexpr double kAisVelocityMps = 0.15;
constexpr double kAisGate2 = 25.0;  // four measured figures
constexpr double kSlowKnots = 2.0;  // class B reports every three minutes only
constexpr double kAnchoredKnots = 0.5;
constexpr double kAisKeptS = 100.0;  // three reports missed
constexpr double kAisSlowKeptS = 600.0;
constexpr double kAidDiameterM = 3.0;

// Among many: how often each is off on a new course, and how long a report vouches for who is seen
// no more.
constexpr double kAnewPerS = 0.1;
constexpr double kAisKeptCrowdedS = 1.0;
// Standard deviation of a heading by the sides; what is off is so scan after scan.
constexpr double kSidesRad = 0.08;

constexpr double kSameM = 3.0;  // two tracks nearer than this, and alike, are one vessel

Measurement positionMeasurement(const Eigen::Vector2d& position, double deviation_m) {
  Measurement measurement;
  measurement.value.head<2>() = position;
  measurement.covariance.topLeftCorner<2, 2>().diagonal().setConstant(deviation_m * deviation_m);
  return measurement;
}

}  // namespace

class Tracker::Impl {
 public:
  Impl(const Options& options, const map::OccupancyGrid& chart, const vessel::Hull& own_hull)
      : options_(options), frame_(options.datum), clusters_(chart, own_hull) {}

  const ScanVerdict& addScan(double stamp_s, const map::SensorPose& sensor, const vessel::Pose& own,
                             const Scan& scan) {
    const std::vector<Cluster> clusters =
        partedAmong(stamp_s, clusters_.gather(stamp_s, sensor, own, scan));
    const Eigen::Vector2d eye = sensor.position.head<2>();
    verdict_.on_vessel.assign(scan.ranges_m.size(), false);
    verdict_.lying.clear();
    lookRound(eye);
    Look look;
    look.stamp_s = stamp_s;
    look.detections = clusters.size();
    look.clutter_per_m2 = kLidarClutterPerM2;
    look.source = kLidar;
    look.measure = [&](const TrackedVessel& vessel, std::size_t k) {
      return vessel.measure(clusters[k], eye, crowded_);
    };
    look.canBe = [&](const TrackedVessel& vessel, std::size_t k) {
      if (vessel.isUnderWay() && clusters[k].stands()) {
        return false;
      }
      const Eigen::Vector2d middle = vessel.motion.state().head<2>();
      const double reach = 2.0 * std::max(vessel.length_m, vessel.beam_m) + 10.0;
      return (clusters[k].points.front() - middle).norm() < reach;
    };
    look.detection = [&](const TrackedVessel& vessel, const MotionFilter& now) {
      return lidarDetection(vessel, now, eye);
    };
    look.sides = [&](std::size_t k) -> std::optional<Sides> {
      const std::optional<double> direction =
          crowded_ ? TrackedVessel::sidesOf(clusters[k]) : std::nullopt;
      return direction ? std::optional<Sides>({*direction, kSidesRad}) : std::nullopt;
    };
    look.seen = [&](TrackedVessel& vessel, std::size_t k, double surprise2, bool first_course) {
      if (first_course && isTheLidarsAlone(vessel)) {
        vessel.followMiddle(clusters[k], eye, crowded_);
      }
      if (clusters[k].new_points >= kFewestNew) {
        ++vessel.moving_hits;
        vessel.last_new_s = look.stamp_s;
      }
      vessel.lookedAt(clusters[k], look.stamp_s);
      vessel.compare(clusters[k], surprise2);
      if (!clusters[k].shared && crowded_) {
        vessel.learnSizeAmongMany(clusters[k], eye);
      } else if (!clusters[k].shared) {
        vessel.learnSize(clusters[k], eye);
      }
      if (!vessel.confirmed) {
        vessel.unconfirmed_points.insert(vessel.unconfirmed_points.end(),
                                         clusters[k].points.begin(), clusters[k].points.end());
      }
    };
    const std::vector<double> taken = associate(look);
    for (std::size_t k = 0; k < clusters.size(); ++k) {
      if (taken[k] < 0.3 && !isOnTrack(stamp_s, clusters[k]) &&
          clusters[k].new_points >= kFewestNew &&
          5 * clusters[k].new_points > static_cast<int>(clusters[k].points.size())) {
        begin(clusters[k], eye, stamp_s);
      }
    }
    unite();
    judge(stamp_s);
    giveToMap(stamp_s, sensor.position.z());
    findOnVessels();
    verdict_.ghosts = std::exchange(ghosts_, {});
    return verdict_;
  }

  void addRadar(double stamp_s, const std::vector<Eigen::Vector2d>& positions,
                const Eigen::Vector2d& own) {
    lookRound(own);
    Look look;
    look.stamp_s = stamp_s;
    look.detections = positions.size();
    look.clutter_per_m2 = radar_clutter_per_m2_;
    look.source = kRadar;
    look.measure = [&](const TrackedVessel& /*vessel*/, std::size_t k) {
      return positionMeasurement(positions[k], options_.radar_noise_m);
    };
    // Who keeps her place is met there, however much she may have strayed by the filter.
    const auto isHerPlace = [&](const TrackedVessel& vessel, std::size_t k) {
      const double doubt_m = std::hypot(options_.radar_noise_m, kAisPositionM);
      const double reach =
          0.5 * std::max(vessel.length_m, vessel.beam_m) + std::sqrt(kGate2) * doubt_m;
      return (positions[k] - vessel.motion.state().head<2>()).norm() < reach;
    };
    look.canBe = [&](const TrackedVessel& vessel, std::size_t k) {
      return !vessel.keeps_place || isHerPlace(vessel, k);
    };
    look.detection = [&](const TrackedVessel& vessel, const MotionFilter& now) {
      const double range = (now.state().head<2>() - own).norm();
      // From seeing nothing out of range nothing follows, nor of a buoy; what is seen is
      // somebody's.
      const bool reached = range < options_.radar_range_m && !vessel.keeps_place;
      return Detection{kRadarDetection, reached ? kRadarDetection : 0.0};
    };
    look.sides = [](std::size_t /*k*/) { return std::nullopt; };
    look.seen = [](TrackedVessel& /*vessel*/, std::size_t /*k*/, double /*surprise2*/,
                   bool /*first*/) {};
    const std::vector<double> taken = associate(look);
    int nobodys = 0;
    for (std::size_t k = 0; k < positions.size(); ++k) {
      if (taken[k] < 0.3) {
        vessels_.emplace_back(next_id_++, positionMeasurement(positions[k], options_.radar_noise_m),
                              stamp_s, kRadar);
        vessels_.back().existence = kVesselsPerM2 / (kVesselsPerM2 + radar_clutter_per_m2_);
        ++nobodys;
      }
    }
    const double area = kPi * options_.radar_range_m * options_.radar_range_m;
    radar_clutter_per_m2_ =
        std::max(kLeastClutterPerM2,
                 radar_clutter_per_m2_ + kClutterShare * (nobodys / area - radar_clutter_per_m2_));
    unite();
    judge(stamp_s);
  }

  Status addAis(double stamp_s, std::string_view sentence) {
    Result<std::optional<ais::Message>> decoded = decoder_.add(sentence);
    if (!decoded) {
      return failure("AIS: " + decoded.error().message);
    }
    if (*decoded && (*decoded)->mmsi == 0) {
      return failure("AIS: a report without an MMSI");
    }
    if (*decoded) {
      take(stamp_s, **decoded);
      judge(stamp_s);
    }
    return {};
  }

  void forget(double now_s) { judge(now_s); }

  // What the scans remember goes by itself with an earlier one.
  void beginAnew() {
    vessels_.clear();
    tracks_.clear();
    ghosts_.clear();
    crowded_ = false;
  }

  [[nodiscard]] const std::vector<Track>& tracks() const { return tracks_; }

 private:
  struct Detection {
    double probability = 0.0;
    // The same for what a scan without her says of her existence: scan after scan of a vessel that
    // may be elsewhere, or shows but an end, misses her for the same reason.
    double concluded = 0.0;
  };
  // Detections that came at once from one sensor.
  struct Look {
    double stamp_s = 0.0;
    std::size_t detections = 0;
    double clutter_per_m2 = 0.0;
    Source source = kLidar;
    std::function<Measurement(const TrackedVessel&, std::size_t)> measure;
    std::function<bool(const TrackedVessel&, std::size_t)> canBe;
    // Where the vessel's motion has brought it by now.
    std::function<Detection(const TrackedVessel&, const MotionFilter&)> detection;
    // Of what has any.
    std::function<std::optional<Sides>(std::size_t)> sides;
    // Most probably this one, and by how much its place surprised; whether its course has become
    // known by it.
    std::function<void(TrackedVessel&, std::size_t, double, bool)> seen;
  };

  [[nodiscard]] Detection lidarDetection(const TrackedVessel& vessel, const MotionFilter& now,
                                         const Eigen::Vector2d& eye) const {
    const Eigen::Vector2d middle = now.state().head<2>();
    const double deviation = std::sqrt(now.covariance().topLeftCorner<2, 2>().trace());
    const auto inSight = [&](const Eigen::Vector2d& position) {
      const Eigen::Vector2d sight = (position - eye).normalized();
      return clusters_.inSight(position, vessel.halfDepth(sight) + kNearerM, deviation,
                               vessel.beam_m);
    };
    const double seen = inSight(middle);
    if (seen > 0.0 && deviation < kPlacedM) {
      const double shown = seen * kLidarDetection;
      return {shown,
              crowded_ && isBesideAnother(vessel, middle) ? kBesideConcluded * shown : shown};
    }
    // She may show an end only, or be elsewhere.
    const Eigen::Vector2d ahead = vessel.heading_rad ? vessel.ahead() : (middle - eye).normalized();
    const Eigen::Vector2d along = (0.5 * vessel.length_m + std::min(kMostOffM, deviation)) * ahead;
    const Eigen::Vector2d athwart = deviation * across(ahead);
    double most = seen;
    double least = seen;
    for (const Eigen::Vector2d& off :
         {along, Eigen::Vector2d(-along), athwart, Eigen::Vector2d(-athwart)}) {
      const double there = inSight(middle + off);
      most = std::max(most, there);
      least = std::min(least, there);
    }
    return {most * kLidarUnplaced, least > 0.0 ? least * kLidarUnplaced : most * kHardlyConcluded};
  }

  // So near another that both may be met as one thing.
  [[nodiscard]] bool isBesideAnother(const TrackedVessel& vessel,
                                     const Eigen::Vector2d& middle) const {
    return std::any_of(vessels_.begin(), vessels_.end(), [&](const TrackedVessel& other) {
      if (other.id == vessel.id || !other.confirmed) {
        return false;
      }
      const Eigen::Vector2d off = other.motion.state().head<2>() - middle;
      const double apart = off.norm();
      const Eigen::Vector2d along = off / std::max(1e-6, apart);
      return apart < vessel.halfDepth(along) + other.halfDepth(along) + kAsOneM;
    });
  }

  // Vessels on passage turn as hulls do, and keep apart. Where many crowd in a small place somebody
  // may be off on a new course at any time, and right beside another.
  void lookRound(const Eigen::Vector2d& own) {
    constexpr std::ptrdiff_t kMany = 4;
    constexpr double kNearM = 60.0;
    crowded_ = std::count_if(vessels_.begin(), vessels_.end(), [&](const TrackedVessel& vessel) {
                 return vessel.confirmed && vessel.isUnderWay() &&
                        (vessel.motion.state().head<2>() - own).norm() < kNearM;
               }) >= kMany;
    if (crowded_) {
      guessSizes();
    }
  }
  // Those who crowd are of a kind: a size that nothing has told yet is the others' middle one.
  void guessSizes() {
    constexpr std::size_t kEnough = 3;
    std::vector<double> lengths;
    std::vector<double> beams;
    for (const TrackedVessel& vessel : vessels_) {
      if (vessel.size != TrackedVessel::Size::kGuessed) {
        lengths.push_back(vessel.length_m);
        beams.push_back(vessel.beam_m);
      }
    }
    if (lengths.size() < kEnough) {
      return;
    }
    const auto middle = [](std::vector<double>& of) {
      const auto at = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
      std::nth_element(of.begin(), at, of.end());
      return *at;
    };
    const double length = middle(lengths);
    const double beam = middle(beams);
    for (TrackedVessel& vessel : vessels_) {
      if (vessel.size == TrackedVessel::Size::kGuessed) {
        vessel.length_m = length;
        vessel.beam_m = beam;
      }
    }
  }

  // Moves the tracks on and updates them; each detection's probability of being somebody's.
  std::vector<double> associate(const Look& look) {
    std::vector<std::size_t> of_track;
    std::vector<double> concluded;
    std::vector<double> none;
    std::vector<std::vector<Link>> links;
    std::vector<std::vector<MotionFilter::Candidate>> candidates;
    for (std::size_t v = 0; v < vessels_.size(); ++v) {
      TrackedVessel& vessel = vessels_[v];
      MotionFilter now = vessel.motion;
      now.predict(look.stamp_s, crowded_ ? kAnewPerS : 0.0);
      const Detection chance = look.detection(vessel, now);
      if (chance.probability == 0.0) {
        continue;
      }
      const MotionFilter before = std::exchange(vessel.motion, now);
      const double existed = vessel.existence;
      vessel.existence *= std::exp(-(look.stamp_s - before.stamp()) / kLivesS);
      links.emplace_back();
      candidates.emplace_back();
      for (std::size_t k = 0; k < look.detections; ++k) {
        if (!look.canBe(vessel, k)) {
          continue;
        }
        MotionFilter::Candidate candidate;
        candidate.measurement = look.measure(vessel, k);
        if (vessel.motion.gateDistance2(candidate.measurement) > kGate2) {
          continue;
        }
        candidate.likelihoods = vessel.motion.likelihoods(candidate.measurement);
        links.back().push_back({k, vessel.existence * chance.probability *
                                       vessel.motion.likelihood(candidate.likelihoods) /
                                       look.clutter_per_m2});
        candidates.back().push_back(std::move(candidate));
      }
      if (links.back().empty() && chance.concluded == 0.0) {  // nothing is learnt of her
        vessel.motion = before;
        vessel.existence = existed;
        links.pop_back();
        candidates.pop_back();
        continue;
      }
      of_track.push_back(v);
      concluded.push_back(chance.concluded);
      none.push_back(1.0 - vessel.existence * chance.concluded);
    }
    const Marginals marginals = jointMarginals(none, links, look.detections);
    std::vector<double> taken(look.detections, 0.0);
    for (std::size_t t = 0; t < of_track.size(); ++t) {
      TrackedVessel& vessel = vessels_[of_track[t]];
      for (std::size_t l = 0; l < links[t].size(); ++l) {
        taken[links[t][l].detection] += marginals.links[t][l];
      }
      update(look, vessel, concluded[t], marginals.none[t], marginals.links[t], links[t],
             candidates[t]);
    }
    return taken;
  }

  // Existence first, then the motion given that the vessel exists (Musicki and Evans 2004).
  void update(const Look& look, TrackedVessel& vessel, double concluded, double none,
              const std::vector<double>& probabilities, const std::vector<Link>& links,
              std::vector<MotionFilter::Candidate>& candidates) const {
    const double unseen = vessel.existence * (1.0 - concluded) /
                          (1.0 - vessel.existence * concluded);  // exists, given no detection
    double exists = none * unseen;
    for (const double probability : probabilities) {
      exists += probability;
    }
    // Whoever reports herself is there, though another may hide her from every sensor.
    const bool reports =
        look.stamp_s - vessel.last_ais_s < (crowded_ ? kAisKeptCrowdedS : kAisKeptS);
    vessel.existence = std::clamp(exists, reports ? kReportedAtLeast : 0.0,
                                  vessel.confirmed ? 0.9999 : kUnconfirmedAtMost);
    const bool in_doubt = !vessel.confirmed && isTheLidarsAlone(vessel);
    const bool is_met = std::any_of(probabilities.begin(), probabilities.end(),
                                    [](double one) { return one > 0.5; });
    vessel.missed = is_met ? 0 : vessel.missed + (concluded > 0.5 ? 1 : 0);
    if (in_doubt && vessel.missed > kMostMissed) {
      vessel.doubt(look.stamp_s);
    }
    if (exists <= 0.0 || candidates.empty()) {
      return;
    }
    std::size_t best = 0;
    for (std::size_t l = 0; l < links.size(); ++l) {
      candidates[l].probability = probabilities[l] / exists;
      best = probabilities[l] > probabilities[best] ? l : best;
    }
    const double surprise2 = vessel.motion.distance2(candidates[best].measurement);
    vessel.motion.update(candidates);
    if (is_met) {
      vessel.met = met(look.stamp_s, candidates);
      if (in_doubt && surprise2 > (vessel.heading_rad ? kSurpriseHeaded2 : kSurprise2)) {
        vessel.doubt(look.stamp_s);
      }
      vessel.last_s = look.stamp_s;
      vessel.findPlace(look.stamp_s);
      // She has said that she lies there, and has gone since.
      vessel.keeps_place = vessel.keeps_place && !(vessel.isUnderWay() && vessel.course());
      ++vessel.hits;
      vessel.sources |= look.source;
      vessel.plots += look.source == kRadar ? 1 : 0;
      if (const std::optional<Sides> sides = look.sides(links[best].detection)) {
        vessel.motion.update(*sides);
      }
      look.seen(vessel, links[best].detection, surprise2, vessel.followCourse());
    }
  }

  // Each candidate is hers as probably as it says.
  [[nodiscard]] static Track::Met met(double stamp_s,
                                      const std::vector<MotionFilter::Candidate>& candidates) {
    double all = 0.0;
    Track::Met met;
    met.stamp_s = stamp_s;
    for (const MotionFilter::Candidate& candidate : candidates) {
      all += candidate.probability;
      met.position += candidate.probability * candidate.measurement.value.head<2>();
    }
    met.position /= all;
    double variance = 0.0;
    for (const MotionFilter::Candidate& candidate : candidates) {
      const Eigen::Vector2d off = candidate.measurement.value.head<2>() - met.position;
      variance +=
          candidate.probability / all * 0.5 *
          (candidate.measurement.covariance.topLeftCorner<2, 2>().trace() + off.squaredNorm());
    }
    met.deviation_m = std::sqrt(variance);
    return met;
  }

  // Two that pass close by are met as one thing, which is larger than either: each has the echoes
  // that are nearer to her outline than to the other's. Among many a size that is guessed by the
  // others' will do for that.
  [[nodiscard]] std::vector<Cluster> partedAmong(double stamp_s,
                                                 const std::vector<Cluster>& clusters) const {
    constexpr double kLargerM = 0.8;
    constexpr double kNearM = 1.5;
    constexpr double kFreshS = 1.5;
    PredictionOptions now;
    now.sigmas = 0.0;
    now.horizon_s = kFreshS;
    std::vector<Outline> outlines;
    for (const TrackedVessel& vessel : vessels_) {
      const bool sized = crowded_ || vessel.size != TrackedVessel::Size::kGuessed;
      if (vessel.confirmed && vessel.heading_rad && sized &&
          stamp_s - vessel.motion.stamp() < kFreshS) {
        outlines.push_back(PredictedPath(vessel.track(), now).at(stamp_s));
      }
    }
    std::vector<Cluster> parted;
    for (const Cluster& cluster : clusters) {
      std::vector<std::size_t> near;
      for (std::size_t k = 0; k < outlines.size(); ++k) {
        if (std::any_of(cluster.points.begin(), cluster.points.end(), [&](const auto& point) {
              return outlines[k].distanceTo(point).distance_m < kNearM;
            })) {
          near.push_back(k);
        }
      }
      const bool shared = near.size() > 1 && std::all_of(near.begin(), near.end(), [&](auto k) {
                            const Outline& outline = outlines[k];
                            const Eigen::Vector2d ahead = unitVector(outline.heading_rad);
                            return spanOf(cluster.points, ahead).length() >
                                       2.0 * outline.half_length_m + kLargerM ||
                                   spanOf(cluster.points, across(ahead)).length() >
                                       2.0 * outline.half_beam_m + kLargerM;
                          });
      if (!shared) {
        parted.push_back(cluster);
        parted.back().shared = near.size() > 1;
        continue;
      }
      std::vector<std::size_t> whose;
      for (const Eigen::Vector2d& point : cluster.points) {
        whose.push_back(*std::min_element(near.begin(), near.end(), [&](auto a, auto b) {
          return outlines[a].distanceTo(point).distance_m <
                 outlines[b].distanceTo(point).distance_m;
        }));
      }
      part(cluster, whose, parted);
    }
    return parted;
  }

  // Runs of echoes that are one's; a few of another's between them are hers too.
  static void part(const Cluster& cluster, const std::vector<std::size_t>& whose,
                   std::vector<Cluster>& parted) {
    constexpr std::size_t kFewest = 3;
    const std::size_t all = cluster.points.size();
    std::vector<std::size_t> cuts = {0};
    std::size_t hers = whose.front();
    for (std::size_t k = 1; k + kFewest <= all; ++k) {
      const bool turns = std::all_of(whose.begin() + static_cast<std::ptrdiff_t>(k),
                                     whose.begin() + static_cast<std::ptrdiff_t>(k + kFewest),
                                     [&](std::size_t one) { return one == whose[k]; });
      if (turns && whose[k] != hers && k - cuts.back() >= kFewest) {
        cuts.push_back(k);
        hers = whose[k];
      }
    }
    cuts.push_back(all);
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      Cluster one = cluster;
      const auto from = static_cast<std::ptrdiff_t>(cuts[c]);
      const auto to = static_cast<std::ptrdiff_t>(cuts[c + 1]);
      one.points.assign(cluster.points.begin() + from, cluster.points.begin() + to);
      one.beams.assign(cluster.beams.begin() + from, cluster.beams.begin() + to);
      const double share = static_cast<double>(to - from) / static_cast<double>(all);
      one.new_points = static_cast<int>(std::lround(share * cluster.new_points));
      one.standing_points = static_cast<int>(std::lround(share * cluster.standing_points));
      // She may go on behind the other.
      one.first_hidden = c == 0 ? cluster.first_hidden : true;
      one.last_hidden = c + 2 == cuts.size() ? cluster.last_hidden : true;
      one.shared = true;
      parted.push_back(std::move(one));
    }
  }

  // Echoes of a vessel that is tracked already: a part of her that looks like a thing of its own.
  // Among many a track that has shown nothing lately may be astray, and these another's.
  [[nodiscard]] bool isOnTrack(double stamp_s, const Cluster& cluster) const {
    constexpr double kLatelyS = 0.3;
    PredictionOptions now;
    now.horizon_s = 0.0;
    return std::any_of(vessels_.begin(), vessels_.end(), [&](const TrackedVessel& vessel) {
      if (crowded_ && stamp_s - vessel.last_s > kLatelyS) {
        return false;
      }
      const Outline outline = PredictedPath(vessel.track(), now).at(vessel.motion.stamp());
      return outline.distanceTo(cluster.points.front()).distance_m < kOutlineMarginM ||
             outline.distanceTo(cluster.points.back()).distance_m < kOutlineMarginM;
    });
  }

  void begin(const Cluster& cluster, const Eigen::Vector2d& eye, double stamp_s) {
    const double direction = rectangleDirection(cluster.points);
    const Eigen::Vector2d ahead = unitVector(direction);
    TrackedVessel vessel(next_id_, positionMeasurement(cluster.points.front(), 1.0), stamp_s,
                         kLidar);
    const Measurement first = vessel.measure(cluster, eye);
    vessel.motion = MotionFilter(first, stamp_s);
    vessel.existence = kFirstExistence;
    const double along = spanOf(cluster.points, ahead).length();
    const double athwart = spanOf(cluster.points, {-ahead.y(), ahead.x()}).length();
    vessel.length_m = std::max(1.0, std::max(along, athwart));
    vessel.beam_m = std::max(1.0, std::min(along, athwart));
    vessel.moving_hits = 1;
    vessel.unconfirmed_points = cluster.points;
    vessels_.push_back(std::move(vessel));
    ++next_id_;
  }

  void take(double stamp_s, const ais::Message& m) {
    if (m.type == 21 && m.is_virtual) {
      return;
    }
    const auto known = std::find_if(vessels_.begin(), vessels_.end(),
                                    [&](const TrackedVessel& v) { return v.mmsi == m.mmsi; });
    if (!m.hasPosition()) {
      if (known != vessels_.end()) {
        learnOutline(*known, m);
      } else if (m.hasDimensions()) {
        remember(m);
      }
      return;
    }
    const bool is_known = known != vessels_.end();
    const bool fits = is_known && fitsReport(stamp_s, m, *known);
    const bool begins_anew = is_known && !fits && isHersAlone(*known);
    const bool stays = fits || begins_anew;
    if (is_known && !stays) {
      // Something else is tracked there, for sensors saw it; it has no name.
      known->mmsi = 0;
      known->reported.reset();
      known->last_ais_s = kLongAgoS;
    }
    const std::size_t were = vessels_.size();
    TrackedVessel& vessel = stays ? *known : matching(stamp_s, m);
    const bool is_new = vessels_.size() > were;
    learnOutline(vessel, m);
    vessel.mmsi = m.mmsi;
    vessel.sources |= kAis;
    vessel.last_s = vessel.last_ais_s = stamp_s;
    vessel.existence = 0.9999;
    confirm(vessel);
    // At anchor, moored or aground, as set by hand: forgotten by who makes way.
    const bool said_to_lie = m.type <= 3 && (m.status == 1 || m.status == 5 || m.status == 6) &&
                             !(m.speed_knots > kSlowKnots);
    const bool lies = m.type == 21 || said_to_lie || m.speed_knots < kAnchoredKnots;
    vessel.keeps_place = lies;
    vessel.reported = measured(m, vessel);
    if (begins_anew) {
      vessel.motion = MotionFilter(*vessel.reported, stamp_s);
    } else if (!is_new) {
      vessel.motion.predict(stamp_s);
      vessel.motion.update(*vessel.reported);
    }
    // Between reports she turns with her course, which current and wind set off her heading.
    const bool has_heading = std::isfinite(m.heading_deg);
    const std::optional<double> course = vessel.course();
    vessel.leeway_rad = has_heading && course ? wrapAngle(*vessel.heading_rad - *course) : 0.0;
    vessel.followCourse();
    vessel.findPlace(stamp_s);
    if (m.type == 21 && !m.hasDimensions()) {
      vessel.length_m = vessel.beam_m = kAidDiameterM;
    }
  }

  // Nothing tells of her but what she says herself.
  static bool isHersAlone(const TrackedVessel& vessel) { return (vessel.sources & ~kAis) == 0; }

  // What a report says of her outline. Who is followed by reports alone has been followed where the
  // receiver stands until dimensions and heading are known; from then on it is the middle.
  static void learnOutline(TrackedVessel& vessel, const ais::Message& m) {
    const Eigen::Vector2d before = vessel.middleFromReported();
    vessel.takeDimensions(m);
    if (!vessel.heading_rad) {
      vessel.heading_rad = headingOf(m);
    }
    if (isHersAlone(vessel)) {
      vessel.motion.shift(vessel.middleFromReported() - before);
    }
    if (std::isfinite(m.heading_deg)) {
      vessel.heading_rad = ais::radiansFromEast(m.heading_deg);
    }
  }
  // Reported, or the course of who makes way.
  static std::optional<double> headingOf(const ais::Message& m) {
    if (std::isfinite(m.heading_deg)) {
      return ais::radiansFromEast(m.heading_deg);
    }
    if (m.speed_knots > kAnchoredKnots && std::isfinite(m.course_deg)) {
      return ais::radiansFromEast(m.course_deg);
    }
    return std::nullopt;
  }

  // The outline's middle, and velocity where the report has one.
  [[nodiscard]] Measurement measured(const ais::Message& m, const TrackedVessel& vessel) const {
    const double deviation = m.accurate ? kAisPositionM : kAisInaccurateM;
    const Eigen::Vector2d middle =
        frame_.toMap(m.latitude_deg, m.longitude_deg) + vessel.middleFromReported();
    const bool lies = m.type == 21 || m.speed_knots < kAnchoredKnots;
    if (!lies && !(std::isfinite(m.speed_knots) && std::isfinite(m.course_deg))) {
      return positionMeasurement(middle, deviation);
    }
    const double speed = lies ? 0.0 : m.speed_knots * ais::kKnotMps;
    const double course = lies ? 0.0 : ais::radiansFromEast(m.course_deg);
    const Eigen::Vector2d velocity = speed * unitVector(course);
    Measurement measurement;
    measurement.has_velocity = true;
    measurement.value << middle.x(), middle.y(), velocity.x(), velocity.y();
    measurement.covariance.diagonal() << deviation * deviation, deviation * deviation,
        kAisVelocityMps * kAisVelocityMps, kAisVelocityMps * kAisVelocityMps;
    return measurement;
  }

  [[nodiscard]] bool fitsReport(double stamp_s, const ais::Message& m,
                                const TrackedVessel& vessel) const {
    MotionFilter moved = vessel.motion;
    moved.predict(stamp_s);
    return moved.distance2(measured(m, vessel)) < kAisGate2;
  }

  // A vessel that is tracked without an identity and fits, or a new one.
  TrackedVessel& matching(double stamp_s, const ais::Message& m) {
    TrackedVessel fresh(next_id_, positionMeasurement({0.0, 0.0}, 1.0), stamp_s, kAis);
    for (const ais::Message& dimensions : known_dimensions_) {
      if (dimensions.mmsi == m.mmsi) {
        fresh.takeDimensions(dimensions);
      }
    }
    learnOutline(fresh, m);
    const Measurement measurement = measured(m, fresh);
    TrackedVessel* best = nullptr;
    double best_distance2 = kAisGate2;
    for (TrackedVessel& vessel : vessels_) {
      MotionFilter moved = vessel.motion;
      moved.predict(stamp_s);
      const double distance2 = moved.distance2(measurement);
      if (vessel.mmsi == 0 && distance2 < best_distance2) {
        best = &vessel;
        best_distance2 = distance2;
      }
    }
    if (best != nullptr) {
      if (fresh.dimensions) {
        learnOutline(*best, *fresh.dimensions);
      }
      return *best;
    }
    ++next_id_;
    fresh.motion = MotionFilter(measurement, stamp_s);
    vessels_.push_back(std::move(fresh));
    return vessels_.back();
  }

  // Dimensions of a vessel that hasn't said yet where it is.
  void remember(const ais::Message& m) {
    constexpr std::size_t kMost = 1000;
    if (known_dimensions_.size() >= kMost) {
      known_dimensions_.clear();
    }
    known_dimensions_.push_back(m);
  }

  // Tracks that have become one vessel's: the one with an identity stays, or the older one.
  void unite() {
    for (std::size_t a = 0; a < vessels_.size(); ++a) {
      for (std::size_t b = a + 1; b < vessels_.size(); ++b) {
        TrackedVessel& first = vessels_[a];
        TrackedVessel& second = vessels_[b];
        // Among many two may well pass through the same place; whom nothing shows any more goes
        // soon.
        if (crowded_ && first.confirmed && second.confirmed) {
          continue;
        }
        if (second.existence == 0.0 || first.existence == 0.0 || !areAlike(first, second)) {
          continue;
        }
        if (first.mmsi != 0 && second.mmsi != 0) {
          backToReported(first);
          backToReported(second);
        } else {
          TrackedVessel& stays = second.mmsi != 0 ? second : first;
          TrackedVessel& goes = second.mmsi != 0 ? first : second;
          stays.sources |= goes.sources;
          stays.plots += goes.plots;
          // Her echoes, and what the map has been given of her, go with her.
          moveTo(stays.unconfirmed_points, goes.unconfirmed_points);
          moveTo(stays.is_mapped ? stays.mapped_points : ghosts_, goes.mapped_points);
          if (stays.confirmed || goes.confirmed) {
            confirm(stays);
          }
          goes.existence = 0.0;
        }
      }
    }
  }
  // Two vessels on one track: after they passed close by, one's has followed the other. It has left
  // the course that was reported, and goes on from there.
  static void backToReported(TrackedVessel& vessel) {
    constexpr double kStrayedMps = 0.6;
    constexpr double kStraysMps = 0.1;
    if (!vessel.reported || !vessel.reported->has_velocity) {
      return;
    }
    Measurement now = *vessel.reported;
    const Eigen::Vector2d velocity = now.value.segment<2>(2);
    const double since = vessel.motion.stamp() - vessel.last_ais_s;
    if (since > kAisKeptS ||
        (vessel.motion.state().segment<2>(2) - velocity).norm() < kStrayedMps) {
      return;
    }
    now.value.head<2>() += since * velocity;
    now.covariance.diagonal().head<2>().array() += std::pow(kStraysMps * since, 2);
    vessel.motion = MotionFilter(now, vessel.motion.stamp());
  }

  static bool areAlike(const TrackedVessel& a, const TrackedVessel& b) {
    const MotionState off = a.motion.state() - b.motion.state();
    const double apart = off.head<2>().norm();
    if (apart > std::max(kSameM, 0.5 * std::min(a.length_m, b.length_m)) ||
        std::abs(a.motion.stamp() - b.motion.stamp()) > 1.0) {
      return false;
    }
    const Eigen::Matrix4d p = (a.motion.covariance() + b.motion.covariance()).topLeftCorner<4, 4>();
    return off.head<4>().dot(p.inverse() * off.head<4>()) < 9.5;
  }

  // For all that the radar vouches for: one plot of its may be false, and fall among things that
  // stand. Among many it is somebody's.
  [[nodiscard]] bool isTheLidarsAlone(const TrackedVessel& vessel) const {
    const int fewest = crowded_ ? 1 : 2;
    const std::uint32_t telling = vessel.plots < fewest ? vessel.sources & ~kRadar : vessel.sources;
    return telling == kLidar;
  }

  [[nodiscard]] bool isGone(const TrackedVessel& vessel, double now_s) const {
    if (vessel.existence < kGone) {
      return true;
    }
    if (!vessel.confirmed) {
      return now_s - vessel.begun_s > kTentativeS ||
             (isTheLidarsAlone(vessel) && vessel.hits > 1 && vessel.existence < kUnconfirmedGone);
    }
    const double unseen = now_s - vessel.last_s;
    if (vessel.mmsi != 0) {
      const double speed = vessel.motion.state().segment<2>(2).norm();
      return unseen >
             (vessel.keeps_place || speed < kSlowKnots * ais::kKnotMps ? kAisSlowKeptS : kAisKeptS);
    }
    return unseen > kLostS;
  }

  // What the map was given of her while she wasn't known is a ghost.
  void confirm(TrackedVessel& vessel) {
    vessel.confirmed = true;
    moveTo(ghosts_, vessel.unconfirmed_points);
  }
  static void moveTo(std::vector<Eigen::Vector2d>& all, std::vector<Eigen::Vector2d>& points) {
    all.insert(all.end(), points.begin(), points.end());
    points.clear();
  }

  // Confirms, drops, and tells of what is left.
  void judge(double now_s) {
    for (TrackedVessel& vessel : vessels_) {
      if (vessel.confirmed || vessel.existence < kConfirmed || vessel.hits < kFewestHits) {
        continue;
      }
      // A hull under way comes into free water all the time, but for the first moments at the edge
      // of sight, beyond which nothing was seen free; what comes into sight behind something nearer
      // seems to for a moment.
      const bool comes_in = vessel.moving_hits >= kFewestMovingHits &&
                            3 * vessel.moving_hits >= 2 * vessel.hits &&
                            vessel.last_new_s >= vessel.last_s;
      const bool moves = vessel.has_moved && comes_in && vessel.isAlike() &&
                         now_s - vessel.first_s >= kFewestSeconds;
      if (!isTheLidarsAlone(vessel) || moves) {
        confirm(vessel);
      }
    }
    vessels_.erase(std::remove_if(vessels_.begin(), vessels_.end(),
                                  [&](const TrackedVessel& v) { return isGone(v, now_s); }),
                   vessels_.end());
    tracks_.clear();
    for (const TrackedVessel& vessel : vessels_) {
      if (vessel.confirmed && !vessel.is_mapped) {
        tracks_.push_back(vessel.track());
      }
    }
  }

  // What the lidar has seen lying where it is belongs to the map: it may be something that never
  // moved, and nothing is foretold of it. Who else tells of her goes on being heard: she may sail.
  void giveToMap(double now_s, double height_m) {
    for (TrackedVessel& vessel : vessels_) {
      if (vessel.is_mapped && (vessel.isUnderWay() || !vessel.liesStill(now_s, 0.0))) {
        vessel.is_mapped = false;
        vessel.stands_since_s = kLongAgoS;
        moveTo(ghosts_, vessel.mapped_points);
      } else if (vessel.confirmed && !vessel.is_mapped && vessel.looked_s == now_s &&
                 vessel.liesStill(now_s, kMappedS) &&
                 std::max(vessel.length_m, vessel.beam_m) < kLongestMappedM) {
        vessel.is_mapped = true;
        vessel.mapped_points = vessel.pointsWithin();
        for (const Eigen::Vector2d& point : vessel.mapped_points) {
          verdict_.lying.emplace_back(point.x(), point.y(), height_m);
        }
        vessel.existence = isTheLidarsAlone(vessel) ? 0.0 : vessel.existence;
      }
    }
  }

  // Also echoes too few to be a thing, or too low: of a hull that comes into range, dips behind a
  // wave, or is met at its foot.
  void findOnVessels() {
    for (const TrackedVessel& vessel : vessels_) {
      if (!vessel.confirmed || !vessel.has_moved || vessel.is_mapped) {
        continue;
      }
      PredictionOptions now;
      now.horizon_s = 0.0;
      const Outline outline = PredictedPath(vessel.track(), now).at(vessel.motion.stamp());
      for (const auto* echoes : {&clusters_.echoes(), &clusters_.lowEchoes()}) {
        for (const ScanClusters::Echo& echo : *echoes) {
          if (outline.distanceTo(echo.point).distance_m < kOutlineMarginM) {
            verdict_.on_vessel[echo.beam] = true;
          }
        }
      }
    }
  }

  Options options_;
  ais::LocalFrame frame_;
  ais::Decoder decoder_;
  ScanClusters clusters_;
  std::vector<TrackedVessel> vessels_;
  std::vector<ais::Message> known_dimensions_;
  std::vector<Track> tracks_;
  ScanVerdict verdict_;
  std::vector<Eigen::Vector2d> ghosts_;  // since the last verdict, for the next one
  double radar_clutter_per_m2_ = kRadarClutterPerM2;
  bool crowded_ = false;  // around us
  int next_id_ = 1;
};

Tracker::Tracker(const Options& options, const map::OccupancyGrid& chart,
                 const vessel::Hull& own_hull)
    : impl_(std::make_unique<Impl>(options, chart, own_hull)) {}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

const ScanVerdict& Tracker::addScan(double stamp_s, const map::SensorPose& sensor,
                                    const vessel::Pose& own, const Scan& scan) {
  return impl_->addScan(stamp_s, sensor, own, scan);
}
void Tracker::addRadar(double stamp_s, const std::vector<Eigen::Vector2d>& positions,
                       const Eigen::Vector2d& own) {
  impl_->addRadar(stamp_s, positions, own);
}
Status Tracker::addAis(double stamp_s, std::string_view sentence) {
  return impl_->addAis(stamp_s, sentence);
}
void Tracker::forget(double now_s) {
  impl_->forget(now_s);
}
void Tracker::beginAnew() {
  impl_->beginAnew();
}
const std::vector<Track>& Tracker::tracks() const {
  return impl_->tracks();
}

}  // namespace otter_nav::traffic
