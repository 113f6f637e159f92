// The panel and the displays' pictures, driven by topics as in rviz: what they show, and what a
// click sends. The panel's picture is written beside the results.
#include "mission_panel.hpp"

#include <actionlib_msgs/GoalID.h>
#include <geometry_msgs/PoseArray.h>
#include <gtest/gtest.h>
#include <otter_nav/Route.h>
#include <std_msgs/String.h>
#include <std_srvs/Trigger.h>

#include <QApplication>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <cstdlib>

#include "chart_picture.hpp"
#include "heads_up_painter.hpp"
#include "look.hpp"
#include "mission_widgets.hpp"
#include "nautical_palette.hpp"
#include "support.hpp"

namespace otter_nav::rostest {
namespace {

using namespace rviz_plugins;  // NOLINT: what is tested

// Also lets Qt have its turn.
template <typename Done>
bool comes(const Done& done, double patience_s = kPatienceS) {
  return waitUntil(
      [&] {
        QCoreApplication::processEvents();
        return done();
      },
      patience_s);
}

// Stands in for planner_node and route_node: counts who was asked, and answers as told.
class Service {
 public:
  Service(ros::NodeHandle& node, const std::string& name) {
    server_ = node.advertiseService<std_srvs::Trigger::Request, std_srvs::Trigger::Response>(
        name, [this](std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
          ++calls;
          response.success = static_cast<std::uint8_t>(refusal.empty());
          response.message = refusal;
          return true;
        });
  }
  int calls = 0;
  std::string refusal;

 private:
  ros::ServiceServer server_;
};

class Panel : public testing::Test {
 protected:
  Panel() {
    std_msgs::String vessel;
    vessel.data = vessel::toYaml(vessel::Parameters());
    vessel_.publish(vessel);
    panel_.resize(320, 760);
    panel_.show();
    EXPECT_TRUE(comes([&] {
      return planner_.getNumSubscribers() > 0 && tracker_.getNumSubscribers() > 0 &&
             thrust_.getNumSubscribers() > 0 && route_.getNumSubscribers() > 0;
    }));
  }

  void say(const std::string& state, const std::string& reason) {
    PlannerStatus status;
    status.state = state;
    status.reason = reason;
    planner_.publish(status);
  }
  QString text(const char* name) { return panel_.findChild<QLabel*>(name)->text(); }
  bool shows(const char* name, const QString& wanted) {
    return comes([&] { return text(name).contains(wanted); });
  }
  QPushButton* button(const char* name) { return panel_.findChild<QPushButton*>(name); }
  bool isAsked(const char* name, Service& service) {
    const int before = service.calls;
    button(name)->click();
    return comes([&] { return service.calls == before + 1; });
  }
  void sendRoute(bool sailing) {
    Route route;
    route.goals = {ros_bridge::toPose({{20.0, 10.0}, 0.0}),
                   ros_bridge::toPose({{-5.5, 30.0}, 1.5708})};
    route.sailing = static_cast<std::uint8_t>(sailing);
    route.reason = sailing ? "" : "goal inside an obstacle";
    route_.publish(route);
    ASSERT_TRUE(comes([&] { return list()->count() == 2; }));
  }
  QListWidget* list() { return panel_.findChild<QListWidget*>("goals"); }

  ros::NodeHandle node_;
  ros::Publisher planner_ = node_.advertise<PlannerStatus>("planner_status", 10);
  ros::Publisher tracker_ = node_.advertise<TrackerStatus>("tracker_status", 100);
  ros::Publisher thrust_ = node_.advertise<ThrusterCommand>("thruster_command", 100);
  ros::Publisher vessel_ = node_.advertise<std_msgs::String>("vessel", 1, true);
  ros::Publisher route_ = node_.advertise<Route>("route", 1);
  MissionPanel panel_;
};

TEST_F(Panel, TellsStateAndReason) {
  EXPECT_TRUE(shows("state", "NO PLANNER"));
  say(PlannerStatus::REPLANNING, "only 0.40 m clear at (3.0 m, 4.0 m) on the way");
  EXPECT_TRUE(shows("state", "REPLANNING"));
  EXPECT_TRUE(shows("reason", "0.40 m clear"));
  TrackerStatus status;
  status.reason = "the heading yields to the position";
  tracker_.publish(status);
  EXPECT_TRUE(shows("reason", "tracker: the heading yields"));
  // What is not heard of any more is not shown as if it were.
  EXPECT_TRUE(shows("state", "NO NEWS"));
}

TEST_F(Panel, AsksWhatItsButtonsSay) {
  Service pause(node_, "planner_node/pause");
  Service hold(node_, "planner_node/hold");
  Service resume(node_, "planner_node/resume");
  Service stop(node_, "planner_node/stop");
  Inbox<actionlib_msgs::GoalID> cancelled(node_, "move_base/cancel");
  ASSERT_TRUE(cancelled.connected());

  say(PlannerStatus::SAILING, "");
  ASSERT_TRUE(comes([&] { return button("pause")->isEnabled(); }));
  EXPECT_FALSE(button("resume")->isEnabled());
  EXPECT_TRUE(isAsked("pause", pause));
  EXPECT_TRUE(isAsked("hold", hold));
  EXPECT_TRUE(isAsked("stop", stop));
  button("cancel")->click();
  EXPECT_TRUE(comes([&] { return cancelled.messages.size() == 1; }));
  EXPECT_EQ(cancelled.messages.front().id, "");

  say(PlannerStatus::PAUSED, "");
  ASSERT_TRUE(comes([&] { return button("resume")->isEnabled(); }));
  EXPECT_FALSE(button("pause")->isEnabled());
  EXPECT_TRUE(isAsked("resume", resume));
  say(PlannerStatus::IDLE, "");
  ASSERT_TRUE(comes([&] { return !button("cancel")->isEnabled(); }));
  EXPECT_TRUE(button("stop")->isEnabled());
}

TEST_F(Panel, SaysWhyAWishIsNotFollowed) {
  say(PlannerStatus::SAILING, "");
  ASSERT_TRUE(comes([&] { return button("pause")->isEnabled(); }));
  button("pause")->click();
  EXPECT_TRUE(shows("answer", "nobody offers /planner_node/pause"));
  Service pause(node_, "planner_node/pause");
  pause.refusal = "there is no mission to pause";
  button("pause")->click();
  EXPECT_TRUE(shows("answer", "no mission to pause"));
}

TEST_F(Panel, ListsTheGoalsAndChangesThem) {
  Inbox<geometry_msgs::PoseArray> wanted(node_, "route/set");
  ASSERT_TRUE(wanted.connected());
  Service add(node_, "route_node/add_marker");
  Service sail(node_, "route_node/sail");
  sendRoute(false);
  EXPECT_TRUE(list()->item(0)->text().contains("x 20.0   y 10.0   090"));
  EXPECT_TRUE(list()->item(1)->text().contains("x -5.5   y 30.0   000"));
  EXPECT_TRUE(shows("route_reason", "inside an obstacle"));
  EXPECT_TRUE(isAsked("add", add));
  ASSERT_TRUE(comes([&] { return button("sail")->isEnabled(); }));
  EXPECT_TRUE(isAsked("sail", sail));

  list()->setCurrentRow(1);
  ASSERT_TRUE(comes([&] { return button("sooner")->isEnabled(); }));
  button("sooner")->click();
  ASSERT_TRUE(comes([&] { return wanted.messages.size() == 1; }));
  ASSERT_EQ(wanted.messages.back().poses.size(), 2U);
  EXPECT_EQ(wanted.messages.back().poses.front().position.x, -5.5);
  button("remove")->click();
  ASSERT_TRUE(comes([&] { return wanted.messages.size() == 2; }));
  ASSERT_EQ(wanted.messages.back().poses.size(), 1U);
  EXPECT_EQ(wanted.messages.back().poses.front().position.x, 20.0);

  sendRoute(true);
  EXPECT_TRUE(comes([&] { return list()->item(0)->text().contains("under way"); }));
  EXPECT_TRUE(comes([&] { return !button("sail")->isEnabled(); }));
}

TEST_F(Panel, GaugesThrustAndError) {
  // Of a vessel with 50 N ahead and astern.
  double stamp_s = 100.0;
  ASSERT_TRUE(comes([&] {
    ThrusterCommand command;
    command.header.stamp = ros::Time(stamp_s += 0.01);
    command.left = 50.0;
    command.right = -12.5;
    thrust_.publish(command);
    return text("saturation").contains("at a limit 100 %");
  }));
  EXPECT_TRUE(shows("port_thrust", "50 N"));
  const auto gauges = panel_.findChildren<QWidget*>("starboard");
  ASSERT_EQ(gauges.size(), 1);
  EXPECT_DOUBLE_EQ(dynamic_cast<ThrustGauge*>(gauges.front())->share(), -0.25);

  for (int k = 0; k <= 900; ++k) {
    TrackerStatus status;
    status.header.stamp = ros::Time(100.0 + 0.1 * k);
    status.position_error = k < 250 ? 9.0 : k == 800 ? 0.75 : 0.25;
    tracker_.publish(status);
    if (k % 50 == 0) {
      comes([] { return false; }, 0.02);
    }
  }
  // The first half minute is forgotten.
  EXPECT_TRUE(shows("error", "now 0.25 m, mean 0.25 m, largest 0.75 m"));
  say(PlannerStatus::SAILING, "");
  sendRoute(true);
  EXPECT_TRUE(shows("state", "SAILING"));
  if (const char* out = std::getenv("OTTER_NAV_PANEL_PICTURE")) {
    EXPECT_TRUE(panel_.grab().save(out));
  }
}

TEST(LastMinute, BeginsAnewWhereTimeJumpsBack) {
  LastMinute minute;
  minute.add(50.0, 1.0);
  minute.add(51.0, 3.0);
  EXPECT_DOUBLE_EQ(minute.mean(), 2.0);
  minute.add(10.0, 5.0);
  EXPECT_DOUBLE_EQ(minute.mean(), 5.0);
  EXPECT_EQ(minute.samples().size(), 1U);
}

map::OccupancyGrid pond(map::Cell everywhere) {
  map::OccupancyGrid grid;
  grid.geometry.width = 40;
  grid.geometry.height = 20;
  grid.geometry.resolution_m = 0.5;
  grid.geometry.origin = {-10.0, -5.0};
  grid.cells.assign(800, everywhere);
  return grid;
}

QRgb at(const ChartPicture& picture, double x_m, double y_m) {
  const Eigen::Vector2i cell = picture.geometry().cellAt({x_m, y_m});
  return picture.image().pixel(cell.x(), cell.y());
}

TEST(ChartPicture, TellsApartWhatIsKnown) {
  map::OccupancyGrid chart = pond(map::Cell::kFree);
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 6; ++column) {
      chart.cells[chart.geometry.index(column, row)] = map::Cell::kOccupied;
      chart.cells[chart.geometry.index(39 - column, row)] = map::Cell::kUnknown;
    }
  }
  ChartPicture picture;
  picture.setChart(chart);
  EXPECT_EQ(at(picture, -9.0, 0.0), colourOf(Water::kLand));
  EXPECT_NE(at(picture, -7.2, 0.0), colourOf(Water::kLand));  // its coast
  EXPECT_EQ(at(picture, 0.0, 0.0), colourOf(Water::kCharted));
  EXPECT_EQ(at(picture, 9.0, 0.0), colourOf(Water::kUnknown));

  sensor_msgs::LaserScan scan;
  scan.angle_min = -0.5F;
  scan.angle_increment = 0.1F;
  scan.range_min = 0.1F;
  scan.range_max = 6.0F;
  scan.ranges.assign(11, std::numeric_limits<float>::infinity());
  scan.ranges[10] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(picture.see(fanOf(scan)).isEmpty());
  EXPECT_EQ(at(picture, 4.0, 0.0), colourOf(Water::kSeen));
  EXPECT_EQ(at(picture, 6.8, 0.0), colourOf(Water::kCharted));  // beyond its range
  EXPECT_EQ(at(picture, -2.0, 0.0), colourOf(Water::kCharted));
  EXPECT_EQ(at(picture, 4.6, 2.5), colourOf(Water::kCharted));  // no distance: nothing seen

  map_msgs::OccupancyGridUpdate update;
  update.header.frame_id = "map";
  update.x = 28;  // from x = 4 m
  update.y = 9;
  update.width = 2;
  update.height = 2;
  update.data.assign(4, 100);
  std::string error;
  EXPECT_TRUE(picture.update(update, error).contains(28, 9));
  EXPECT_EQ(error, "");
  EXPECT_EQ(at(picture, 4.3, 0.2), colourOf(Water::kSensed));
  update.x = 6;  // just off the coast: its echo
  update.width = 1;
  update.height = 1;
  update.data.assign(1, 100);
  EXPECT_FALSE(picture.update(update, error).isEmpty());
  EXPECT_EQ(at(picture, -6.8, -0.3), at(picture, -7.2, 0.0));
  update.x = 40;
  EXPECT_TRUE(picture.update(update, error).isEmpty());
  EXPECT_NE(error, "");
  picture.forgetSeen();
  EXPECT_EQ(at(picture, 3.0, 0.0), colourOf(Water::kCharted));
}

// Pixels near a colour.
int count(const QImage& image, const QColor& colour) {
  int pixels = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QColor here = image.pixelColor(x, y);
      pixels += std::abs(here.red() - colour.red()) + std::abs(here.green() - colour.green()) +
                            std::abs(here.blue() - colour.blue()) <
                        24
                    ? 1
                    : 0;
    }
  }
  return pixels;
}

TEST(HeadsUp, DrawsThrustsByTheirShare) {
  ros::NodeHandle node;
  ros::Publisher thrust = node.advertise<ThrusterCommand>("thruster_command", 100);
  Telemetry telemetry(node);
  ASSERT_TRUE(telemetry.setVessel("otter_gazebo"));
  EXPECT_FALSE(telemetry.setVessel("no_such_vessel"));
  ASSERT_TRUE(telemetry.setVessel("otter_gazebo"));
  ASSERT_TRUE(waitUntil([&] { return thrust.getNumSubscribers() > 0; }));
  EXPECT_LT(count(paintFigures(telemetry), look::kPort), 50);  // edges of other reds
  ThrusterCommand command;
  command.left = 25.0;
  command.right = -50.0;
  thrust.publish(command);
  ASSERT_TRUE(waitUntil([&] { return telemetry.thrust().has_value(); }));
  const QImage image = paintFigures(telemetry);
  const int port = count(image, look::kPort);
  const int starboard = count(image, look::kStarboard);
  EXPECT_GT(port, 500);
  EXPECT_NEAR(starboard, 2 * port, 0.1 * starboard);
}

TEST(HeadsUp, PointsWindWhereItBlowsOnTheScreen) {
  ros::NodeHandle node;
  ros::Publisher wind = node.advertise<geometry_msgs::Vector3Stamped>("wind", 1, true);
  Telemetry telemetry(node);
  geometry_msgs::Vector3Stamped north;
  north.vector.y = 5.0;
  wind.publish(north);
  ASSERT_TRUE(waitUntil([&] { return telemetry.wind().has_value(); }));
  // The arrow's head is its widest part: more of it where it points.
  const auto heads = [&](double east_on_screen_rad) {
    const QImage rose = paintRose(telemetry, east_on_screen_rad);
    const auto part = [&](int x, int y) { return count(rose.copy(x, y, 44, 44), look::kWind); };
    return std::array<int, 4>{part(60, 4), part(60, 84), part(20, 44), part(100, 44)};
  };
  const auto north_up = heads(0.0);
  EXPECT_GT(north_up[0], north_up[1]);
  EXPECT_GT(north_up[0], 4 * north_up[3]);
  const auto east_up = heads(1.5707963);
  EXPECT_GT(east_up[2], east_up[3]);
  EXPECT_GT(east_up[2], 4 * east_up[0]);
}

TEST(Minutes, AreWrittenAsOnAClock) {
  EXPECT_EQ(minutes(65.4), "1:05");
  EXPECT_EQ(minutes(-3.0), "0:00");
  EXPECT_EQ(minutes(std::nan("")), "–");
}

}  // namespace
}  // namespace otter_nav::rostest

int main(int argc, char** argv) {
  setenv("QT_QPA_PLATFORM", "offscreen", 0);
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "mission_panel_test");
  const QApplication application(argc, argv);
  const ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
