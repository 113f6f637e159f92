// What a recording says it lost, by the senders' numbers. Needs no master.
#include "nodes/recording.hpp"

#include <geometry_msgs/PointStamped.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace {

using namespace otter_nav;
using nodes::Recording;

Recording::Event numbered(std::uint32_t number) {
  namespace traits = ros::message_traits;
  geometry_msgs::PointStamped message;
  message.header.seq = number;
  message.header.stamp = ros::Time(1.0 + number);
  const auto shape = boost::make_shared<topic_tools::ShapeShifter>();
  shape->morph(traits::md5sum(message), traits::datatype(message), traits::definition(message), "");
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream out(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(out, message);
  ros::serialization::IStream in(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  shape->read(in);
  const auto header = boost::make_shared<ros::M_string>();
  *header = {{"callerid", "/map_node"}};
  return {shape, header, ros::Time(1.0)};
}

class RecordingTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    std::filesystem::remove(file_ + ".active");
    ASSERT_TRUE(recording_.open(file_));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void take(std::initializer_list<std::uint32_t> numbers) {
    for (const std::uint32_t number : numbers) {
      recording_.write("/map_updates", numbered(number), ros::Time(1.0));
    }
  }
  std::size_t gapsTold() {
    EXPECT_TRUE(recording_.close("/recording_gaps"));
    const rosbag::Bag bag(file_);
    return rosbag::View(bag, rosbag::TopicQuery("/recording_gaps")).size();
  }

  const std::string folder_ = ::testing::TempDir() + "/otter_nav_recording";
  const std::string file_ = folder_ + "/run.bag";
  Recording recording_;
};

TEST_F(RecordingTest, SaysWhatWasLost) {
  take({4, 5, 8, 9, 11});
  EXPECT_EQ(recording_.lost(),
            "3 messages of /map_updates from /map_node in 2 gaps, the first between 6.000000000 s "
            "and 9.000000000 s\n");
  EXPECT_EQ(gapsTold(), 1U);
}

// A sender tells a new subscriber alone what it missed; that bears no number, which is 0.
TEST_F(RecordingTest, MissesNothingBesideWhatWasToldToItAlone) {
  take({0, 2, 3, 0, 4});
  EXPECT_EQ(recording_.lost(), "");
  take({0, 6});
  EXPECT_NE(recording_.lost().find("1 messages of /map_updates"), std::string::npos);
}

TEST_F(RecordingTest, FollowsASenderThatBeginsAnew) {
  take({7, 8, 0, 1, 2});
  take({1, 2, 3});
  EXPECT_EQ(recording_.lost(), "");
  EXPECT_EQ(gapsTold(), 0U);
}

}  // namespace
