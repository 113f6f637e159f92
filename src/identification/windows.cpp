#include "windows.hpp"

#include <algorithm>

namespace otter_nav::identification {
namespace {

// Pieces of about `length_s` of samples [begin, end), neighbours sharing their border sample; a
// rest shorter than half the length joins no piece.
std::vector<Stretch> cut(const DataSet& data, const Stretch& whole, double length_s) {
  std::vector<Stretch> pieces;
  std::size_t begin = whole.begin;
  for (std::size_t i = whole.begin + 1; i < whole.end; ++i) {
    const double span_s = data.samples[i].time_s - data.samples[begin].time_s;
    const bool last = i + 1 == whole.end;
    if (span_s >= length_s - 1e-9 || (last && span_s >= 0.5 * length_s)) {
      pieces.push_back({begin, i + 1});
      begin = i;
    }
  }
  return pieces;
}

}  // namespace

Result<Split> split(const DataSet& data, const SplitOptions& options) {
  double total_s = 0.0;
  for (const Stretch& s : data.stretches) {
    total_s += data.samples[s.end - 1].time_s - data.samples[s.begin].time_s;
  }
  const double block_s = std::min(options.block_s, total_s / options.validation_every);
  Split result;
  int block_number = 0;
  for (const Stretch& stretch : data.stretches) {
    for (const Stretch& block : cut(data, stretch, block_s)) {
      if (++block_number % options.validation_every == 0) {
        result.validation_blocks.push_back(block);
        continue;
      }
      for (const Stretch& window : cut(data, block, options.window_s)) {
        result.fit_windows.push_back(window);
      }
    }
  }
  if (result.fit_windows.empty()) {
    return failure("no stretch without a gap is long enough to fit: window_s is " +
                   std::to_string(options.window_s));
  }
  if (result.validation_blocks.empty()) {
    return failure("no stretch without a gap is left for validation: fewer than " +
                   std::to_string(options.validation_every) + " blocks of " +
                   std::to_string(block_s) + " s");
  }
  return result;
}

}  // namespace otter_nav::identification
