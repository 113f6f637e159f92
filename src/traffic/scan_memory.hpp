// Where beams have passed lately and where they have met something: tells what moved into water
// that was seen free from what merely came into sight.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace otter_nav::traffic {

// A square of cells that goes along with the vessel, map frame.
class ScanMemory {
 public:
  ScanMemory();

  // Begins a scan from `eye`; where the square has to move along, what leaves it is forgotten, and
  // all of it if the time goes back, or on by more than anything is remembered.
  void begin(double time_s, const Eigen::Vector2d& eye);
  // Whether what is met here has come into free water: the cell was seen free several times and has
  // been met for a few seconds at most, and nothing round about stands for longer.
  [[nodiscard]] bool isNew(const Eigen::Vector2d& point) const;
  // Whether what is met here has been there for longer than a vessel under way would be. It may
  // have been hidden since, as long as no beam has found it gone.
  [[nodiscard]] bool stands(const Eigen::Vector2d& point) const;
  // First all echoes of the scan, then what its beams passed.
  void met(const Eigen::Vector2d& point);
  void passed(const Eigen::Vector2d& from, const Eigen::Vector2d& to);

 private:
  // Times are since counts_from_s_: a float of an epoch clock would not tell scans apart.
  struct Cell {
    std::int32_t met_since_ms = -1;  // the first echo of those met in a row; < 0: none
    std::int32_t met_last_ms = -1;
    std::int32_t free_last_ms = -1;
    std::uint8_t free_count = 0;  // in a row, before the echoes
  };
  [[nodiscard]] Eigen::Vector2i cellAt(const Eigen::Vector2d& p) const;
  [[nodiscard]] bool contains(const Eigen::Vector2i& cell) const;
  [[nodiscard]] std::size_t indexOf(const Eigen::Vector2i& cell) const;
  [[nodiscard]] bool standsSince(const Cell& cell) const;
  void forget();
  void countFromLater();

  double counts_from_s_ = 0.0;
  std::int32_t now_ms_ = 0;
  double stagger_ = 0.0;
  Eigen::Vector2i corner_ = Eigen::Vector2i::Zero();  // of the square, cells of the whole plane
  bool placed_ = false;
  std::vector<Cell> cells_;  // a torus: a cell's place is its coordinates modulo the square's side
};

}  // namespace otter_nav::traffic
