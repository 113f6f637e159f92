#include "identify/plots.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>

#include "identification/prediction.hpp"

namespace otter_nav::identification {
namespace {

constexpr double kRestart = 10.0;      // s of one prediction in the plots
constexpr double kPlotInterval = 0.1;  // s between plotted points

void appendState(std::ostringstream& out, const vessel::State& state) {
  for (int k = 0; k < vessel::kStateSize; ++k) {
    out << ' ' << state[k];
  }
}

// One prediction from `piece.begin` on, a blank line after it so that lines break there.
void appendPiece(std::ostringstream& out, const Identification& r, const Stretch& piece) {
  std::vector<std::vector<vessel::State>> predicted;
  for (const ComparedModel& m : comparedModels(r)) {
    predicted.push_back(predict(r.data, piece, m.model));
  }
  double next_s = r.data.samples[piece.begin].time_s;
  for (std::size_t i = piece.begin; i < piece.end; ++i) {
    const Sample& sample = r.data.samples[i];
    if (sample.time_s < next_s) {
      continue;
    }
    next_s += kPlotInterval;
    out << sample.time_s;
    appendState(out, sample.state);
    for (const auto& states : predicted) {
      appendState(out, states[i - piece.begin]);
    }
    out << '\n';
  }
  out << "\n\n";
}

// Columns of series.dat: measured state from 2 on, paper from 8, manoeuvring from 14, the guess's
// paper model from 20.
constexpr const char* kScript = R"(
set grid
set key outside top center horizontal
set terminal pngcairo size 1200,900
set output 'velocities.png'
set multiplot layout 3,1 title 'Measured and predicted 10 s ahead, validation blocks'
set ylabel 'surge m/s'
plot 'series.dat' using 1:5 with lines lw 2 title 'measured', '' using 1:11 with lines title 'paper', '' using 1:17 with lines title 'manoeuvring', '' using 1:23 with lines title 'guess'
set ylabel 'sway m/s'
plot 'series.dat' using 1:6 with lines lw 2 notitle, '' using 1:12 with lines notitle, '' using 1:18 with lines notitle, '' using 1:24 with lines notitle
set ylabel 'yaw rate rad/s'
set xlabel 'time s'
plot 'series.dat' using 1:7 with lines lw 2 notitle, '' using 1:13 with lines notitle, '' using 1:19 with lines notitle, '' using 1:25 with lines notitle
unset multiplot
set output 'residuals.png'
set multiplot layout 3,1 title 'Measured less predicted, restarted each 10 s, validation blocks'
unset xlabel
set ylabel 'surge m/s'
plot 'series.dat' using 1:($5-$11) with lines title 'paper', '' using 1:($5-$17) with lines title 'manoeuvring'
set ylabel 'sway m/s'
plot 'series.dat' using 1:($6-$12) with lines notitle, '' using 1:($6-$18) with lines notitle
set ylabel 'heading rad'
set xlabel 'time s'
plot 'series.dat' using 1:($4-$10) with lines notitle, '' using 1:($4-$16) with lines notitle
unset multiplot
set terminal pngcairo size 900,900
set output 'track.png'
set size ratio -1
set xlabel 'x m'
set ylabel 'y m'
plot 'series.dat' using 2:3 with lines lw 2 title 'measured', '' using 8:9 with lines title 'paper', '' using 14:15 with lines title 'manoeuvring', '' using 20:21 with lines title 'guess'
set size noratio
set terminal pngcairo size 900,600
set output 'prediction_error.png'
set logscale y
set xlabel 'horizon s'
set ylabel 'position error m (rms)'
plot 'errors.dat' using 1:2 with linespoints title 'paper', '' using 1:3 with linespoints title 'manoeuvring', '' using 1:4 with linespoints title 'guess, paper', '' using 1:5 with linespoints title 'guess, manoeuvring'
)";

// In gnuplot's single quotes, where an apostrophe is written twice and nothing else is special.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    result += c == '\'' ? "''" : std::string(1, c);
  }
  return result + "'";
}

}  // namespace

std::string seriesText(const Identification& r) {
  std::ostringstream out;
  out.precision(9);
  for (const Stretch& block : r.split.validation_blocks) {
    std::size_t begin = block.begin;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const double span_s = r.data.samples[i].time_s - r.data.samples[begin].time_s;
      if (span_s >= kRestart || i + 1 == block.end) {
        appendPiece(out, r, {begin, i + 1});
        begin = i;
      }
    }
  }
  return out.str();
}

Status plot(const std::filesystem::path& folder) {
  const std::string script = "cd " + quoted(folder.string()) + "\n" + kScript;
  FILE* gnuplot = popen("gnuplot", "w");
  if (gnuplot == nullptr) {
    return failure("gnuplot cannot be started: the report has no plots");
  }
  const bool written = std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
  if (pclose(gnuplot) != 0 || !written) {
    return failure("gnuplot failed: the report lacks plots");
  }
  return {};
}

}  // namespace otter_nav::identification
